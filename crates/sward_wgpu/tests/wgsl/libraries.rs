//! Each library text of the core is valid by itself, joined only with what it says it needs.

use std::path::Path;

use sward::geometry::{billboard, blade, card, relief, sheet};
use sward::response::{chain, continuum, oscillation, oscillator, springs};
use sward::{growth, interaction, math, placement, shading, terrain, wind};

use crate::texts::validate;

const RELIEF_STUB: &str = "fn relief_load(index: i32) -> f32 { return f32(index); }";
const GROWTH_STUBS: &str =
    "fn growth_edge(index: u32) -> vec4<f32> { return vec4<f32>(f32(index)); } fn growth_texel(index: u32) -> f32 { return f32(index); }";
const TERRAIN_STUB: &str = "fn terrain_load(index: i32) -> f32 { return f32(index); }";
const WIND_STUB: &str = "fn wind_tile_load(index: u32) -> vec2<f32> { return vec2<f32>(f32(index)); }";
const WIND_BLOCKS: &str = "@group(0) @binding(0) var<uniform> wind: WindBlock; @group(0) @binding(1) var<uniform> tile_wind: WindBlock;";
const FLUID_STUBS: &str = "fn fft_load(index: u32) -> vec2<f32> { return vec2<f32>(f32(index)); } fn fft_store(index: u32, value: vec2<f32>) {} \
    fn fft_turn(index: u32) -> vec2<f32> { return vec2<f32>(f32(index)); } fn fluid_flow(index: u32) -> vec2<f32> { return vec2<f32>(f32(index)); }";
const CONTACT_STUB: &str = "fn contact_edge(index: u32) -> ContactEdge { var edge: ContactEdge; return edge; }";
const LAYERS_STUBS: &str = "fn layers_note(index: u32) -> vec2<f32> { return vec2<f32>(f32(index)); } \
    fn layers_touch(index: u32) -> vec2<f32> { return vec2<f32>(f32(index)); }";
const SOLID_STUB: &str = "fn solid_plane(index: u32) -> vec4<f32> { return vec4<f32>(f32(index)); }";
const DISTANCE_MAP_STUB: &str = "fn distance_map_load(index: u32) -> vec4<f32> { return vec4<f32>(f32(index)); }";
const SPRINGS_STUBS: &str = "fn springs_map(index: u32) -> DistanceMapHead { var head: DistanceMapHead; return head; }
fn springs_word(k: u32) -> u32 { return k; }
fn springs_put_word(k: u32, word: u32) {}";
const STANDING_STUBS: &str = "fn steady_load(index: u32) -> vec2<f32> { return vec2<f32>(f32(index)); } \
    fn standing_load(before: bool, index: u32) -> f32 { return f32(index); }";
const HELD_STUBS: &str = "fn push_solid(index: u32) -> SolidHead { var solid: SolidHead; return solid; } \
    fn held_stands(root: Root, base: mat3x3<f32>, before: bool) -> array<vec2<f32>, 8> { return array<vec2<f32>, 8>(); } \
    fn held_wind(root: Root) -> vec2<f32> { return root.slope; } \
    fn pressed_joint(joint: u32) -> ChainJoint { return ChainJoint(); }";
const AIR_STUB: &str = "fn air_load(index: u32) -> f32 { return f32(index); }";
const REACTION_STUB: &str = "fn reaction_add(word: u32, parts: i32) {}";
const REST_STUB: &str = "fn rest_node(index: u32) -> vec2<f32> { return vec2<f32>(f32(index)); }";

