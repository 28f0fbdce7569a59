//! Plants cut into layers: what an eye sees of a plant, at which depths it is cut, and when it must be cut anew.
//!
//! Chen & Johan 2015, §3.2; methods §5. Differs from the paper: every plant is cut by itself, along the line from the eye to it. Turning the camera then
//! cuts nothing anew, going past a plant only this one, and near, middle and far are parts of the plant: its own lag and stiffness are its layers'.
//! Twin of the layers' corners and motion: `layers.wgsl`.

use glam::{DVec3, Vec3};

use super::warp::{Warp, offset};
use crate::math::{clamped, lower, upper};
use crate::scene::Layers;
use crate::state::{Cut, LayeredPlant};

/// Fewest pixels of a plant's height, in a picture of 1080 rows, for one layer a part, and for as many as asked for.
const FEW: [f32; 2] = [50.0, 140.0];
/// Nearest depth at which anything is cut, m.
const NEAREST: f32 = 0.05;
/// Widest that an eye sees of a plant from outside it: half of it, over its distance.
const WIDEST: f32 = 1.8;
/// Beside what a camera sees, how much more of a plant around it is cut: the turn it may make.
const BESIDE: f32 = 1.3;

/// Most that a picture may be enlarged before plants are cut anew.
const ZOOMED: f32 = 1.22;

/// The box around a plant: as its mesh has it, turned and moved to its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Its middle, m.
    pub centre: DVec3,
    /// Half its sides, m.
    pub half: Vec3,
    /// Its x and z axes, unit.
    pub axes: [Vec3; 2],
}

impl Extent {
    /// Of a plant whose mesh lies between `low` and `high`, its root at the origin; in the plant's own height.
    pub fn new(plant: &LayeredPlant, low: [f32; 3], high: [f32; 3]) -> Self {
        let scale = plant.height / high[1].max(1e-3);
        let (low, high) = (Vec3::from(low) * scale, Vec3::from(high) * scale);
        let (sine, cosine) = crate::math::sin_cos(plant.yaw);
        let axes = [Vec3::new(cosine, 0.0, -sine), Vec3::new(sine, 0.0, cosine)];
        let middle = 0.5 * (low + high);
        let centre = DVec3::from(plant.root) + (axes[0] * middle.x + Vec3::Y * middle.y + axes[1] * middle.z).as_dvec3();
        Self { centre, half: (0.5 * (high - low)).max(Vec3::splat(1e-3)), axes }
    }

    /// Radius of the ball around it, m.
    pub fn radius(&self) -> f32 {
        self.half.length()
    }

    /// Its corners from its middle.
    fn corners(&self) -> [Vec3; 8] {
        let [x, z] = self.axes;
        std::array::from_fn(|k| {
            let sign = |bit: usize| if k >> bit & 1 == 0 { -1.0 } else { 1.0 };
            x * (sign(0) * self.half.x) + Vec3::Y * (sign(1) * self.half.y) + z * (sign(2) * self.half.z)
        })
    }

    /// Half of what it takes along a direction, m.
    pub(crate) fn along(&self, direction: Vec3) -> f32 {
        let [x, z] = self.axes;
        (direction.dot(x) * self.half.x).abs() + (direction.y * self.half.y).abs() + (direction.dot(z) * self.half.z).abs()
    }

    /// Half its depth along a direction: a little less than that of the egg within the box, beyond which hardly a leaf is.
    fn depth(&self, along: Vec3) -> f32 {
        let [x, z] = self.axes;
        0.85 * Vec3::new(along.dot(x) * self.half.x, along.y * self.half.y, along.dot(z) * self.half.z).length()
    }
}

/// A camera, as far as cutting asks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eye {
    /// Where it is, m.
    pub at: DVec3,
    /// Where it looks, unit.
    pub forward: Vec3,
    /// Half the height of what it sees 1 m ahead, m.
    pub half: f32,
}

