// Blades: strips of triangles along a curve. Twin: blade.rs (Belyaev et al. 2011, §2.1, §2.2), where everything is explained.

const BLADE_FARTHEST: f32 = 2.2;

struct BladeStance {
    heading: vec2<f32>,
    lean: f32,
    curl: f32,
}

// Bend at a share `along` of the length, of the `count` segments in `bends`.
fn blade_bend(bends: ptr<function, array<vec2<f32>, 8>>, count: u32, stance: BladeStance, along: f32) -> vec2<f32> {
    let last = count - 1u;
    let at = clamp(along * f32(count) - 0.5, 0.0, f32(last));
    let below = u32(at);
    let above = min(below + 1u, last);
    let own = stance.lean + stance.curl * along * along;
    let bend = mix((*bends)[below], (*bends)[above], at - f32(below)) + stance.heading * own;
    let size = length(bend);
    return bend * select(1.0, BLADE_FARTHEST / size, size > BLADE_FARTHEST);
}

// Bend of a piece of `pieces`; with `morph` 1 the strip has the shape of one of `coarse` pieces.
fn blade_piece_bend(bends: ptr<function, array<vec2<f32>, 8>>, count: u32, stance: BladeStance, piece: u32, pieces: u32, coarse: u32, morph: f32) -> vec2<f32> {
    let own = blade_bend(bends, count, stance, (f32(piece) + 0.5) / f32(pieces));
    if morph <= 0.0 {
        return own;
    }
    let first = piece * coarse / pieces;
    let second = min(first + 1u, coarse - 1u);
    let border = f32((first + 1u) * pieces) / f32(coarse);
    let share = clamp(border - f32(piece), 0.0, 1.0);
    let a = blade_bend(bends, count, stance, (f32(first) + 0.5) / f32(coarse));
    let b = blade_bend(bends, count, stance, (f32(second) + 0.5) / f32(coarse));
    return mix(own, mix(b, a, share), morph);
}

// A piece that rises by at least `least`: turned up until it does, if it is long enough, else lifted.
fn blade_raised(way: vec3<f32>, least: f32) -> vec3<f32> {
    if way.y >= least {
        return way;
    }
    let across = length(way.xz);
    let left = dot(way, way) - least * least;
    if left <= 0.0 || across < 1e-6 {
        return vec3<f32>(way.x, least, way.z);
    }
    let scale = sqrt(left) / across;
    return vec3<f32>(way.x * scale, least, way.z * scale);
}

// Width as a share of the widest.
fn blade_profile(along: f32) -> f32 {
    return (0.72 + 0.28 * smoothstep(0.0, 0.3, along)) * (1.0 - along * along * along);
}

// Unit vector across a blade: flat to its heading, carried along with the tangent, turned about it by `twist`.
fn blade_across(heading: vec2<f32>, tangent: vec3<f32>, twist: f32) -> vec3<f32> {
    let side = vec3<f32>(-heading.y, 0.0, heading.x);
    let carried = side - dot(side, tangent) / max(1.0 + tangent.y, 0.1) * (tangent + vec3<f32>(0.0, 1.0, 0.0));
    let turn = math_sin_cos(twist);
    let turned = carried * turn.y + cross(tangent, carried) * turn.x;
    let size = length(turned);
    return select(vec3<f32>(1.0, 0.0, 0.0), turned / size, size > 1e-20);
}

// Share of blades drawn; `facing` = n·r, `terms` = (a1, a2, a3).
fn blade_density(terms: vec3<f32>, facing_in: f32, distance: f32) -> f32 {
    let facing = abs(facing_in);
    let rim = 1.0 - facing;
    let squared = rim * rim;
    let fourth = squared * squared;
    let t = fourth * fourth;
    let seen = (1.0 - t) * facing + t;
    return clamp(seen / max(terms.x + terms.y * distance + terms.z * distance * distance, 1e-6), 0.0, 1.0);
}
