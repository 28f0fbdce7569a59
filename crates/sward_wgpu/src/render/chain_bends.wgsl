// How plants that move blade by blade are bent: by a state of their own if they have one, else by the virtual blades around them.
// Twin: picture/prepare.rs.

@group(0) @binding(4) var<storage, read> upper: array<f32>;
@group(0) @binding(12) var<uniform> chain: ChainStand;

fn steady_load(index: u32) -> vec2<f32> {
    let pair = chain.steady[index / 2u];
    return select(pair.xy, pair.zw, (index & 1u) == 1u);
}

fn standing_load(earlier: bool, index: u32) -> f32 {
    if earlier {
        return bitcast<f32>(before[index]);
    }
    return bitcast<f32>(now[index]);
}

/// Where virtual blades would have it.
fn virtual_pose(draw: PatchDraw, who: Who, base: mat3x3<f32>) -> array<vec2<f32>, 8> {
    let n = chain.coefficients.segments;
    let standing = Standing(draw.slots, draw.weights, chain.patch_side, chain.virtual_side);
    var steady = array<vec2<f32>, 8>();
    if standing_needs_wind(standing) {
        steady = steady_at(wind_at(draw.patch_index, who.local, false)).moments;
    }
    var moments = standing_moments(standing, n, false, who.local, steady);
    if prepare.behind > 0.0 {
        moments = standing_mixed(moments, standing_moments(standing, n, true, who.local, steady), prepare.behind);
    }
    return standing_pose(chain.coefficients, base, who.curl, moments);
}

/// Bends of all segments of a plant or blade, at the moment of the picture, beyond what it bends by itself, lowest first.
fn plant_bends(which: u32, who: Who, bends: ptr<function, array<vec2<f32>, 8>>) {
    let draw = draws[which];
    let n = chain.coefficients.segments;
    let base = chain_planted(who.yaw, who.lean);
    let lag = draw.lags[4];
    var hold = 0.0;
    let first = lag * (6u * n + 2u) * chain.blades + who.index;
    if lag != NONE {
        let end = first + 6u * n * chain.blades;
        hold = mix(upper[end], upper[end + chain.blades], prepare.behind);
    }
    var shown = array<vec2<f32>, 8>();
    if hold < 1.0 {
        shown = virtual_pose(draw, who, base);
    }
    if hold > 0.0 {
        for (var i = 0u; i < n; i++) {
            let at = first + 4u * i * chain.blades;
            let back = first + (4u * n + 2u * i) * chain.blades;
            let present = vec2<f32>(upper[at], upper[at + chain.blades]);
            let own = mix(present, vec2<f32>(upper[back], upper[back + chain.blades]), prepare.behind);
            shown[i] = mix(shown[i], own, min(hold, 1.0));
        }
    }
    *bends = standing_leans(n, base, who.heading, vec2<f32>(who.lean, who.curl), shown);
}