/// Right and up of a view along `forward`, both unit.
pub fn across(forward: Vec3) -> [Vec3; 2] {
    let right = forward.cross(Vec3::Y).normalize_or(Vec3::X);
    [right, right.cross(forward)]
}

impl Eye {
    /// Whether any of a plant may be in a picture, however wide it is up to 21:9.
    pub fn sees(&self, extent: &Extent) -> bool {
        let to = (extent.centre - self.at).as_vec3();
        let (distance, radius) = (to.length(), extent.radius());
        if distance <= radius {
            return true;
        }
        // The cosine of the picture's corner and the ball's rim together.
        let corner = 2.6 * self.half;
        let (sine, out) = (radius / distance, (1.0 + corner * corner).sqrt());
        to.dot(self.forward) >= distance * ((1.0 - sine * sine).sqrt() - corner * sine) / out
    }

    /// How far it has moved since a plant was cut, over its distance from it: radians, for plants that are not near.
    pub fn turned(&self, cut: &Cut, extent: &Extent) -> f32 {
        let moved = (self.at - DVec3::from(cut.eye)).length() as f32;
        let away = upper((extent.centre - self.at).length() as f32 - extent.radius(), 0.3);
        let zoom = 540.0 / self.half / upper(cut.pixels, 1e-3);
        // Within a plant only what the camera saw is cut, and some beside it.
        let around = if cut_whole(cut) { 0.0 } else { (Vec3::from(cut.forward) - self.forward).length() * 0.5 };
        moved / away + if (ZOOMED.recip()..ZOOMED).contains(&zoom) { 0.0 } else { 1.0 } + around
    }

    /// Cuts a plant.
    pub fn cut(&self, extent: &Extent, layers: &Layers, step: u64) -> Cut {
        let to = (extent.centre - self.at).as_vec3();
        let towards = to.normalize_or(self.forward);
        let whole = window(extent, to, towards).filter(|window| window.iter().all(|side| side.abs() < WIDEST));
        let (forward, window) = match whole {
            Some(window) => (towards, window),
            None => {
                let [x, y] = [2.0 * BESIDE * self.half, BESIDE * self.half];
                (self.forward, [-x, -y, x, y])
            }
        };
        let pixels = 540.0 / self.half;
        let high = 2.0 * extent.half.y * pixels / to.length().max(NEAREST);
        let layers = match high {
            _ if high < FEW[0] => [1, 0, 0],
            _ if high < FEW[1] => [1, 1, 1],
            _ => [layers.near as u8, layers.mid as u8, layers.far as u8],
        };
        Cut { eye: self.at.to_array(), forward: forward.to_array(), window, pixels, layers, step }
    }
}

/// Whether a cut holds the whole plant.
fn cut_whole(cut: &Cut) -> bool {
    cut.window[0] != -cut.window[2] || cut.window[1] != -cut.window[3]
}

/// What is seen of a box 1 m ahead: left, bottom, right, top; `None` where some of it is beside or behind the eye.
fn window(extent: &Extent, to: Vec3, forward: Vec3) -> Option<[f32; 4]> {
    let [right, up] = across(forward);
    let mut window = [f32::MAX, f32::MAX, f32::MIN, f32::MIN];
    for corner in extent.corners() {
        let corner = to + corner;
        let depth = corner.dot(forward);
        if depth < NEAREST {
            return None;
        }
        let seen = [corner.dot(right) / depth, corner.dot(up) / depth];
        for axis in 0..2 {
            window[axis] = window[axis].min(seen[axis]);
            window[axis + 2] = window[axis + 2].max(seen[axis]);
        }
    }
    Some(window)
}

