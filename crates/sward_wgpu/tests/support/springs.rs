//! Billboards on springs: how points lie to bodies, the pose in the wind, recovery, the surface between vertices, and whole steps.

use std::cell::Cell;

use libtest_mimic::Failed;
use sward::interaction::distance_map::{self, Cube, DistanceMap, DistanceMapHead, contact_at, side};
use sward::math;
use sward::response::springs::{
    self, Faces, MOST_VERTICES, Maps, Sheet, SheetRoot, SpringsCoefficients, Wave, pose, recovered, surface, sway,
};
use sward_wgpu::compare::Tolerance;
use sward_wgpu::gpu::Gpu;

use crate::adapter::{Verdict, ensure};
use crate::distance_maps::{ball, block};
use crate::kernels::{By, Random, Twin, bits};

/// Inputs of the tests that keep sheets: each thread holds several arrays of 81 vertices.
const SHEETS: u32 = 8192;
/// Inputs of the tests of sheets among bodies.
const MOMENTS: u32 = 4096;
/// Places of bodies.
const PLACES: u32 = 256;
/// Vertices of a sheet that are compared, from the first to the last.
const LOOKED_AT: usize = 8;

/// What twins read and write; bodies are [`TABLES`] or [`NO_BODIES`].
const STUBS: &str = "
fn next_springs() -> SpringsCoefficients {
    var co: SpringsCoefficients;
    co.columns = next_u(); co.rows = next_u(); co.iterations = next_u(); co.cubic = next_u();
    co.stiffness = next_f(); co.recover = next_f(); co.dt = next_f(); co.unused = next_u();
    return co;
}
fn next_root() -> SheetRoot {
    var root: SheetRoot;
    root.x = next_f(); root.y = next_f(); root.z = next_f(); root.length = next_f();
    root.half_width = next_v(); root.slope = next_v(); root.lean = next_v(); root.unused = next_v();
    return root;
}
fn put_p(p: vec3<f32>) { put_v(p.xy); put_f(p.z); }
fn put_sheet(co: SpringsCoefficients, sheet: ptr<function, Sheet>) {
    let last = springs_columns(co) * springs_rows(co) - 1u;
    for (var k = 0u; k < 8u; k++) { put_p((*sheet).at[k * last / 7u]); }
}
";
const TABLES: &str = "
@group(0) @binding(2) var<storage, read> texels: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read> heads: array<DistanceMapHead>;
fn distance_map_load(index: u32) -> vec4<f32> { return texels[index]; }
fn springs_map(index: u32) -> DistanceMapHead { return heads[index]; }
";
/// Sheets in a step, in words of a table.
const ROOM: &str = "
var<private> own: u32;
fn springs_word(k: u32) -> u32 { return room[k * COUNT + own]; }
fn springs_put_word(k: u32, word: u32) { room[k * COUNT + own] = word; }
";

fn library() -> Vec<&'static str> {
    [&[math::WGSL], &springs::WGSL[..]].concat()
}

fn library_of_contacts() -> Vec<&'static str> {
    [&library()[..], &[distance_map::WGSL]].concat()
}

fn library_of_steps() -> Vec<&'static str> {
    [&[math::WGSL, distance_map::WGSL], &springs::WGSL[..], &springs::STEP_WGSL].concat()
}

/// A stand of any kind: sheets of 2 × 2 to 9 × 9 vertices.
fn coefficients(random: &mut Random) -> SpringsCoefficients {
    let most = [4, 4, 4, 10][random.bits() as usize % 4];
    let sides = [0; 2].map(|_| 2 + random.bits() % (most - 1));
    let iterations = random.bits() % 4;
    let (stiffness, recover) = (random.drawn(0.3, 1.0), random.drawn(0.5, 4.0));
    let mut co = SpringsCoefficients::new(sides, iterations, stiffness, recover, 1.0 / 60.0);
    co.cubic = random.bits() % 2;
    random.words.extend_from_slice(bytemuck::cast_slice(bytemuck::bytes_of(&co)));
    co
}

/// A billboard on a slope, near the middle of the bodies.
fn root(random: &mut Random) -> SheetRoot {
    let mut pair = |most: f32| [0; 2].map(|_| random.drawn(-most, most));
    let ([x, z], half_width, slope, lean) = (pair(0.6), pair(0.2), pair(0.4), pair(0.2));
    let root =
        SheetRoot { at: [x, random.drawn(-0.2, 0.2), z], length: random.drawn(0.15, 0.8), half_width, slope, lean, unused: [0.0; 2] };
    random.words.extend_from_slice(bytemuck::cast_slice(bytemuck::bytes_of(&root)));
    root
}

