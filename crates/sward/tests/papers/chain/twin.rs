//! The WGSL twins are valid, and lay out what they share with Rust alike.

use std::mem::{offset_of, size_of};
use sward::math;
use sward::response::chain::{ChainCoefficients, ChainState, JointCoefficients, WGSL};
use sward::response::oscillation;

fn text() -> String {
    [math::WGSL, oscillation::WGSL, WGSL[0], WGSL[1]].concat()
}

fn validated(text: &str) -> Result<naga::Module, String> {
    let module = naga::front::wgsl::parse_str(text).map_err(|e| e.emit_to_string(text))?;
    let mut validator = naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty());
    validator.validate(&module).map_err(|e| e.emit_to_string(text))?;
    Ok(module)
}

fn offsets(module: &naga::Module, name: &str) -> Vec<usize> {
    let (_, found) = module.types.iter().find(|(_, t)| t.name.as_deref() == Some(name)).unwrap();
    let naga::TypeInner::Struct { members, span } = &found.inner else { return Vec::new() };
    members.iter().map(|member| member.offset).chain([*span]).map(|bytes| bytes as usize).collect()
}

#[test]
fn the_chains_twins_are_valid_and_lay_out_structs_alike() {
    let host = "@group(0) @binding(0) var<uniform> blade: ChainCoefficients;\n@group(0) @binding(1) var<storage, read_write> state: ChainState;\n\
        @compute @workgroup_size(1) fn main() { state = chain_step(blade, chain_planted(0.0, 0.1), 0.3, vec3<f32>(1.0), 0.1, state); }";
    let module = validated(&[&text(), host].concat()).unwrap_or_else(|error| panic!("{error}"));
    let unused = offset_of!(ChainCoefficients, unused);
    let co = [
        offset_of!(ChainCoefficients, segments),
        offset_of!(ChainCoefficients, drag_thirds),
        offset_of!(ChainCoefficients, half_length),
        offset_of!(ChainCoefficients, weight),
        offset_of!(ChainCoefficients, drag),
        unused,
        unused + 4,
        unused + 8,
        offset_of!(ChainCoefficients, joints),
        size_of::<ChainCoefficients>(),
    ];
    assert_eq!(offsets(&module, "ChainCoefficients"), co);
    let joint = [
        offset_of!(JointCoefficients, stiffness),
        offset_of!(JointCoefficients, inertia),
        offset_of!(JointCoefficients, damping),
        offset_of!(JointCoefficients, reach),
        size_of::<JointCoefficients>(),
    ];
    assert_eq!(offsets(&module, "ChainJoint"), joint);
    assert_eq!(offsets(&module, "ChainState"), [0, size_of::<ChainState>()]);
    assert!(validated(&[&text(), "fn wrong() -> f32 { return 1u; }"].concat()).is_err());
}
