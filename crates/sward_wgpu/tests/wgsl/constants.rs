//! A constant that stands in both languages has one value.

use std::path::Path;

use sward::{
    geometry::billboard,
    interaction::{distance_map, reaction},
    picture::aov,
    response::{chain, continuum, springs},
    state,
};
use sward_wgpu::render::{self, shadow};

use crate::libraries::{core_sources, wgsl_files};

/// Where a constant of a `.wgsl` file comes from.
enum Origin {
    /// Public in Rust.
    Value(f64),
    /// Private in Rust: file in the core's or this crate's sources, and name.
    Source(&'static str, &'static str),
    /// Stands in WGSL only.
    Alone,
}
use Origin::{Alone, Source, Value};

const PLACEMENT: &str = "placement.rs";
const BEND: &str = "response/continuum/bend.rs";
const HALF: &str = "response/continuum/half.rs";

const SWING: &str = "response/oscillator/swing.rs";
const INSTIGATOR: &str = "response/oscillator/instigator.rs";
const TOUCH: &str = "response/oscillator/touch.rs";
const PUSH: &str = "response/chain/push.rs";
const HELD: &str = "response/chain/held.rs";

/// Every constant of every `.wgsl` file.
fn constants() -> Vec<(&'static str, Origin)> {
    vec![
        ("SHADING_PERIOD", Value(sward::shading::common::PERIOD)),
        ("SHADING_SUN", Source("shading/sky.rs", "SUN")),
        ("SHADING_RAYLEIGH", Alone),
        ("SHADING_STRAW", Alone),
        ("SHADING_SCATTERED", Alone),
        ("LIT_TOPS", Source("shading/volume/lit.rs", "TOPS")),
        ("LIT_LYING", Source("shading/volume/lit.rs", "LYING")),
        ("LIT_PASSED", Alone),
        ("RESOLVE_SAMPLES", Value(f64::from(render::SAMPLES))),
        ("SHADING_MEAN_LIT", Value(f64::from(sward::shading::foliage::MEAN_LIT))),
        ("AOV_COVERAGE", Value(f64::from(aov::COVERAGE))),
        ("AOV_UNSEEN", Value(f64::from(aov::UNSEEN))),
        ("AOV_NEAR", Value(f64::from(sward::picture::frame::NEAR))),
        ("CONTACT_BAND", Source("interaction/contact.rs", "BAND")),
        ("TERRAIN_DETAIL_PURPOSE", Source("terrain/detail.rs", "PURPOSE")),
        ("PLACEMENT_PRESENT", Source(PLACEMENT, "PRESENT")),
        ("PLACEMENT_PLACE_X", Source(PLACEMENT, "PLACE_X")),
        ("PLACEMENT_PLACE_Z", Source(PLACEMENT, "PLACE_Z")),
        ("PLACEMENT_HEIGHT", Source(PLACEMENT, "HEIGHT")),
        ("PLACEMENT_YAW", Source(PLACEMENT, "YAW")),
        ("PLACEMENT_TINT", Source(PLACEMENT, "TINT")),
        ("PLACEMENT_CLUMP", Source(PLACEMENT, "CLUMP")),
        ("PLACEMENT_VARIETY", Source(PLACEMENT, "VARIETY")),
        ("PLACEMENT_LEAN_X", Source(PLACEMENT, "LEAN_X")),
        ("PLACEMENT_LEAN_Z", Source(PLACEMENT, "LEAN_Z")),
        ("PLACEMENT_MOST_LEAN", Source(PLACEMENT, "MOST_LEAN")),
        ("PLACEMENT_MESSY", Source(PLACEMENT, "MESSY")),
        ("PLACEMENT_BLADE", Source(PLACEMENT, "BLADE")),
        ("CHAIN_MOST_SEGMENTS", Value(chain::MOST_SEGMENTS as f64)),
        ("CHAIN_BEND_LIMIT", Value(f64::from(chain::BEND_LIMIT))),
        ("CHAIN_RATE_LIMIT", Value(f64::from(chain::RATE_LIMIT))),
        ("CHAIN_LEAST_STIFFNESS", Source("response/chain/joint.rs", "LEAST_STIFFNESS")),
        ("VIRTUAL_INERTIA_TURNS", Source("response/chain/virtual_inertia.rs", "TURNS")),
        ("VIRTUAL_INERTIA_LEAST_SLOPE", Source("response/chain/virtual_inertia.rs", "LEAST_SLOPE")),
        ("STEADY_SPEEDS", Value(chain::SPEEDS as f64)),
        ("STEADY_TOP", Value(f64::from(chain::TOP))),
        ("STANDING_NONE", Value(f64::from(state::NONE))),
        ("DISTANCE_MAP_EMPTY", Value(f64::from(distance_map::EMPTY))),
        ("DISTANCE_MAP_STEEP", Source("interaction/distance_map.rs", "STEEP")),
        ("SHEET_LIFT", Source("geometry/sheet.rs", "LIFT")),
        ("RASTER_PARTS", Source("interaction/distance_map/raster.rs", "PARTS")),
        ("RASTER_BEYOND", Source("interaction/distance_map/raster.rs", "BEYOND")),
        ("RASTER_EMPTY", Value(f64::from(distance_map::EMPTY))),
        ("MAPS_SMALL", Alone),
        ("SPRINGS_MOST_SIDE", Value(springs::MOST_SIDE as f64)),
        ("SPRINGS_MOST_VERTICES", Value(springs::MOST_VERTICES as f64)),
        ("SPRINGS_CLEAR", Value(f64::from(springs::CLEAR))),
        ("SPRINGS_TOLERANCE", Value(f64::from(springs::TOLERANCE))),
        ("SPRINGS_TRODDEN", Value(f64::from(springs::TRODDEN))),
        ("SPRINGS_SPREAD", Value(f64::from(springs::SPREAD))),
        ("SPRINGS_AHEAD", Value(f64::from(springs::AHEAD))),
        ("SPRINGS_STRIDE", Source("response/springs/push.rs", "STRIDE")),
        ("SPRINGS_STRIDE_SHARE", Source("response/springs/push.rs", "STRIDE_SHARE")),
        ("SPRINGS_DEEP", Source("response/springs/step.rs", "DEEP")),
        ("SPRINGS_PATIENCE", Source("response/springs/step.rs", "PATIENCE")),
        ("SPRINGS_ROUNDS", Value(f64::from(springs::ROUNDS))),
        ("SPRINGS_HALVINGS", Source("response/springs/lay.rs", "HALVINGS")),
        ("SPRINGS_SLACK", Source("response/springs/push.rs", "SLACK")),
        ("SPRINGS_DOWN", Source("response/springs/push.rs", "DOWN")),
        ("SPRINGS_OPPOSITE", Source("response/springs/vector.rs", "OPPOSITE")),
        ("SPRINGS_ROOM", Value(springs::ROOM as f64)),
        ("SPRINGS_BEGUN", Alone),
        ("SPRINGS_NOBODY", Alone),
        ("SPRINGS_LEAST", Source("response/springs/pressed.rs", "LEAST")),
        ("PRESSED_SLANTED", Source("response/chain/pressed.rs", "SLANTED")),
        ("REACTION_WORDS", Value(reaction::WORDS as f64)),
        ("REACTION_FORCE_PARTS", Value(f64::from(reaction::FORCE_PARTS))),
        ("REACTION_ENERGY_PARTS", Value(f64::from(reaction::ENERGY_PARTS))),
        ("REACTION_MOST", Source("interaction/reaction.rs", "MOST")),
        ("REACTION_CRUSHED", Value(f64::from(reaction::CRUSHED))),
        ("REACTION_NEAREST", Value(f64::from(reaction::NEAREST))),
        ("SPRINGS_STORED", Alone),
        ("SPRINGS_STANDING", Alone),
        ("SPRINGS_NOW", Alone),
        ("SPRINGS_BEFORE", Alone),
        ("SPRINGS_SPARE", Alone),
        ("SPRINGS_TRIED", Alone),
        ("SPRINGS_TOUCHED", Alone),
        ("SPRINGS_LEANING", Alone),
        ("SPRINGS_FREE", Alone),
        ("SPRINGS_NEAR", Source("response/springs/vector.rs", "NEAR")),
        ("SOLID_AWAY", Source("interaction/solid.rs", "AWAY")),
        ("PUSH_BITS", Source(PUSH, "BITS")),
        ("PUSH_SWEEPS", Source(PUSH, "SWEEPS")),
        ("PUSH_ROUNDS", Source(PUSH, "ROUNDS")),
        ("PUSH_PATIENCE", Source(PUSH, "PATIENCE")),
        ("PUSH_STRAIGHT", Source(PUSH, "STRAIGHT")),
        ("PUSH_UPRIGHT", Source(PUSH, "UPRIGHT")),
        ("PUSH_SLACK", Source(PUSH, "SLACK")),
        ("PUSH_TOLERANCE", Value(f64::from(chain::TOLERANCE))),
        ("PUSH_CLEAR", Source(PUSH, "CLEAR")),
        ("PUSH_ROOM", Source(PUSH, "ROOM")),
        ("HELD_NEAR", Source(HELD, "NEAR")),
        ("HELD_SLOW", Source(HELD, "SLOW")),
        ("HELD_FADE", Source(HELD, "FADE")),
        ("HELD_MOTION", Source(HELD, "MOTION")),
        ("HELD_FRAMES", Source(HELD, "FRAMES")),
        ("SWING_GRAVITY", Source(SWING, "GRAVITY")),
        ("SWING_HALF_PI", Value(f64::from(continuum::HALF_PI))),
        ("SWING_SHORTEST", Source(SWING, "SHORTEST")),
        ("SWING_FREE", Source(SWING, "FREE")),
        ("SWING_FULL_TURN", Source(SWING, "FULL_TURN")),
        ("AIR_NONE", Value(f64::from(state::NONE))),
        ("INSTIGATOR_BISECTIONS", Source(INSTIGATOR, "BISECTIONS")),
        ("INSTIGATOR_LOWEST", Source(INSTIGATOR, "LOWEST")),
        ("INSTIGATOR_MIDDLE", Source(INSTIGATOR, "MIDDLE")),
        ("TOUCH_UPRIGHT", Source(TOUCH, "UPRIGHT")),
        ("TOUCH_OPPOSED", Source(TOUCH, "OPPOSED")),
        ("BLADE_FARTHEST", Source("geometry/blade.rs", "FARTHEST")),
        ("CONTINUUM_HALF_PI", Value(f64::from(continuum::HALF_PI))),
        ("CONTINUUM_RATE_LIMIT", Value(f64::from(continuum::RATE_LIMIT))),
        ("CONTINUUM_OVER_THE_TOP", Source(BEND, "OVER_THE_TOP")),
        ("CONTINUUM_HOLDING", Source(BEND, "HOLDING")),
        ("HALF_LARGEST_BEND", Source(HALF, "LARGEST_BEND")),
        ("HALF_LARGEST_RATE", Source(HALF, "LARGEST_RATE")),
        ("HALF_SMALLEST_RATE", Source(HALF, "SMALLEST_RATE")),
        ("HALF_RATE_OFFSET", Source(HALF, "RATE_OFFSET")),
        ("BILLBOARD_FLAT", Source("geometry/billboard.rs", "FLAT")),
        ("BILLBOARD_CLEARANCE", Value(f64::from(billboard::CLEARANCE))),
        ("WIND_TILE_TEXELS", Value((sward::wind::TILE_SIDE * sward::wind::TILE_SIDE) as f64)),
        ("HARMONIC_TOUCH_SIDE", Value(f64::from(sward::response::harmonic::TOUCH_SIDE))),
        ("HARMONIC_PARTING", Source("response/harmonic/touch.rs", "PARTING")),
        ("LAYERS_TOUCH_SIDE", Value(f64::from(sward::response::harmonic::TOUCH_SIDE))),
        ("LAYERS_NONE", Value(f64::from(sward::geometry::layers::NONE))),
        ("FFT_LANES", Alone),
        ("FLUID_HOLDS", Source("wind/fluid/force.rs", "HOLDS")),
        ("FLUID_FARTHEST", Source("wind/fluid/advect.rs", "FARTHEST")),
        ("NONE", Value(f64::from(state::NONE))),
    ]
}

