// A stand that moves blade by blade: what its step and its pictures read. Rust: compute/blades.rs.

struct ChainStand {
    coefficients: ChainCoefficients,
    virtual_side: u32,
    blades: u32,       // of a patch
    cells: u32,
    dt: f32,
    patch_side: f32,
    planes: u32,       // first vec4 of `words` that is a plane
    busy: u32,         // first word of the busy blades behind the summaries
    unused: u32,
    steady: array<vec4<f32>, 256>, // ψ and moment of two joints each, by speed
}
