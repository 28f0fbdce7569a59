// What games ask of plants at places. Twin: picture/asked.rs in the core. After the texts of a bending.

struct Asked {
    local: vec2<f32>,
    lean: vec2<f32>,
    tall: f32,
    height: f32,
    index: u32,
    which: u32,
    yaw: f32,
    stance: f32,
    curl: f32,
    unused: f32,
}

@group(0) @binding(7) var<storage, read> questions: array<Asked>;
@group(0) @binding(8) var<storage, read_write> answers: array<vec4<f32>>;

fn asked_standing(bends: ptr<function, array<vec2<f32>, 8>>, segments: u32, heading: vec2<f32>, asked: Asked) -> vec4<f32> {
    var tip = vec3<f32>(0.0);
    let length_ = 1.0 / f32(segments);
    for (var segment = 0u; segment < segments; segment++) {
        let along = (f32(segment) + 0.5) * length_;
        let own = asked.stance + asked.curl * along * along;
        tip += billboard_segment(billboard_leaning((*bends)[segment], own * heading), length_);
    }
    let level = sqrt(tip.x * tip.x + tip.z * tip.z);
    let share = math_atan2(level, tip.y) / max(level, 1e-9);
    return vec4<f32>(tip.xz * share, asked.height * max(tip.y, 0.0), 0.0);
}

@compute @workgroup_size(64)
fn ask_pass(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let number = (group.y * groups.x + group.x) * 64u + lane;
    if number >= arrayLength(&questions) {
        return;
    }
    let asked = questions[number];
    let heading = math_sin_cos(asked.yaw).yx;
    let who = Who(asked.local, asked.tall, asked.index, heading, asked.yaw, asked.stance, asked.curl, asked.lean);
    var bends = array<vec2<f32>, 8>();
    plant_bends(asked.which, who, &bends);
    answers[number] = asked_standing(&bends, clamp(prepare.segments, 1u, 8u), heading, asked);
}