/// A sheet bent by up to `most` rad at each end.
fn sheet(random: &mut Random, co: &SpringsCoefficients, root: &SheetRoot, most: f32) -> Sheet {
    let mut bend = || [random.float(-most, most), random.float(-most, most)];
    let bends = [bend(), bend()];
    pose(co, root, bends)
}

fn looked_at(co: &SpringsCoefficients, sheet: &Sheet) -> Vec<f32> {
    let (columns, rows) = co.sides();
    (0..LOOKED_AT).flat_map(|k| sheet.at[k * (columns * rows - 1) / (LOOKED_AT - 1)]).collect()
}

/// A ball and a box, and places where they are at up to three moments of a step.
struct Bodies {
    texels: Vec<[f32; 4]>,
    heads: Vec<DistanceMapHead>,
}

impl Bodies {
    fn new() -> Self {
        let map = |(points, triangles): (Vec<[f32; 3]>, Vec<[u32; 3]>)| {
            let points: Vec<[f32; 3]> = points.iter().map(|point| point.map(|part| 0.6 * part)).collect();
            DistanceMap::new(Cube::around(&points, 32), 32, &points, triangles)
        };
        let maps = [map(ball(24)), map(block())];
        let mut heads = Vec::new();
        for place in 0..PLACES {
            let mut random = Random::new(1_000_000 + place);
            let at = [random.drawn(-0.4, 0.4), random.drawn(-0.1, 0.4), random.drawn(-0.4, 0.4)];
            let (s, c) = math::sin_cos(random.drawn(0.0, 6.0));
            for moment in 0..3 {
                let (body, along) = (place % 2, 0.04 * moment as f32);
                let axes = [[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]];
                let first = body * maps[0].texels.len() as u32;
                let origin = [at[0] + along * s, at[1], at[2] + along * c];
                heads.push(DistanceMapHead::new(&maps[body as usize], first, (moment, body), origin, axes));
            }
        }
        Self { texels: maps.into_iter().flat_map(|map| map.texels).collect(), heads }
    }

    fn tables(&self) -> [&[u8]; 2] {
        [bytemuck::cast_slice(&self.texels), bytemuck::cast_slice(&self.heads)]
    }
}

/// What one face sees below a point, and how a point lies to a body. Where four texels are not of one surface the nearest counts instead of
/// their mean: there rounding may choose. Control: the body a tenth of a millimetre to the side.
pub(crate) fn contacts(gpu: &Gpu) -> Verdict {
    let bodies = Bodies::new();
    let compare = |shift: f32| {
        let rust = |n: u32, input: &mut Vec<u32>| {
            let mut random = Random::new(n);
            let place = random.whole(0, 3 * PLACES as i32) as usize;
            let face = random.whole(0, 6) as u32;
            let mut head = bodies.heads[place];
            let reach = [1.5, 0.6][n as usize % 2] * head.centre[3];
            let at = [0, 1, 2].map(|axis: usize| random.float(head.centre[axis] - reach, head.centre[axis] + reach));
            input.extend(random.words);
            head.centre[0] += shift;
            let seen = side(&head, &bodies.texels, face, head.to_body(at));
            let near = contact_at(&head, &bodies.texels, at);
            let lengths = [math::lower(seen.distance, 1.0), math::lower(seen.depth, 1.0), near.distance];
            bits(lengths.into_iter().chain(seen.normal).chain(near.normal))
        };
        let host = [
            STUBS,
            TABLES,
            "fn twin() {
            let head = heads[next_u()];
            let face = next_u();
            let xy = next_v();
            let at = vec3<f32>(xy, next_f());
            let seen = distance_map_side(head, face, distance_map_to_body(head, at));
            let near = distance_map_contact_at(head, at);
            put_f(math_lower(seen.distance, 1.0));
            put_f(math_lower(seen.depth, 1.0));
            put_f(near.distance);
            put_p(seen.normal);
            put_p(near.normal);
        }",
        ]
        .concat();
        let tolerance = Tolerance { p999: 1e-5, rms: 1e-3, outlier: 1e-4, share: 2e-4 };
        Twin { name: "contacts with maps", library: &library_of_contacts(), host: &host, tables: &bodies.tables(), rust }
            .check(gpu, By::Absolute(tolerance))
    };
    compare(0.0)?;
    ensure(compare(1e-4).is_err(), || "a tenth of a millimetre is not found".to_owned())
}