/// Numbers that stand in a WGSL file without a name: file, text around it, and the number in Rust.
fn written_out() -> Vec<(&'static str, &'static str, f64)> {
    vec![
        ("chain_stand.wgsl", "steady: array<vec4<f32>, ", (chain::SPEEDS * chain::MOST_SEGMENTS / 2) as f64),
        ("bend.wgsl", "math_atan(along), ", f64::from(continuum::SMALLEST_LIMIT)),
        ("shadows.wgsl", "texel = spread / ", f64::from(shadow::SIDE)),
        ("noise.wgsl", "octaves: array<WindOctave, ", sward::wind::MAX_OCTAVES as f64),
        ("noise.wgsl", "footprints: array<WindFootprint, ", sward::wind::MAX_FOOTPRINTS as f64),
        ("noise.wgsl", "fluids: array<WindFluid, ", sward::wind::MAX_FLUIDS as f64),
        ("compute/fluid.wgsl", "room: array<vec2<f32>, ", 2.0 * sward::wind::fluid::MOST_SIDE as f64),
        ("footprint.wgsl", "apart >= vec2<i32>(", 1024.0),
        ("footprint.wgsl", "return vec2<i32>(", f64::from(i32::MAX / 2)),
        ("noise.wgsl", "(texel + 1u) & vec2<u32>(", f64::from(sward::wind::TILE_SIDE as u32 - 1)),
        ("noise.wgsl", "wind_tile_load(texel.y * ", f64::from(sward::wind::TILE_SIDE as u32)),
    ]
}