/// Depths at which a plant is cut, m from the eye along the cut's forward: the first leaf's, those between layers, the last leaf's; rising.
pub fn depths(cut: &Cut, extent: &Extent, bands: [f32; 2]) -> Vec<f32> {
    let forward = Vec3::from(cut.forward);
    let middle = (extent.centre - DVec3::from(cut.eye)).as_vec3().dot(forward);
    let half = extent.depth(forward);
    let (first, last) = ((middle - half).max(NEAREST), upper(middle + half, 2.0 * NEAREST));
    let parts = cut.layers.map(usize::from);
    // Parts without layers leave their share to those before.
    let ends = match parts {
        [_, 0, 0] => [1.0, 1.0, 1.0],
        [_, 0, _] => [bands[1], bands[1], 1.0],
        [_, _, 0] => [bands[0], 1.0, 1.0],
        _ => [bands[0], bands[1], 1.0],
    };
    let mut edges = vec![first];
    let mut from = 0.0;
    for (count, end) in parts.into_iter().zip(ends) {
        edges.extend((1..=count).map(|k| first + (last - first) * (from + (end - from) * k as f32 / count as f32)));
        from = end;
    }
    edges
}

/// Which layer a leaf belongs to whose root lies at a depth: before the first edge to the first one, behind the last to the last.
pub fn layer_of(edges: &[f32], depth: f32) -> usize {
    let inner = edges.get(1..edges.len().saturating_sub(1)).unwrap_or_default();
    inner.iter().filter(|edge| depth >= **edge).count()
}

/// Layers in WGSL; needs `fn layers_note(index: u32) -> vec2<f32>` and `layers_touch` likewise from its host.
pub const WGSL: &str = include_str!("layers.wgsl");

/// No plane of its own.
pub const NONE: u32 = u32::MAX;

/// A layer to be drawn. The same bytes in WGSL.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct LayerDraw {
    /// The cut's eye, m in frame space; w: depth of the layer, m.
    pub eye: [f32; 4],
    /// Unit; w: left side of the window.
    pub right: [f32; 4],
    /// Unit; w: its bottom.
    pub up: [f32; 4],
    /// Unit; w: share of what it covers that is there, while one cut takes over from another.
    pub forward: [f32; 4],
    /// Right side and top of the window; pieces of the grid along x and y.
    pub window: [f32; 4],
    /// Corner and size of the layer's part of the texture.
    pub cell: [f32; 4],
    /// The plant's root, m in frame space; its height, m.
    pub root: [f32; 4],
    /// The waves' right, unit; w: cells from their corner to the root.
    pub plane: [f32; 4],
    /// m for each m/s, to the right, up, and down for depth; w: stiffness near the root.
    pub scale: [f32; 4],
    /// Cells of a metre, of the waves and of a touched plant's own; share of the older note; cells by which a look-up goes along V.
    pub cells: [f32; 4],
    /// First cells of the younger and the older note; of the touched plant's own plane, or [`NONE`]; cells along a side of the waves.
    pub notes: [u32; 4],
    /// Number of the plant; 1 if outputs tell of it; number of the layer; 1 leaves, 0 wood.
    pub which: [u32; 4],
}

/// A corner of a layer's grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LayerCorner {
    /// m in frame space.
    pub place: Vec3,
    /// In the texture, 0 to 1, v down.
    pub uv: [f32; 2],
}

/// What moves layers: V of cells, as [`LayerDraw::notes`] counts them.
#[derive(Clone, Copy, Debug)]
pub struct Moving<'a> {
    /// Notes of waves, one after the other.
    pub notes: &'a [&'a [[f32; 2]]],
    /// Planes of touched plants.
    pub touches: &'a [crate::state::Waves],
}

fn mix(a: [f32; 2], b: [f32; 2], share: f32) -> [f32; 2] {
    [0, 1].map(|part| a[part] + (b[part] - a[part]) * share)
}