/// How sheets stand in the wind, and the paper's waves. Control: an end bent by 1 mrad more.
pub(crate) fn poses(gpu: &Gpu) -> Verdict {
    let compare = |more: f32| {
        let rust = |n: u32, input: &mut Vec<u32>| {
            let mut random = Random::new(n);
            let (co, root) = (coefficients(&mut random), root(&mut random));
            let mut pair = |most: f32| [random.float(-most, most), random.float(-most, most)];
            let ([first, last], bend, turns, at) = ([pair(1.5), pair(1.5)], pair(0.3), pair(0.5), pair(16.0));
            let phase = random.any();
            input.extend(random.words);
            let sheet = pose(&co, &root, [first, [last[0] + more, last[1]]]);
            bits(looked_at(&co, &sheet).into_iter().chain(sway(&[Wave { bend, turns, phase }], at)))
        };
        let host = [
            STUBS,
            "fn twin() {
            let co = next_springs();
            let root = next_root();
            let first = next_v();
            var sheet: Sheet;
            springs_pose(co, root, vec4<f32>(first, next_v()), &sheet);
            put_sheet(co, &sheet);
            let bend = next_v();
            let turns = next_v();
            let at = next_v();
            put_v(springs_sway(SpringsWave(bend, turns, next_u(), 0u), at));
        }",
        ]
        .concat();
        // Sums of eight segments; a vertex that just clears the ground may be laid on it.
        let tolerance = Tolerance { p999: 5e-6, rms: 5e-6, outlier: 1e-4, share: 1e-4 };
        Twin { name: "poses in the wind", library: &library(), host: &host, tables: &[], rust }.check_some(
            gpu,
            By::Absolute(tolerance),
            SHEETS,
        )
    };
    compare(0.0)?;
    ensure(compare(1e-3).is_err(), || "a milliradian is not found".to_owned())
}

/// Recovery between two sheets, and points of the surface. Control: a step later.
pub(crate) fn recoveries(gpu: &Gpu) -> Verdict {
    let room = vec![0; 4 * MOMENTS as usize * springs::ROOM as usize * MOST_VERTICES];
    let compare = |later: u32| {
        let rust = |n: u32, input: &mut Vec<u32>| {
            let mut random = Random::new(n);
            let (co, root) = (coefficients(&mut random), root(&mut random));
            let stored = sheet(&mut random, &co, &root, 1.5);
            let target = sheet(&mut random, &co, &root, 0.6);
            let steps = random.whole(0, 260) as u32;
            let place = [random.float(-0.5, 9.0), random.float(-0.5, 9.0)];
            input.extend(random.words);
            let now = recovered(&co, &root, &stored, &target, steps + later);
            bits(looked_at(&co, &now).into_iter().chain(surface::point(&co, &root, &now, place[0], place[1])))
        };
        let host = [
            STUBS,
            "@group(0) @binding(2) var<storage, read_write> room: array<u32>;",
            ROOM,
            "fn twin() {
            own = in_at / READS;
            let co = next_springs();
            let root = next_root();
            for (var sheet = SPRINGS_STORED; sheet <= SPRINGS_STANDING; sheet++) {
                let first = next_v();
                springs_stand(co, root, sheet, first, next_v());
            }
            springs_recover(co, root, SPRINGS_NOW, next_u());
            var now: Sheet;
            for (var k = 0u; k < springs_vertices(co); k++) { now.at[k] = springs_at(SPRINGS_NOW, k); }
            put_sheet(co, &now);
            let place = next_v();
            put_p(springs_point(co, root, &now, place.x, place.y));
        }",
        ]
        .concat();
        // Directions almost opposite turn by way of upright or not, as rounding says.
        let tolerance = Tolerance { p999: 1e-5, rms: 1e-4, outlier: 1e-4, share: 1e-4 };
        let twin =
            Twin { name: "recoveries", library: &[&library()[..], &springs::STEP_WGSL[..1]].concat(), host: &host, tables: &[&room], rust };
        twin.check_some(gpu, By::Absolute(tolerance), MOMENTS)
    };
    compare(0)?;
    ensure(compare(1).is_err(), || "a step later is not found".to_owned())
}

/// Which part of a step is run: its WGSL, and how far roundings may lead.
struct Part<'a> {
    name: &'a str,
    wgsl: &'a str,
    tolerance: Tolerance,
}

