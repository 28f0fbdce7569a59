//! What each kernel costs by itself, in cells (or plants) a second on one thread: `cargo bench -p sward --bench kernels`.
//!
//! One patch of 128 × 128 cells of meadow on a slope, in the widest instructions of the machine where the step uses those. The state fits
//! into the second cache, so this is arithmetic; `traffic` measures the step against memory.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use sward::geometry::billboard::spine;
use sward::interaction::{ABREAST, contact_at};
use sward::lanes::{Lanes, Simd, Work};
use sward::model::NoAssets;
use sward::placement::plant;
use sward::plan::StandPlan;
use sward::response::StandModel;
use sward::response::continuum::{self, Rest, Rows, bends, cascade, limit_row, rates};
use sward::scene::Scene;
use sward::wind::fluid::{FluidSource, FluidState};
use sward::world::World;

/// Cells of a row.
const CELLS: usize = 128;
/// Cells of a patch.
const AREA: usize = CELLS * CELLS;

/// A moving truck in gusty wind on a meadow, some steps on.
fn world() -> (World, StandPlan) {
    let text = "(version: 1, stands: [(species: Meadow, cells: 128)], wind: [Natural()],
        interactors: [(shape: Truck, path: Circle(radius: 6, speed: 5))])";
    let mut world = World::new(Scene::parse(text, "bench.ron").expect("valid"), &NoAssets).expect("valid");
    for _ in 0..30 {
        world.step();
    }
    let plan = world.plan().stands.swap_remove(0);
    (world, plan)
}

/// A smooth field: nothing is at rest, nothing at its limit.
fn smooth(count: usize, phase: f32) -> Vec<f32> {
    (0..count).map(|k| 0.2 * ((k % (CELLS + 2)) as f32 * 0.05 + (k / CELLS) as f32 * 0.03 + phase).sin()).collect()
}

/// Every row of a patch, one step on.
struct Wave<'a> {
    stand: &'a StandModel,
    now: &'a [Vec<f32>; 4],
    rest: &'a [Vec<f32>; 2],
    old: &'a mut [Vec<f32>; 4],
}

impl Work for Wave<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let co = &self.stand.coefficients;
        let ([mut keep, mut spread], mut squares) = ([[0.0; CELLS]; 2], [0; CELLS]);
        for first in (0..AREA).step_by(CELLS) {
            let row = |plane: usize, length: usize| [&self.now[plane][first..first + length], &self.now[plane + 1][first..first + length]];
            let around = |plane: usize| Rows { before: row(plane, CELLS), middle: row(plane, CELLS + 2), after: row(plane, CELLS) };
            let rest = [&self.rest[0][first..first + CELLS], &self.rest[1][first..first + CELLS]];
            let [x, z, rate_x, rate_z] = rows(self.old, first);
            black_box(rates(simd, co, &around(2), [rate_x, rate_z], [&mut keep, &mut spread], &mut squares));
            black_box(bends(simd, co, &around(0), rest, [&keep, &spread], [x, z], &mut squares));
        }
    }
}

/// Limits in every row of a patch.
struct Limits<'a> {
    next: &'a mut [Vec<f32>; 4],
    slope: &'a [Vec<f32>; 2],
}

impl Work for Limits<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, _: S) {
        for first in (0..AREA).step_by(CELLS) {
            let slope = [0, 1].map(|axis| &self.slope[axis][first..first + CELLS]);
            black_box(limit_row(&mut rows(self.next, first), slope, &[]));
        }
    }
}

/// A step of the upper segments of a patch.
struct Upper<'a> {
    stand: &'a StandModel,
    bend: &'a [Vec<f32>; 4],
    upper: &'a mut [f32],
}

impl Work for Upper<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, _: S) {
        cascade(&self.stand.lag, [&self.bend[0][..AREA], &self.bend[1][..AREA]], self.upper);
    }
}

/// One row of the four planes.
#[inline(always)]
fn rows(planes: &mut [Vec<f32>; 4], first: usize) -> [&mut [f32]; 4] {
    planes.each_mut().map(|plane| &mut plane[first..first + CELLS])
}