/// A number as either language writes it, as f32 would hold it.
fn number(text: &str) -> Option<f64> {
    let text = text.trim().replace('_', "");
    if let Some(hex) = text.strip_prefix("0x") {
        return u32::from_str_radix(hex.trim_end_matches('u'), 16).ok().map(f64::from);
    }
    let text = text.trim_end_matches("f32").trim_end_matches(['u', 'f', 'i']);
    text.parse::<f64>().ok().map(|value| if value.fract() == 0.0 { value } else { f64::from(value as f32) })
}

/// `const NAME: type = value;` in a text of either language.
fn declared<'a>(text: &'a str, name: &str) -> Option<&'a str> {
    let declarations = text.lines().filter_map(|line| line.split_once("const ").map(|(_, rest)| rest));
    declarations.filter_map(|rest| rest.split_once(':')).find(|(found, _)| *found == name)?.1.split_once('=')?.1.split(';').next()
}

fn own_sources() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/src"))
}

fn rust_source(file: &str) -> String {
    let read = |folder: &Path| std::fs::read_to_string(folder.join(file));
    read(core_sources()).or_else(|_| read(own_sources())).unwrap_or_else(|error| panic!("{file}: {error}"))
}

fn all_wgsl() -> Vec<(String, String)> {
    let mut files = Vec::new();
    wgsl_files(core_sources(), &mut files);
    wgsl_files(own_sources(), &mut files);
    files
}

