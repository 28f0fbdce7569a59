// The light of a place among the plants, from six sides. Twin: volume/mod.rs, where everything is explained.

// Irradiance / pi in rgb and the share of the surroundings seen in w, for +x, -x, up, down, +z, -z.
struct VolumeFaces {
    sides: array<vec4<f32>, 6>,
}

// Light on a surface: what it would send back if it were white, and the share of the surroundings it sees.
fn volume_facing(faces: VolumeFaces, normal: vec3<f32>) -> vec4<f32> {
    let squared = normal * normal;
    let x = select(faces.sides[0], faces.sides[1], normal.x < 0.0);
    let y = select(faces.sides[2], faces.sides[3], normal.y < 0.0);
    let z = select(faces.sides[4], faces.sides[5], normal.z < 0.0);
    return x * squared.x + y * squared.y + z * squared.z;
}

// Mean of the light from all sides.
fn volume_mean(faces: VolumeFaces) -> vec3<f32> {
    let sides = faces.sides;
    return (sides[0] + sides[1] + sides[2] + sides[3] + sides[4] + sides[5]).rgb / 6.0;
}
