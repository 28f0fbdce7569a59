//! Structs that Rust writes and WGSL reads have the same size and the same members at the same places.

use std::mem::offset_of;

use sward::geometry::layers::LayerDraw;
use sward::growth::{GrowthBlock, GrowthRecord};
use sward::interaction::solid::SolidHead;
use sward::interaction::{Contact, ContactEdge};
use sward::picture::aov::AovUniform;
use sward::picture::asked::Asked;
use sward::picture::blade_plan::BladeUniform;
use sward::picture::blades::Blade;
use sward::picture::frame::FrameUniform;
use sward::picture::layers::CutUniform;
use sward::picture::volume::AmbientUniform;
use sward::placement::PlacementParameters;
use sward::plan::Brush;
use sward::response::continuum::{Coefficients, LagCoefficients};
use sward::response::harmonic::HarmonicCoefficients;
use sward::response::oscillator::OscillatorCoefficients;
use sward::shading::blade::BladeStyle;
use sward::shading::look::{Style, Turf};
use sward::state::Root;
use sward::terrain::{TerrainAnchor, TerrainDetail, TerrainGrid};
use sward::wind::fluid::{Drag, FluidBlock, Gust};
use sward::wind::{Footprint, Octave, WindBlock};
use sward_wgpu::compute::blades::{ChainPatch, ChainUniform};
use sward_wgpu::compute::distance_maps::MapDraw;
use sward_wgpu::compute::entries::{AwakePatch, StandUniform};
use sward_wgpu::compute::fluid::FluidStep;
use sward_wgpu::compute::layers::{PlaneStep, Touched};
use sward_wgpu::compute::sheets::{SheetEntry, SheetStep, SheetUniform};
use sward_wgpu::compute::swings::{SwingPatch, SwingStep, SwingUniform};
use sward_wgpu::render::layers::FinishUniform;
use sward_wgpu::render::plants::Plant;
use sward_wgpu::render::prepare::{PatchDraw, PrepareUniform};

use crate::texts::{parse, text_of};

/// Size, and members with their offsets, in bytes.
#[derive(Clone, Debug, PartialEq)]
struct Layout {
    size: usize,
    members: Vec<(String, usize)>,
}

/// The layout of a Rust struct; `field as name` where WGSL calls it otherwise.
macro_rules! layout {
    ($kind:ty { $($field:ident $(as $name:literal)?),* $(,)? }) => {
        Layout {
            size: size_of::<$kind>(),
            members: vec![$(([$($name,)? stringify!($field)][0].to_owned(), offset_of!($kind, $field))),*],
        }
    };
}

/// The layout naga gives a struct of a text.
fn in_wgsl(text: &str, name: &str) -> Layout {
    let module = parse(text).unwrap_or_else(|error| panic!("{error}"));
    let found = module.types.iter().find(|(_, kind)| kind.name.as_deref() == Some(name)).map(|(_, kind)| &kind.inner);
    let Some(naga::TypeInner::Struct { members, span }) = found else { panic!("no struct {name}") };
    let member = |member: &naga::StructMember| (member.name.clone().unwrap_or_default(), member.offset as usize);
    Layout { size: *span as usize, members: members.iter().map(member).collect() }
}

/// Padding may be one array there and several numbers here.
fn without_padding(layout: Layout) -> Layout {
    let is_data = |name: &str| !name.starts_with("unused") && !name.starts_with("reserved");
    Layout { members: layout.members.into_iter().filter(|(name, _)| is_data(name)).collect(), ..layout }
}