fn expected(origin: &Origin) -> Option<f64> {
    match origin {
        Value(value) => Some(*value),
        Source(file, name) => Some(declared(&rust_source(file), name).and_then(number).unwrap_or_else(|| panic!("no {name} in {file}"))),
        Alone => None,
    }
}

#[test]
fn constants_have_one_value() {
    let files = all_wgsl();
    for (name, origin) in constants() {
        let Some(wanted) = expected(&origin) else { continue };
        let found: Vec<f64> = files.iter().filter_map(|(_, text)| declared(text, name)).filter_map(number).collect();
        assert!(!found.is_empty(), "{name} stands in no .wgsl file: remove it from constants()");
        assert!(found.iter().all(|value| *value == wanted), "{name} is {found:?} in WGSL and {wanted} in Rust");
    }
}

#[test]
fn no_constant_is_forgotten() {
    let known: Vec<&str> = constants().into_iter().map(|(name, _)| name).collect();
    for (path, text) in all_wgsl() {
        for line in text.lines().filter_map(|line| line.strip_prefix("const ")) {
            let name = line.split([':', ' ', '=']).next().unwrap_or_default();
            assert!(known.contains(&name), "{path}: add {name} to constants(), with its Rust twin");
        }
    }
}

#[test]
fn numbers_without_a_name_have_one_value() {
    let files = all_wgsl();
    for (file, before, wanted) in written_out() {
        let (_, text) = files.iter().find(|(path, _)| path.ends_with(file)).unwrap_or_else(|| panic!("no {file}"));
        let numbers: Vec<_> =
            text.split(before).skip(1).map(|rest| number(rest.split([',', ')', ';', '>', ' ']).next().unwrap_or(""))).collect();
        assert!(!numbers.is_empty(), "{file} says no longer \"{before}\"");
        assert!(numbers.iter().all(|value| *value == Some(wanted)), "{file}: \"{before}\" is followed by {numbers:?}, Rust says {wanted}");
    }
}

/// The comparison must be able to fail.
#[test]
fn a_changed_constant_is_noticed() {
    let text = "const A: f32 = 0.4;\n    pub(super) const B: u32 = 7;";
    assert_eq!(declared(text, "A").and_then(number), Some(f64::from(0.4_f32)));
    assert_eq!(declared(text, "B").and_then(number), Some(7.0));
    assert_ne!(declared(text, "A").and_then(number), number("0.41"));
    assert_eq!(declared(text, "C"), None);
    assert_eq!(number("0xffffffffu"), Some(f64::from(u32::MAX)));
}
