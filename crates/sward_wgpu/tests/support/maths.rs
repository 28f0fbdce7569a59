//! Twins of the maths, hashes, wind, terrain, placement, spines and contact.

use std::sync::Arc;

use libtest_mimic::Failed;
use sward::geometry::billboard;
use sward::growth::{self, GrowthRecord, cover_at};
use sward::interaction::{self, contact_at};
use sward::math;
use sward::model::NoAssets;
use sward::placement::{self, Growing, PlacementParameters};
use sward::plan::StandPlan;
use sward::scene::Scene;
use sward::scene::{Change, Edit, Raise};
use sward::terrain::{self, Terrain, TerrainGrid};
use sward::wind::fluid::{FluidSource, FluidState};
use sward::wind::{self, Flow, Footprint, Images, Source, Tile, WindField};
use sward::world::World;
use sward_wgpu::compare::Tolerance;
use sward_wgpu::gpu::Gpu;

use crate::adapter::Verdict;
use crate::kernels::{By, Random, Twin, bits};

/// Every number within a few roundings: a GPU may fuse a product and a sum, and divides to 2.5 units in the last place.
pub(crate) const ROUNDING: Tolerance = Tolerance { p999: 1e-6, rms: 2e-7, outlier: 3e-6, share: 0.0 };

/// e^x, sin, cos, tan, atan, atan2 and the cube root, relative to the result: WGSL text and Rust text are the same polynomial.
pub(crate) fn small_maths(gpu: &Gpu) -> Verdict {
    let library = &[math::WGSL];
    let rust = |n: u32, input: &mut Vec<u32>| {
        let mut random = Random::new(n);
        let (power, angle, slope, cube) =
            (random.float(-80.0, 80.0), random.float(-1.57, 1.57), random.float(-9.0, 9.0), random.float(-1e4, 1e4));
        let (y, x) = (random.float(-1.0, 1.0), random.float(-1.0, 1.0));
        input.extend(random.words);
        let (sine, cosine) = math::sin_cos(angle);
        bits([math::exp(power), sine, cosine, math::tan(angle), math::atan(slope), math::cbrt(cube), math::atan2(y, x)])
    };
    let host = "fn twin() {
        put_f(math_exp(next_f()));
        let angle = next_f();
        put_v(math_sin_cos(angle));
        put_f(math_tan(angle));
        put_f(math_atan(next_f()));
        put_f(math_cbrt(next_f()));
        let y = next_f();
        put_f(math_atan2(y, next_f()));
    }";
    // Where a fold turns on the last bit, both branches are right but rounded apart; cos near π/2 keeps the digits of π/2 − x.
    let tolerance = Tolerance { p999: 5e-7, rms: 1e-7, outlier: 2e-6, share: 1e-5 };
    Twin { name: "maths", library, host, tables: &[], rust }.check(gpu, By::Relative(tolerance, 1e-3))
}

/// Hashes are whole numbers, and `unit` is exact.
pub(crate) fn hashes(gpu: &Gpu) -> Verdict {
    let rust = |n: u32, input: &mut Vec<u32>| {
        let mut random = Random::new(n);
        let [seed, x, z, cell, purpose] = [0; 5].map(|_: u32| random.any());
        input.extend(random.words);
        let hash = math::hash(seed, x as i32, z as i32, cell, purpose);
        vec![hash, math::unit(hash).to_bits()]
    };
    let host = "fn twin() {
        let seed = next_u();
        let x = next_i();
        let z = next_i();
        let cell = next_u();
        let h = math_hash(seed, x, z, cell, next_u());
        put_u(h);
        put_f(math_unit(h));
    }";
    Twin { name: "hash", library: &[math::WGSL], host, tables: &[], rust }.check(gpu, By::Bits)
}

