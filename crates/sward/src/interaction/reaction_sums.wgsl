// Sums of what bodies feel. Twin: reaction.rs. Needs reaction.wgsl.
// The host declares `fn reaction_add(word: u32, parts: i32)`, which adds to a word of its sums.

const REACTION_WORDS: u32 = 9u;
const REACTION_FORCE_PARTS: f32 = 16384.0;
const REACTION_ENERGY_PARTS: f32 = 262144.0;
const REACTION_MOST: f32 = 67108864.0;

fn reaction_parts(value: f32, of_one: f32) -> i32 {
    return i32(floor(math_clamped(value * of_one, -REACTION_MOST, REACTION_MOST) + 0.5));
}

// Adds one plant to sums that begin at a word.
fn reaction_sum(first: u32, felt: Felt) {
    for (var axis = 0u; axis < 3u; axis++) {
        reaction_add(first + axis, reaction_parts(felt.force[axis], REACTION_FORCE_PARTS));
        reaction_add(first + 3u + axis, reaction_parts(felt.moment[axis], REACTION_FORCE_PARTS));
    }
    reaction_add(first + 7u, 1);
    if felt.crushed > 0.0 {
        reaction_add(first + 6u, reaction_parts(felt.crushed, REACTION_ENERGY_PARTS));
        reaction_add(first + 8u, 1);
    }
}