/// A sheet among bodies of one moment, `rust` and the part on it; the bodies `shift` m to the side in Rust. Returns how many sheets it changed, as `rust` says.
fn part(
    gpu: &Gpu,
    bodies: &Bodies,
    part: &Part<'_>,
    shift: f32,
    rust: impl Fn(&SpringsCoefficients, &SheetRoot, &Maps<'_>, [f32; 2], &mut Sheet, &mut Faces) -> bool,
) -> Result<u32, Failed> {
    let changed = Cell::new(0);
    let moved = |head: &DistanceMapHead| {
        let [x, y, z, half] = head.centre;
        DistanceMapHead { centre: [x + shift, y, z, half], moment: 0, ..*head }
    };
    let (here, there): (Vec<_>, Vec<_>) = bodies.heads.iter().map(|head| (moved(head), DistanceMapHead { moment: 0, ..*head })).unzip();
    let twin = |n: u32, input: &mut Vec<u32>| {
        let mut random = Random::new(n);
        let (co, root) = (coefficients(&mut random), root(&mut random));
        let mut now = sheet(&mut random, &co, &root, 1.0);
        let (first, count) = (3 * random.whole(0, PLACES as i32) as usize, random.whole(1, 4) as usize);
        let heading = [random.float(-1.0, 1.0), random.float(-1.0, 1.0)];
        input.extend(random.words);
        let mut faces = [0; MOST_VERTICES];
        let changes = rust(&co, &root, &Maps { heads: &here[first..first + count], texels: &bodies.texels }, heading, &mut now, &mut faces);
        changed.set(changed.get() + u32::from(changes));
        bits(looked_at(&co, &now).into_iter().chain([faces.iter().map(|face| f32::from(*face)).sum()]))
    };
    let host = [
        STUBS,
        TABLES,
        "@group(0) @binding(4) var<storage, read_write> room: array<u32>;",
        ROOM,
        "fn twin() {
        own = in_at / READS;
        let co = next_springs();
        let root = next_root();
        let bend = next_v();
        springs_stand(co, root, SPRINGS_NOW, bend, next_v());
        springs_copy(co, SPRINGS_NOW, SPRINGS_BEFORE);
        let first = 3u * next_u();
        let maps = SpringsMaps(first, next_u(), 0u);
        let heading = next_v();
        ",
        part.wgsl,
        "
        let last = springs_vertices(co) - 1u;
        for (var k = 0u; k < 8u; k++) { put_p(springs_at(SPRINGS_NOW, k * last / 7u)); }
        var sum = 0u;
        for (var k = 0u; k < springs_vertices(co); k++) { sum += springs_left(k); }
        put_f(f32(sum));
    }",
    ]
    .concat();
    let room = vec![0; 4 * MOMENTS as usize * springs::ROOM as usize * MOST_VERTICES];
    let tables = [bytemuck::cast_slice(&bodies.texels), bytemuck::cast_slice(&there), &room];
    Twin { name: part.name, library: &library_of_steps(), host: &host, tables: &tables, rust: twin }.check_some(
        gpu,
        By::Absolute(part.tolerance),
        MOMENTS,
    )?;
    Ok(changed.get())
}

/// Checks a part, that it does something, and that a body a millimetre to the side is found.
fn check(
    gpu: &Gpu,
    of: &Part<'_>,
    rust: impl Fn(&SpringsCoefficients, &SheetRoot, &Maps<'_>, [f32; 2], &mut Sheet, &mut Faces) -> bool,
) -> Verdict {
    let bodies = Bodies::new();
    let changed = part(gpu, &bodies, of, 0.0, &rust)?;
    println!("{changed} of {MOMENTS} sheets change");
    ensure(changed > MOMENTS / 8, || format!("{}: only {changed} sheets change", of.name))?;
    ensure(part(gpu, &bodies, of, 1e-3, &rust).is_err(), || format!("{}: a millimetre is not found", of.name))
}

/// Pushes, springs and lengths. Which way out is the nearest, and whether a vertex lies in a body, rounding may decide.
pub(crate) fn pushes(gpu: &Gpu) -> Verdict {
    let wgsl = "springs_push(co, maps, root, 0u, SPRINGS_NOW);
        springs_sweep(co, root, SPRINGS_NOW);
        springs_keep_lengths(co, root, SPRINGS_NOW);";
    let tolerance = Tolerance { p999: 1e-5, rms: 1e-2, outlier: 1e-4, share: 2e-4 };
    check(gpu, &Part { name: "pushes, springs and lengths", wgsl, tolerance }, |co, root, maps, _, sheet, faces| {
        let moved = springs::push(co, root, maps, 0, sheet, faces);
        *sheet = springs::sweep(co, root, sheet, &[false; MOST_VERTICES]);
        springs::pass(co, root, sheet);
        moved
    })
}

/// Columns that lie down, no farther than they may. Whether a vertex lies in a body rounding may decide, at each of six halvings.
pub(crate) fn lays(gpu: &Gpu) -> Verdict {
    let wgsl = "springs_lay(co, maps, root, 0u, SPRINGS_NOW, heading);
        springs_spread(co, root, 1u, SPRINGS_NOW);";
    let tolerance = Tolerance { p999: 1e-5, rms: 1e-2, outlier: 1e-4, share: 2e-4 };
    check(gpu, &Part { name: "columns that lie down", wgsl, tolerance }, |co, root, maps, heading, sheet, faces| {
        let before = *sheet;
        springs::lay(co, root, maps, 0, sheet, faces, heading);
        springs::spread(co, root, 1, &before, sheet);
        *sheet != before
    })
}