/// Wind at nodes and between them, and β_eq; phases are whole numbers, so gusts of 15 m/s differ by rounding of the blend only.
pub(crate) fn wind_nodes_and_places(gpu: &Gpu) -> Verdict {
    let sources = [
        Source::Natural { velocity: [11.0, 3.0], turbulence: 0.35 },
        Source::Natural { velocity: [-2.0, 5.0], turbulence: 0.5 },
        Source::Uniform { velocity: [0.0, 2.0] },
    ];
    let mut field = WindField::at(&sources, 123_456_789, 1.0 / 60.0, 0.5);
    let mut images = Images::default();
    let mut random = Random::new(u32::MAX - 1);
    let painted: Vec<[f32; 2]> = (0..9 * 9).map(|_| [random.drawn(-1.0, 1.0), random.drawn(-1.0, 1.0)]).collect();
    let painted = Flow::Image(images.add(9, &painted));
    let prints = [(Flow::Outward, [12.3, 4.0]), (Flow::Swirl, [-6.0, 20.0]), (painted, [3.0, 3.7]), (painted, [40.0, 17.1])];
    for (flow, centre) in prints {
        field.footprints.extend(Footprint::new(flow, &images, centre, [0.8, -0.6], 14.0, 9.0, 32, 0.5));
    }
    let mut texels = [Tile::shipped().texels(), images.texels()].concat();
    field.images = Arc::new(images);
    // A coarse flow now, a fine one between two steps.
    for (cells, behind) in [(32_u32, 0.0), (128, 0.3)] {
        let fluid = sward::scene::Fluid { side: 0.7 * cells as f32, cells, ..Default::default() };
        let source = FluidSource::new(&fluid, 1.0 / 60.0, texels.len() as u32);
        let mut chance = || -> Vec<[f32; 2]> { (0..cells * cells).map(|_| [random.drawn(-0.5, 0.5), random.drawn(-0.5, 0.5)]).collect() };
        let flow = FluidState { now: Arc::new(chance()), before: Arc::new(chance()) };
        // Which of two places is the present one goes by the number of the step.
        texels.extend(flow.before.iter().chain(&*flow.now));
        field.fluids.push(source.field(&flow, 123_456_789, behind, 0.5));
    }
    let block = field.block(32);
    let rust = |n: u32, input: &mut Vec<u32>| {
        let mut random = Random::new(n);
        let far = if n.is_multiple_of(2) { 9000 } else { 2 };
        let patch = [random.whole(-far, far), random.whole(-far, far)];
        let node = [random.whole(-1, 34), random.whole(-1, 34)];
        let local = [random.float(-8.0, 40.0), random.float(-8.0, 40.0)];
        input.extend(random.words);
        let phases = field.patch_phases(patch, 32);
        let at_node = field.velocity(&phases, node);
        let [x, z] = field.velocity_local(&phases, local);
        let [bx, bz] = wind::equilibrium(at_node, 0.0356);
        bits([at_node[0], at_node[1], x, z, bx, bz])
    };
    let host = "
    @group(0) @binding(2) var<storage, read> tile: array<vec2<f32>>;
    @group(0) @binding(3) var<storage, read> wind: WindBlock;
    fn wind_tile_load(index: u32) -> vec2<f32> { return tile[index]; }
    fn twin() {
        let patch_index = next_w();
        let node = next_w();
        let local = next_v();
        let at_node = wind_at_node(patch_index, node, false);
        let between = wind_at(patch_index, local, false);
        put_v(at_node);
        put_v(between);
        put_v(wind_equilibrium(at_node, 0.0356));
    }";
    let tables = &[bytemuck::cast_slice(&texels), bytemuck::bytes_of(&block)];
    // Between nodes a place of 40 m is rounded to 5 µm, over which the finest gust changes by 5e-5 m/s at most.
    let tolerance = Tolerance { p999: 2e-5, rms: 4e-6, outlier: 1e-4, share: 0.0 };
    Twin { name: "wind", library: &[math::WGSL, wind::WGSL, wind::SUM_WGSL], host, tables, rust }.check(gpu, By::Absolute(tolerance))
}

/// Heights to 10 µm and slopes to 1e-5 on hills of 60 m, mirrored edges included.
pub(crate) fn terrain_heights(gpu: &Gpu) -> Verdict {
    terrain_of(gpu, "terrain", terrain::Detail::NONE, &[])
}