impl Moving<'_> {
    fn wave(&self, first: u32, side: u32, at: [f32; 2]) -> [f32; 2] {
        let cells = self.notes.get((first / (side * side)) as usize).copied().unwrap_or_default();
        let from = at.map(|along| along - 0.5);
        let corner = from.map(f32::floor);
        let n = side as i32;
        let cell = |dx: i32, dy: i32| {
            let [x, y] = [corner[0] as i32 + dx, corner[1] as i32 + dy].map(|along| along.rem_euclid(n));
            cells.get((y * n + x) as usize).copied().unwrap_or_default()
        };
        let share = from[0] - corner[0];
        mix(mix(cell(0, 0), cell(1, 0), share), mix(cell(0, 1), cell(1, 1), share), from[1] - corner[1])
    }

    fn touched(&self, first: u32, at: [f32; 2]) -> [f32; 2] {
        let side = crate::response::harmonic::TOUCH_SIDE;
        let cells = self.touches.get((first / (side * side)) as usize).map_or(&[][..], |waves| &waves.now);
        let most = side as f32 - 1.0;
        let from = at.map(|along| clamped(along - 0.5, 0.0, most));
        let corner = from.map(|along| lower(along.floor(), most - 1.0));
        let cell = |dx: usize, dy: usize| {
            cells.get((corner[1] as usize + dy) * side as usize + corner[0] as usize + dx).copied().unwrap_or_default()
        };
        let share = from[0] - corner[0];
        mix(mix(cell(0, 0), cell(1, 0), share), mix(cell(0, 1), cell(1, 1), share), from[1] - corner[1])
    }

    /// V at a place of a plant, m right of its root along the waves' plane and above it; m/s along the plane.
    pub fn velocity(&self, draw: &LayerDraw, along: f32, up: f32) -> [f32; 2] {
        let side = draw.notes[3];
        let at = [draw.plane[3] + along * draw.cells[0], up * draw.cells[0]];
        let mut velocity = mix(self.wave(draw.notes[0], side, at), self.wave(draw.notes[1], side, at), draw.cells[2]);
        if draw.cells[3] > 0.0 {
            let speed = (velocity[0] * velocity[0] + velocity[1] * velocity[1]).sqrt();
            if speed > 1e-6 {
                let back = draw.cells[3] / speed;
                velocity = self.wave(draw.notes[0], side, [at[0] + velocity[0] * back, at[1] + velocity[1] * back]);
            }
        }
        if draw.notes[2] != NONE {
            let middle = 0.5 * crate::response::harmonic::TOUCH_SIDE as f32;
            let own = self.touched(draw.notes[2], [along * draw.cells[1] + middle, up * draw.cells[1]]);
            velocity = [velocity[0] + own[0], velocity[1] + own[1]];
        }
        velocity
    }

    /// A corner of a layer's grid, `share` (0 to 1) across its window from the left and the bottom.
    pub fn corner(&self, draw: &LayerDraw, share: [f32; 2]) -> LayerCorner {
        let axis = |axis: [f32; 4]| Vec3::new(axis[0], axis[1], axis[2]);
        let [right, up, forward] = [draw.right, draw.up, draw.forward].map(axis);
        let at = [draw.right[3], draw.up[3]];
        let at = [0, 1].map(|k| at[k] + (draw.window[k] - at[k]) * share[k]);
        let mut place = axis(draw.eye) + (right * at[0] + up * at[1] + forward) * draw.eye[3];
        let [u, v, width, height] = draw.cell;
        let uv = [u + width * share[0], v + height * (1.0 - share[1])];
        if draw.scale[..3] != [0.0; 3] {
            let (local, plane) = (place - axis(draw.root), axis(draw.plane));
            let velocity = self.velocity(draw, local.dot(plane), local.y);
            let world = plane * velocity[0] + Vec3::Y * velocity[1];
            let warp = Warp { scale: [draw.scale[0], draw.scale[1], draw.scale[2]], rigidity: draw.scale[3] };
            let way = offset(&warp, [world.dot(right), world.dot(up), world.dot(forward)], local.y / draw.root[3]);
            place += right * way[0] + up * way[1];
        }
        LayerCorner { place, uv }
    }
}
