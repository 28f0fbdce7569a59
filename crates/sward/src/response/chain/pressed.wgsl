// What a body feels of a blade that it has pushed aside. Twin: pressed.rs, where everything is explained. Needs push, interaction/reaction and
// `pressed_joint(joint: u32) -> ChainJoint`, which reads it where it lies: a copy of all joints that is indexed makes Mesa's drivers in software translate the
// kernel again at every dispatch, which takes 70 ms.

const PRESSED_SLANTED: f32 = 0.01;

fn pressed_stiffness(co: ChainCoefficients, joint: u32) -> f32 {
    let above = f32(min(co.segments, CHAIN_MOST_SEGMENTS) - joint);
    return pressed_joint(joint).stiffness * above * above;
}

fn pressed_energy(co: ChainCoefficients, posture: array<vec2<f32>, 8>) -> f32 {
    var bends = posture;
    var energy = 0.0;
    for (var i = 0u; i < min(co.segments, CHAIN_MOST_SEGMENTS); i++) {
        energy += 0.5 * pressed_stiffness(co, i) * (bends[i].x * bends[i].x + bends[i].y * bends[i].y);
    }
    return energy;
}

fn pressed_down(tip: vec3<f32>) -> bool {
    return tip.y < math_sin_cos(REACTION_CRUSHED).y * math_upper(sqrt(dot(tip, tip)), 1e-9);
}

// What the body feels about `about`: the blade stood as `stood` has it before the step, and stands as `posture` now.
fn pressed_felt(co: ChainCoefficients, root: Root, base: mat3x3<f32>, by: Pressed, stood: array<vec2<f32>, 8>, posture: array<vec2<f32>, 8>, about: vec3<f32>) -> Felt {
    var bends = posture;
    let length_ = root.length / f32(co.segments);
    var frame = base;
    var at = root.at;
    var joint = root.at;
    var moment = vec3<f32>(0.0);
    var lever = vec3<f32>(0.0);
    for (var i = 0u; i < min(co.segments, CHAIN_MOST_SEGMENTS); i++) {
        if i == by.joint {
            joint = at;
            moment = frame * (pressed_stiffness(co, i) * vec3<f32>(bends[i], 0.0));
        }
        frame = frame * chain_rotation(bends[i] + chain_rest_turn(co.segments, root.curl, i));
        if i >= by.joint {
            lever += at + 0.5 * length_ * frame[2] - joint;
        }
        at += length_ * frame[2];
    }
    let needed = moment - cross(lever, vec3<f32>(0.0, -co.weight, 0.0));
    var along = by.normal;
    if dot(along, along) <= 0.0 {
        let square = cross(needed, by.arm);
        along = square / math_upper(sqrt(dot(square, square)), 1e-12);
    }
    let turn = cross(by.arm, along);
    let size = math_upper(dot(needed, turn) / math_upper(dot(turn, turn), PRESSED_SLANTED * dot(by.arm, by.arm) + 1e-8), 0.0);
    let force = -size * along;
    let fell = pressed_down(push_tip(co, root, base, posture)) && !pressed_down(push_tip(co, root, base, stood));
    return Felt(force, cross(joint + by.arm - about, force), select(0.0, pressed_energy(co, posture), fell));
}