/// The same with octaves of noise on top, anchored elsewhere.
pub(crate) fn terrain_detail(gpu: &Gpu) -> Verdict {
    let detail = sward::scene::Detail { amplitude: 2.0, wavelength: 3.0, octaves: 6, roughness: 0.6, seed: 7 };
    terrain_of(gpu, "detail", terrain::Detail::new(&detail, [17.3, -5.1]), &[])
}

/// A hill on it and a trench through that; half of the places lie near them.
pub(crate) fn terrain_edits(gpu: &Gpu) -> Verdict {
    let raise = |at, radius, height| Edit { at, radius, change: Change::Raise(Raise { height }), ..Edit::default() };
    let edits = [raise([20.0, -30.0], 60.0, 12.0), raise([35.0, -20.0], 9.0, -4.0)];
    terrain_of(gpu, "edits", terrain::Detail::NONE, &edits)
}

fn terrain_of(gpu: &Gpu, name: &'static str, detail: terrain::Detail, edits: &[Edit]) -> Verdict {
    let mut random = Random::new(u32::MAX);
    let heights: Vec<f32> = (0..40 * 30).map(|_| random.drawn(0.0, 60.0)).collect();
    let mut ground = Terrain::new(heights.clone(), 40, 30, [2.5, 3.5], [-50.0, -40.0])?.with_detail(detail);
    for edit in edits {
        ground.edit(edit)?;
    }
    let samples = [&heights, ground.edits().heights()].concat();
    let reach = if edits.is_empty() { 400.0 } else { 90.0 };
    let grid: TerrainGrid = ground.grid();
    let rust = |n: u32, input: &mut Vec<u32>| {
        let mut random = Random::new(n);
        let anchor = ground.anchor([0, 1].map(|_| f64::from(random.drawn(-reach, reach))));
        input.extend(anchor.index.map(|k| k as u32));
        let local = [random.float(-2.0, 34.0), random.float(-2.0, 34.0)];
        input.extend(anchor.fraction.map(f32::to_bits));
        input.extend(anchor.detail_cell.map(|k| k as u32));
        input.extend(anchor.detail_way.map(f32::to_bits));
        input.extend(anchor.edit_index.map(|k| k as u32));
        input.extend(anchor.edit_fraction.map(f32::to_bits));
        input.extend(random.words);
        let (height, [x, z]) = ground.height_and_gradient(anchor, local);
        bits([height, x, z])
    };
    let host = "
    @group(0) @binding(2) var<storage, read> heights: array<f32>;
    @group(0) @binding(3) var<storage, read> grid: TerrainGrid;
    fn terrain_load(index: i32) -> f32 { return heights[index]; }
    fn twin() {
        let index = next_w();
        let fraction = next_v();
        let cell = next_w();
        let way = next_v();
        let edit = next_w();
        let anchor = TerrainAnchor(index, fraction, cell, way, edit, next_v());
        let place = terrain_height_and_gradient(grid, anchor, next_v());
        put_f(place.x);
        put_v(place.yz);
    }";
    let tables: &[&[u8]] = &[bytemuck::cast_slice(&samples), bytemuck::bytes_of(&grid)];
    // At a sample the two sides of the spline meet; a place rounded to either side differs in nothing but rounding.
    let tolerance = Tolerance { p999: 6e-5, rms: 1e-5, outlier: 2e-4, share: 0.0 };
    Twin { name, library: &[math::WGSL, terrain::WGSL], host, tables, rust }.check(gpu, By::Absolute(tolerance))
}

