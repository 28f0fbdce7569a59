//! The WGSL twins are valid, lay out what they share with Rust alike, and have the same constants.

use std::mem::{offset_of, size_of};

use sward::interaction::distance_map::{self, DistanceMapHead};
use sward::math;
use sward::response::springs::{CLEAR, MOST_VERTICES, ROUNDS, SPREAD, STEP_WGSL, SheetRoot, SpringsCoefficients, TOLERANCE, TRODDEN, WGSL};

use crate::Test;

pub(crate) const TESTS: &[Test] = &[
    ("the_twins_are_valid_and_lay_out_structs_alike", the_twins_are_valid_and_lay_out_structs_alike),
    ("constants_are_the_same_in_both", constants_are_the_same_in_both),
];

const HOST: &str = "
@group(0) @binding(0) var<storage> maps: array<DistanceMapHead>;
@group(0) @binding(1) var<storage> texels: array<vec4<f32>>;
@group(0) @binding(2) var<storage> models: array<SpringsCoefficients>;
@group(0) @binding(3) var<storage> roots: array<SheetRoot>;
@group(0) @binding(4) var<storage, read_write> words: array<u32>;
fn distance_map_load(index: u32) -> vec4<f32> { return texels[index]; }
fn springs_map(index: u32) -> DistanceMapHead { return maps[index]; }
fn springs_word(k: u32) -> u32 { return words[k]; }
fn springs_put_word(k: u32, word: u32) { words[k] = word; }
";

fn validated(text: &str) -> Result<naga::Module, String> {
    let module = naga::front::wgsl::parse_str(text).map_err(|e| e.emit_to_string(text))?;
    let mut validator = naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty());
    validator.validate(&module).map_err(|e| e.emit_to_string(text))?;
    Ok(module)
}

fn text() -> String {
    [&[math::WGSL, distance_map::WGSL], &WGSL[..], &STEP_WGSL[..]].concat().concat()
}

fn offsets(module: &naga::Module, name: &str) -> Vec<usize> {
    let (_, found) = module.types.iter().find(|(_, t)| t.name.as_deref() == Some(name)).unwrap();
    let naga::TypeInner::Struct { members, span } = &found.inner else { return Vec::new() };
    members.iter().map(|member| member.offset).chain([*span]).map(|bytes| bytes as usize).collect()
}

fn the_twins_are_valid_and_lay_out_structs_alike() {
    let module = validated(&[&text(), HOST].concat()).unwrap_or_else(|error| panic!("{error}"));
    let head = [
        offset_of!(DistanceMapHead, first),
        offset_of!(DistanceMapHead, size),
        offset_of!(DistanceMapHead, moment),
        offset_of!(DistanceMapHead, body),
        offset_of!(DistanceMapHead, centre),
        offset_of!(DistanceMapHead, axes),
        size_of::<DistanceMapHead>(),
    ];
    assert_eq!(offsets(&module, "DistanceMapHead"), head);
    let co = [
        offset_of!(SpringsCoefficients, columns),
        offset_of!(SpringsCoefficients, rows),
        offset_of!(SpringsCoefficients, iterations),
        offset_of!(SpringsCoefficients, cubic),
        offset_of!(SpringsCoefficients, stiffness),
        offset_of!(SpringsCoefficients, recover),
        offset_of!(SpringsCoefficients, dt),
        offset_of!(SpringsCoefficients, unused),
        size_of::<SpringsCoefficients>(),
    ];
    assert_eq!(offsets(&module, "SpringsCoefficients"), co);
    let at = offset_of!(SheetRoot, at);
    let root = [
        at,
        at + 4,
        at + 8,
        offset_of!(SheetRoot, length),
        offset_of!(SheetRoot, half_width),
        offset_of!(SheetRoot, slope),
        offset_of!(SheetRoot, lean),
        offset_of!(SheetRoot, unused),
        size_of::<SheetRoot>(),
    ];
    assert_eq!(offsets(&module, "SheetRoot"), root);
    assert!(validated(&[&text(), "fn wrong() -> f32 { return 1u; }"].concat()).is_err());
    assert!(validated(&text()).is_err(), "without the host's functions it is not complete");
}

/// The value of a constant in the text.
fn constant(text: &str, name: &str) -> f64 {
    let line = text.lines().find(|line| line.starts_with(&format!("const {name}:"))).unwrap_or_else(|| panic!("no {name}"));
    let value = line.split('=').nth(1).unwrap_or_default().trim().trim_end_matches(';').trim_end_matches('u');
    value.parse().unwrap_or_else(|_| panic!("{line}"))
}

fn constants_are_the_same_in_both() {
    let text = text();
    for (name, value) in [
        ("SPRINGS_CLEAR", f64::from(CLEAR)),
        ("SPRINGS_TOLERANCE", f64::from(TOLERANCE)),
        ("SPRINGS_TRODDEN", f64::from(TRODDEN)),
        ("SPRINGS_SPREAD", f64::from(SPREAD)),
        ("SPRINGS_ROUNDS", f64::from(ROUNDS)),
        ("SPRINGS_MOST_VERTICES", MOST_VERTICES as f64),
        ("DISTANCE_MAP_EMPTY", f64::from(distance_map::EMPTY)),
    ] {
        let there = constant(&text, name);
        assert!((there - value).abs() <= 1e-7 * value.abs(), "{name}: {there} and {value}");
    }
}