/// Name, and the parts that make it complete: what it needs, the host's functions, itself.
fn libraries() -> Vec<(&'static str, Vec<&'static str>)> {
    let mut continuum = vec![math::WGSL, interaction::WGSL, CONTACT_STUB, REST_STUB];
    continuum.extend(continuum::WGSL);
    let distance_map = vec![math::WGSL, DISTANCE_MAP_STUB, interaction::distance_map::WGSL];
    let standing = [&[math::WGSL, oscillation::WGSL], &chain::WGSL[..], &[STANDING_STUBS], &chain::STANDING_WGSL].concat();
    vec![
        ("math", vec![math::WGSL]),
        ("placement", vec![math::WGSL, placement::WGSL]),
        ("terrain", vec![math::WGSL, TERRAIN_STUB, terrain::WGSL]),
        ("wind", vec![math::WGSL, WIND_STUB, wind::WGSL]),
        ("sum of the wind", vec![math::WGSL, WIND_STUB, WIND_BLOCKS, wind::WGSL, wind::TILED_SUM_WGSL]),
        ("sum of the wind, untiled", vec![math::WGSL, WIND_STUB, WIND_BLOCKS, wind::WGSL, wind::SUM_WGSL]),
        ("fluid", [&[math::WGSL, FLUID_STUBS], &wind::fluid::WGSL[..]].concat()),
        ("harmonic", vec![sward::response::harmonic::WGSL]),
        ("layers", vec![math::WGSL, LAYERS_STUBS, sward::geometry::layers::WGSL]),
        ("contact", vec![math::WGSL, CONTACT_STUB, interaction::WGSL]),
        ("reactions", vec![math::WGSL, interaction::reaction::WGSL]),
        ("sums of reactions", vec![math::WGSL, REACTION_STUB, interaction::reaction::WGSL, interaction::reaction::SUMS_WGSL]),
        ("continuum", continuum),
        ("growth", vec![GROWTH_STUBS, growth::WGSL]),
        ("half", vec![math::WGSL, continuum::HALF_WGSL]),
        ("cells", vec![math::WGSL, continuum::HALF_WGSL, sward_wgpu::compute::CELLS_WGSL]),
        ("billboard", vec![math::WGSL, billboard::WGSL]),
        ("oscillation", vec![math::WGSL, oscillation::WGSL]),
        ("solid", vec![math::WGSL, SOLID_STUB, interaction::solid::WGSL]),
        ("springs", [&[math::WGSL], &springs::WGSL[..]].concat()),
        ("springs' steps", [&distance_map[..], &springs::WGSL, &[SPRINGS_STUBS], &springs::STEP_WGSL].concat()),
        ("distance_map", distance_map),
        ("raster", vec![math::WGSL, interaction::distance_map::RASTER_WGSL]),
        ("standing", standing.clone()),
        ("held", [&standing[..], &[SOLID_STUB, interaction::solid::WGSL, HELD_STUBS], &chain::HELD_WGSL].concat()),
        ("chain stand", vec![math::WGSL, oscillation::WGSL, chain::WGSL[0], chain::WGSL[1], sward_wgpu::compute::blades::CHAIN_STAND_WGSL]),
        ("chain", [&[math::WGSL, oscillation::WGSL], &chain::WGSL[..]].concat()),
        ("oscillator", [&[math::WGSL, interaction::WGSL, CONTACT_STUB, oscillation::WGSL, AIR_STUB], &oscillator::WGSL[..]].concat()),
        ("oscillator's poses", [&[math::WGSL, oscillation::WGSL, AIR_STUB], &oscillator::POSE_WGSL[..]].concat()),
        ("card", vec![math::WGSL, card::WGSL]),
        ("sheet", vec![sheet::WGSL]),
        ("blade", vec![math::WGSL, billboard::WGSL, blade::WGSL]),
        ("relief", vec![RELIEF_STUB, relief::WGSL]),
        ("shading/common", vec![shading::COMMON_WGSL]),
        ("shading", [&[math::WGSL], &shading::WGSL[..]].concat()),
    ]
}

#[test]
fn each_library_is_valid_with_its_stubs() {
    for (name, parts) in libraries() {
        validate(&parts.join("\n")).unwrap_or_else(|error| panic!("{name}: {error}"));
    }
}

/// A library that forgot one of its needs must be noticed.
#[test]
fn a_library_without_its_needs_is_refused() {
    for (name, text) in [
        ("placement", placement::WGSL),
        ("terrain", terrain::WGSL),
        ("wind", wind::WGSL),
        ("sum of the wind", wind::SUM_WGSL),
        ("contact", interaction::WGSL),
    ] {
        assert!(validate(text).is_err(), "{name} is valid without what it needs");
    }
}

/// All `.wgsl` files below a folder.
pub(crate) fn wgsl_files(folder: &Path, found: &mut Vec<(String, String)>) {
    for entry in std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display())).flatten() {
        let path = entry.path();
        if path.is_dir() {
            wgsl_files(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "wgsl") {
            let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            found.push((path.display().to_string(), text));
        }
    }
}

pub(crate) fn core_sources() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../sward/src"))
}

#[test]
fn no_library_file_is_forgotten() {
    let mut files = Vec::new();
    wgsl_files(core_sources(), &mut files);
    assert!(files.len() > 5, "found only {} files", files.len());
    let known = libraries();
    for (path, text) in files {
        assert!(known.iter().any(|(_, parts)| parts.iter().any(|part| part.contains(&text))), "{path} is in no entry of libraries()");
    }
}