/// Whether a plant stands is decided by a comparison with a smooth number: one in 10⁵ may fall the other way.
pub(crate) fn plants_placed(gpu: &Gpu) -> Verdict {
    let parameters = PlacementParameters {
        seed: 77,
        cells: 64,
        spacing: 0.25,
        cover: 0.8,
        height: [0.3, 0.5],
        clumping: 0.45,
        clumps: 3,
        lean: [0.7, -0.5],
        messiness: 0.8,
        unused: 0.0,
    };
    let rust = |n: u32, input: &mut Vec<u32>| {
        let mut random = Random::new(n);
        let patch = [random.whole(-9000, 9000), random.whole(-9000, 9000)];
        let cell = [random.whole(0, 64) as u32, random.whole(0, 64) as u32];
        let (share, combed) = (random.whole(0, 256) as u8, random.whole(0, 2) as u8);
        let growing = Growing { share, combed, lean: [0, 1].map(|_| random.whole(-127, 128) as i8) };
        let (yaw, lean) = (random.float(0.0, 6.3), random.float(0.0, 0.5));
        input.extend(random.words);
        match placement::plant(&parameters, patch, cell).and_then(|plant| placement::grown(plant, growing)) {
            Some(plant) => {
                let stands = placement::combed(yaw, lean, plant.lean);
                bits([
                    1.0,
                    plant.root[0],
                    plant.root[1],
                    plant.height,
                    plant.yaw,
                    plant.tint,
                    plant.lean[0],
                    plant.lean[1],
                    stands.0,
                    stands.1,
                ])
            }
            None => bits([0.0; 10]),
        }
    };
    let host = "
    @group(0) @binding(2) var<storage, read> parameters: PlacementParameters;
    fn twin() {
        let patch_index = next_w();
        let cell = vec2<u32>(next_w());
        let share = vec2<u32>(next_w());
        let growing = vec4<u32>(share, vec2<u32>(next_w()) & vec2<u32>(0xffu));
        let plant = placement_grown(placement_plant(parameters, patch_index, cell), growing);
        let yaw = next_f();
        let stands = placement_combed(yaw, next_f(), plant.lean);
        let present = f32(plant.present);
        put_f(present);
        put_v(present * plant.root);
        put_f(present * plant.height);
        put_f(present * plant.yaw);
        put_f(present * plant.tint);
        put_v(present * plant.lean);
        put_v(present * stands);
    }";
    let tables: &[&[u8]] = &[bytemuck::bytes_of(&parameters)];
    let tolerance = Tolerance { p999: 2e-6, rms: 1e-2, outlier: 4e-6, share: 1e-5 };
    Twin { name: "placement", library: &[math::WGSL, placement::WGSL], host, tables, rust }.check(gpu, By::Absolute(tolerance))
}

/// Lines, polygons and pictures, sharp, soft and blurred, inside, near and outside.
pub(crate) fn growth_covers(gpu: &Gpu) -> Verdict {
    let square = [[-6.0, -4.0, 7.0, -5.0], [7.0, -5.0, 2.0, 0.0], [2.0, 0.0, 6.0, 8.0], [6.0, 8.0, -6.0, -4.0]];
    let edges: Vec<[f32; 4]> = [[-9.0, 3.0, 1.0, 5.0], [1.0, 5.0, 9.0, -7.0]].into_iter().chain(square).collect();
    let shades: Vec<f32> = (0..35).map(|k| ((k * 97) % 256) as f32 / 255.0).collect();
    let (low, high) = ([-11.0, -9.0], [11.0, 9.0]);
    let made = |kind, first, count, rows, soft| GrowthRecord {
        kind,
        first,
        count,
        rows,
        low,
        high,
        soft,
        half_width: 1.7,
        outside: 0.8,
        share: 1.0,
        colour: [0.5; 3],
        unused: 0.0,
    };
    let records = [made(0, 0, 2, 0, 0.0), made(0, 0, 2, 0, 2.5), made(1, 2, 4, 0, 1.2), made(2, 0, 7, 5, 0.0)];
    let rust = |n: u32, input: &mut Vec<u32>| {
        let mut random = Random::new(n);
        let which = random.whole(0, 4);
        let at = [random.float(-12.0, 12.0), random.float(-10.0, 10.0)];
        let blur = random.float(0.02, 0.6);
        input.extend(random.words);
        let shade = |index: u32| shades[index as usize];
        bits([cover_at(&records[which as usize], at, blur, |index| edges[index as usize], shade)])
    };
    let host = "
    @group(0) @binding(2) var<storage, read> records: array<GrowthRecord>;
    @group(0) @binding(3) var<storage, read> edges: array<vec4<f32>>;
    @group(0) @binding(4) var<storage, read> shades: array<f32>;
    fn growth_edge(index: u32) -> vec4<f32> { return edges[index]; }
    fn growth_texel(index: u32) -> f32 { return shades[index]; }
    fn twin() {
        let which = next_i();
        let at = next_v();
        put_f(growth_cover(records[which], at, next_f()));
    }";
    let tables: &[&[u8]] = &[bytemuck::cast_slice(&records), bytemuck::cast_slice(&edges), bytemuck::cast_slice(&shades)];
    // At the rim of a bounding box a rounding decides between outside and a cover of nearly that.
    let tolerance = Tolerance { p999: 2e-4, rms: 1e-2, outlier: 1e-3, share: 1e-3 };
    Twin { name: "growth", library: &[growth::WGSL], host, tables, rust }.check(gpu, By::Absolute(tolerance))
}