/// Name in WGSL, a text that holds it, and the layout in Rust.
fn shared() -> Vec<(&'static str, String, Layout)> {
    let (step, prepare) = (|| text_of("step"), || text_of("prepare"));
    let edge = layout!(ContactEdge { start, along, normal, metres, unused });
    let contact = layout!(Contact {
        size,
        edge_first,
        edge_count,
        shift,
        kind,
        velocity,
        centre,
        yaw_rate,
        spacing,
        start,
        end,
        form,
        rise,
        body,
        highest,
        stays
    });
    let coefficients = layout!(Coefficients {
        base_speed,
        speed_gain,
        speed_cap,
        spread,
        rate_spread,
        damping,
        rate_damping,
        restoring,
        rate_restoring,
        step,
        plant_height,
        turn,
        turn_cosine,
        turn_sine,
        approach,
        unused
    });
    let lag = layout!(LagCoefficients { segments, kind, gain_top, gain_recover, gamma_top, gamma_recover, ring, rate });
    let octave = layout!(Octave { step_x, step_z, phase, per_metre_x, per_metre_z, amplitude, reserved });
    let print = layout!(Footprint { patch as "patch_index", centre, turn, radius, speed, part, kind, first, side });
    let stand = layout!(StandUniform { coefficients, lag, cells, nodes, gusty, level, rest, wind_response, height, frame, spacing, inertia, kappa, reactions, unused as "unused_a" });
    let patch = layout!(AwakePatch {
        slot, lag, held, flags, neighbours, patch as "patch_index", pair_first, pair_count, keep, dither, safe, unused
    });
    let parameters = layout!(PlacementParameters { seed, cells, spacing, cover, height, clumping, clumps, lean, messiness, unused });
    let uniform = layout!(PrepareUniform {
        placement,
        grid,
        camera,
        segments,
        drawn,
        bits,
        layer,
        plain,
        full,
        gone,
        width,
        wind_response,
        fullness,
        behind,
        substeps,
        lag,
        step,
        identity,
        sheet
    });
    let draw = layout!(PatchDraw { offset, patch as "patch_index", anchor, weights, slots, lags, first, count, growth });
    let frame = layout!(FrameUniform {
        view_projection,
        shadow,
        right,
        up,
        forward,
        camera,
        phase,
        sun,
        sun_colour,
        sky,
        ground,
        relief,
        relief_size,
        detail,
        detail_place,
        detail_cell,
        edit,
        edit_size
    });
    let record = layout!(GrowthRecord { kind, first, count, rows, low, high, colour, share, half_width, soft, outside });
    let blades = layout!(BladeUniform { seen, eye, stance, thinning, distances, pieces, rooms, firsts, shape });
    vec![
        ("GrowthRecord", text_of("ground"), record),
        ("GrowthBlock", text_of("ground"), layout!(GrowthBlock { count, first_edge, records })),
        ("ContactEdge", step(), edge),
        ("Contact", step(), contact),
        ("ContinuumCoefficients", step(), coefficients),
        ("LagCoefficients", step(), lag),
        ("WindOctave", step(), octave),
        ("WindFootprint", step(), print),
        (
            "WindBlock",
            step(),
            layout!(WindBlock { mean, count, intervals, octaves, footprint_count, fluid_count, unused, footprints, fluids }),
        ),
        ("WindFluid", step(), layout!(FluidBlock { phase, step, per_metre, now, before, bits, behind })),
        ("FluidGust", text_of("air that flows"), layout!(Gust { at, change, radius, unused })),
        ("FluidDrag", text_of("air that flows"), layout!(Drag { at, half, velocity, turn, leaves, unused })),
        (
            "FluidStep",
            text_of("air that flows"),
            layout!(FluidStep { side, now, next, gusts, drags, cell, width, reach, lasts, fastest, share, unused }),
        ),
        ("HarmonicCoefficients", text_of("waves of meshes"), layout!(HarmonicCoefficients { spread, restoring, damping, gain })),
        ("HarmonicBrush", text_of("waves of meshes"), layout!(Brush { at, half as "half_size", velocity, through, hold })),
        ("PlaneStep", text_of("waves of meshes"), layout!(PlaneStep { co, touch, side, note, dt, unused })),
        ("Touched", text_of("waves of meshes"), layout!(Touched { slot, fresh, wind, brushes, cell_mass, unused })),
        (
            "LayerDraw",
            text_of("layers"),
            layout!(LayerDraw { eye, right, up, forward, window, cell, root, plane, scale, cells, notes, which }),
        ),
        ("Cut", text_of("cut"), layout!(CutUniform { place, eye, right, up, forward, grid, crown, size, edges, depths })),
        ("Finish", text_of("cut"), layout!(FinishUniform { colour, kind })),
        ("Stand", step(), stand),
        ("AwakePatch", step(), patch),
        ("PlacementParameters", prepare(), parameters),
        ("TerrainGrid", prepare(), layout!(TerrainGrid { size, inverse_spacing, detail, edit_size, edit_first, edit_inverse_spacing })),
        ("TerrainDetail", prepare(), layout!(TerrainDetail { inverse_wavelength, amplitude, roughness, octaves, seed })),
        ("TerrainAnchor", prepare(), layout!(TerrainAnchor { index, fraction, detail_cell, detail_way, edit_index, edit_fraction })),
        ("Prepare", prepare(), uniform),
        ("PatchDraw", prepare(), draw),
        ("Asked", text_of("ask"), layout!(Asked { local, lean, tall, height, index, which, yaw, stance, curl })),
        ("Plant", prepare(), layout!(Plant { root, height, yaw, width, tint, layer })),
        ("Plant", text_of("plants"), layout!(Plant { root, height, yaw, width, tint, layer })),
        ("Style", text_of("plants"), layout!(Style { root, tip, mean, shape })),
        ("ShadingTurf", text_of("ground"), layout!(Turf { root, tip, mean })),
        ("Frame", text_of("sky"), frame),
        ("Ambient", text_of("sky in surroundings"), layout!(AmbientUniform { place, shape, disc, horizon })),
        ("Blades", text_of("blades, solved"), blades),
        ("Blade", text_of("blades, solved"), layout!(Blade { root, height, yaw, width, tint, twist, slope, draw, rank })),
        ("BladeStyle", text_of("blades"), layout!(BladeStyle { root, tip, light, shape })),
        ("ChainStand", text_of("step blade by blade"), chain_stand()),
        ("ChainStand", text_of("prepare blade by blade"), chain_stand()),
        (
            "ChainPatch",
            text_of("step blade by blade"),
            layout!(ChainPatch {
                slot, lag, flags, entry, patch as "patch_index", solid_first, solid_count, weights, keep, pixels, around, segments
            }),
        ),
        ("Root", text_of("step blade by blade"), layout!(Root { at, length, yaw, lean, curl, unused, slope, more_unused })),
        ("SolidHead", text_of("step blade by blade"), layout!(SolidHead { first, count, moment, body, low, high, centre, turn, radii })),
        ("SheetStep", text_of("step sheet by sheet"), layout!(SheetStep { coefficients, wind, stiffness, reactions, unused })),
        (
            "SheetEntry",
            text_of("step sheet by sheet"),
            layout!(SheetEntry { root, patch as "patch_index", place, fresh, first, count, last, hurry, heading, unused as "unused_a" }),
        ),
        ("SheetStand", text_of("prepare sheet by sheet"), layout!(SheetUniform { coefficients, wind, width, unused })),
        ("MapDraw", text_of("distance maps"), layout!(MapDraw { first, winners, size, half, scale })),
        ("SwingStand", text_of("prepare plant by plant"), layout!(SwingUniform { coefficients, patch_side, unused })),
        (
            "OscillatorCoefficients",
            text_of("step plant by plant"),
            layout!(OscillatorCoefficients { stiffness, damping, scale, curve, spreads, dt, wind, follow, pace, settle, texels }),
        ),
        (
            "SwingStep",
            text_of("step plant by plant"),
            layout!(SwingStep {
                placement,
                coefficients,
                patch_side,
                height,
                level,
                growing,
                now,
                pairs,
                blocks,
                count,
                contacts,
                reactions,
                inertia,
                unused
            }),
        ),
        (
            "SwingPatch",
            text_of("step plant by plant"),
            layout!(SwingPatch { slot, flags, entry, keep, patch as "patch_index", unused, weights, around, unused_more }),
        ),
        ("Aov", text_of("sky, outputs"), layout!(AovUniform { then, eye, size })),
    ]
}

fn chain_stand() -> Layout {
    layout!(ChainUniform { coefficients, virtual_side, blades, cells, dt, patch_side, planes, busy, unused, steady })
}

#[test]
fn struct_layouts_agree() {
    for (name, text, ours) in shared() {
        assert_eq!(without_padding(in_wgsl(&text, name)), without_padding(ours), "{name}");
    }
}

/// A shifted member, a missing one and a wrong size must be noticed.
#[test]
fn a_wrong_layout_is_noticed() {
    let right = layout!(Plant { root, height, yaw, width, tint, layer });
    let theirs = in_wgsl(&text_of("plants"), "Plant");
    assert_eq!(theirs, right);
    assert_ne!(theirs, layout!(Plant { height, root, yaw, width, tint, layer }));
    assert_ne!(theirs, layout!(Plant { root, height, yaw, width, tint }));
    assert_ne!(theirs, Layout { size: right.size + 4, ..right });
}
