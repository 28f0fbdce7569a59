// How plants are bent that swing by themselves: a function of how bodies left each, and of time. Twin: picture/prepare.rs.

struct SwingStand {
    coefficients: OscillatorCoefficients,
    patch_side: f32,
    unused_a: f32,
    unused_b: f32,
    unused_c: f32,
}

@group(0) @binding(12) var<uniform> swinging: SwingStand;

fn air_load(index: u32) -> f32 {
    return bitcast<f32>(before[index]);
}

/// Bends of all segments of a plant or blade, at the moment of the picture, beyond what it bends by itself, lowest first.
fn plant_bends(which: u32, who: Who, bends: ptr<function, array<vec2<f32>, 8>>) {
    let draw = draws[which];
    let co = swinging.coefficients;
    let air = Air(draw.slots, draw.weights, swinging.patch_side);
    var still = vec2<f32>(0.0);
    if air_asks(co, air) {
        still = wind_equilibrium(wind_at(draw.patch_index, who.local, false), co.wind);
    }
    var bend = air_at(co, air, who.local, prepare.behind, still);
    let slot = draw.slots[4];
    if slot != NONE {
        let area = prepare.placement.cells * prepare.placement.cells;
        let cell = who.index % area;
        let own = swing_own(co, placement_variety(prepare.placement, draw.patch_index, cell), who.tall);
        let first = slot * 4u * area + cell;
        let deviation = bitcast<vec2<f32>>(vec2<u32>(now[first], now[first + area]));
        let record = SwingRecord(deviation, bitcast<f32>(now[first + 2u * area]), now[first + 3u * area]);
        bend += swing_at(co, own, record, prepare.step.x, prepare.behind);
    }
    bend = swing_limited(bend);
    for (var segment = 0u; segment < prepare.segments; segment++) {
        (*bends)[segment] = swing_curved(co.curve, bend, segment, prepare.segments);
    }
}