/// Ends of segments of 10 cm, upright ones included.
pub(crate) fn segments(gpu: &Gpu) -> Verdict {
    let rust = |n: u32, input: &mut Vec<u32>| {
        let mut random = Random::new(n);
        let reach = if n.is_multiple_of(10) { 2e-6 } else { 1.6 };
        let bend = [random.float(-reach, reach), random.float(-reach, reach)];
        input.extend(random.words);
        bits(billboard::segment(bend, 0.1))
    };
    let host = "fn twin() {
        let end = billboard_segment(next_v(), 0.1);
        put_v(end.xy);
        put_f(end.z);
    }";
    let library = &[math::WGSL, billboard::WGSL];
    Twin { name: "segment", library, host, tables: &[], rust }.check(gpu, By::Absolute(ROUNDING))
}

/// Footprints of every shape in the middle of a turn, on a scene of their own.
fn footprints() -> Result<StandPlan, Failed> {
    let text = include_str!("../../../../scenes/crossing.ron");
    let mut world = World::new(Scene::parse(text, "crossing.ron")?, &NoAssets)?;
    world.state.step = 180;
    world.plan();
    world.state.step = 181;
    let mut plan = world.plan();
    plan.stands.pop().ok_or_else(|| "the scene has a stand".into())
}

/// Inside or outside is decided in whole numbers, so it is equal; where two edges are equally near, roundings choose the normal.
pub(crate) fn contacts(gpu: &Gpu) -> Verdict {
    let plan = footprints()?;
    let rust = |n: u32, input: &mut Vec<u32>| {
        let mut random = Random::new(n);
        let which = random.whole(0, plan.contacts.len() as i32);
        let contact = &plan.contacts[which as usize];
        let cell = [random.whole(0, contact.size[0]), random.whole(0, contact.size[1])];
        let ground = random.float(-0.3, 0.3);
        input.extend(random.words);
        let edges = &plan.edges[contact.edge_first as usize..][..contact.edge_count as usize];
        match contact_at(contact, edges, cell, ground, 0.4) {
            Some(hit) => {
                bits([1.0, hit.speed, hit.direction[0], hit.direction[1], hit.along, hit.height, hit.normal[0], hit.normal[1], hit.depth])
            }
            None => bits([0.0; 9]),
        }
    };
    let host = "
    @group(0) @binding(2) var<storage, read> contacts: array<Contact>;
    @group(0) @binding(3) var<storage, read> edges: array<ContactEdge>;
    fn contact_edge(index: u32) -> ContactEdge { return edges[index]; }
    fn twin() {
        let which = next_u();
        let cell = next_w();
        let hit = contact_at(contacts[which], cell, next_f(), 0.4);
        let touches = f32(hit.touches);
        put_f(touches);
        put_f(select(0.0, hit.speed, hit.touches));
        put_v(touches * hit.direction);
        put_f(touches * hit.along);
        put_f(touches * hit.height);
        put_v(select(vec2<f32>(0.0), hit.normal, hit.touches));
        put_f(select(0.0, hit.depth, hit.touches));
    }";
    let tables: &[&[u8]] = &[bytemuck::cast_slice(&plan.contacts), bytemuck::cast_slice(&plan.edges)];
    let tolerance = Tolerance { p999: 5e-6, rms: 5e-3, outlier: 2e-5, share: 1e-4 };
    Twin { name: "contact", library: &[math::WGSL, interaction::WGSL], host, tables, rust }.check(gpu, By::Absolute(tolerance))
}