fn response(criterion: &mut Criterion) {
    let (world, plan) = world();
    let stand = &world.model.stands[0];
    let mut group = criterion.benchmark_group("response");
    group.throughput(Throughput::Elements(AREA as u64));
    let planes = |phase: f32| [0.0, 1.0, 2.0, 3.0].map(|plane| smooth(AREA + 2, phase + plane));
    let (now, mut old) = (planes(0.0), planes(0.1));
    let pair = |phase: f32| [smooth(AREA, phase), smooth(AREA, phase + 1.0)];
    let (rest, slope) = (pair(0.5), pair(0.7));
    group.bench_function("rates and bends", |bencher| {
        bencher.iter(|| Lanes::default().run(Wave { stand, now: &now, rest: &rest, old: &mut old }));
    });
    let mut next = planes(0.2);
    group.bench_function("limit_row", |bencher| bencher.iter(|| Lanes::default().run(Limits { next: &mut next, slope: &slope })));
    let mut upper = smooth(2 * AREA * (stand.lag.segments as usize - 1), 0.3);
    group.bench_function("cascade", |bencher| bencher.iter(|| Lanes::default().run(Upper { stand, bend: &now, upper: &mut upper })));
    let mut out = [vec![0.0; CELLS], vec![0.0; CELLS]];
    group.bench_function("rest, nodes and rows", |bencher| {
        bencher.iter(|| {
            let rest = Rest::of(&plan.wind, [3, 5], stand.cells, stand.species.continuum.wind);
            for j in 0..CELLS as i32 {
                let [x, z] = out.each_mut();
                rest.row(j, [x, z]);
                black_box(&out);
            }
        });
    });
    group.finish();
}

/// The cells of every footprint of the truck, those inside and those beside it.
fn touch(criterion: &mut Criterion) {
    let (world, plan) = world();
    let stand = &world.model.stands[0];
    let sizes = plan.contacts.iter().map(|contact| i64::from(contact.size[0]) * i64::from(contact.size[1]));
    let cells = sizes.sum::<i64>() as u64;
    assert!(cells > 0, "the truck touches the meadow");
    let mut group = criterion.benchmark_group("interaction");
    group.throughput(Throughput::Elements(cells));
    group.bench_function("contact", |bencher| {
        bencher.iter(|| {
            let mut hits = Vec::new();
            for by in &plan.contacts {
                let edges = &plan.edges[by.edge_first as usize..][..by.edge_count as usize];
                for cell in (0..by.size[1]).flat_map(|v| (0..by.size[0]).map(move |u| [u, v])) {
                    hits.extend(contact_at(by, edges, cell, 0.0, stand.coefficients.plant_height));
                }
            }
            for hits in hits.chunks(ABREAST) {
                let pushes = continuum::pushes(&stand.coefficients, hits.iter().map(|hit| ([0.1, 0.2], hit)));
                let one = |hit| continuum::touch([0.1, 0.2], [0.0, 0.0], std::iter::once(hit));
                let touches: Vec<_> = hits.iter().zip(pushes).filter_map(one).collect();
                for held in continuum::held(&stand.coefficients, &touches) {
                    black_box(held);
                }
            }
        });
    });
    group.finish();
}

fn plants(criterion: &mut Criterion) {
    let (world, _) = world();
    let stand = &world.model.stands[0];
    let mut group = criterion.benchmark_group("plants");
    group.throughput(Throughput::Elements(AREA as u64));
    let cells = || (0..CELLS as u32).flat_map(|j| (0..CELLS as u32).map(move |i| [i, j]));
    group.bench_function("placement", |bencher| {
        bencher.iter(|| {
            for cell in cells() {
                black_box(plant(&stand.placement, [3, 5], cell));
            }
        });
    });
    let bends = vec![[0.2, 0.1]; stand.lag.segments as usize];
    group.bench_function("spine", |bencher| {
        bencher.iter(|| {
            for [i, j] in cells() {
                black_box(spine([i as f32, 0.0, j as f32], 0.4, black_box(&bends), |x, _| 0.1 * x));
            }
        });
    });
    group.finish();
}

/// A step of air that flows, of the usual size and of the finest.
fn air(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("air");
    for side in [64_u32, 512] {
        group.throughput(Throughput::Elements(u64::from(side * side)));
        let fluid = FluidSource::new(&sward::scene::Fluid { cells: side, ..Default::default() }, 1.0 / 60.0, 0);
        let mut flow = FluidState::still(side as usize);
        (0..20).for_each(|step| fluid.step(&mut flow, &fluid.plan(step, 1.0, std::iter::empty())));
        let plan = fluid.plan(20, 1.0, std::iter::empty());
        group.bench_function(format!("step, {side} x {side}"), |bencher| bencher.iter(|| fluid.step(&mut flow, black_box(&plan))));
    }
    group.finish();
}

criterion_group!(kernels, response, touch, plants, air);
criterion_main!(kernels);
