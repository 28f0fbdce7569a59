//! Where the volume lies: round the camera's places, since the field has no end.

use crate::scene::{LightVolume, Path, Scene};

/// Most voxels along x or z; the texture of six faces then takes 6 MiB with 8 layers.
const MOST: f64 = 128.0;
/// Height of a volume without plants, m.
const LEAST_HEIGHT: f32 = 0.1;
/// A volume is this much higher than the tallest plants.
const ABOVE: f32 = 1.15;

/// A box of voxels laid on the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Room {
    /// Corner of least x and z, m from the corner of the origin patch.
    pub corner: [f64; 2],
    /// Sides of a voxel along x and z, m.
    pub voxel: [f64; 2],
    /// Columns, rows, layers.
    pub size: [u32; 3],
    /// Height of the last layer above the ground, m.
    pub height: f32,
}

/// Places the camera passes, and those it looks at from there, on the ground, m; and how far from those it may be.
fn places(scene: &Scene, reach: f64) -> (Vec<[f64; 2]>, f64) {
    let camera = &scene.camera;
    let followed = camera.follow.as_ref().and_then(|name| scene.interactors.iter().find(|body| &body.name == name));
    if let Some(body) = followed {
        let places = match &body.path {
            Path::Still(path) => vec![path.at],
            Path::Driven(path) => vec![path.at],
            Path::Keyframes(path) => path.keys.iter().map(|key| key.at).collect(),
            Path::Circle(path) => {
                let [x, z] = path.centre;
                vec![[x - path.radius, z - path.radius], [x + path.radius, z + path.radius]]
            }
        };
        let [x, _, z] = camera.eye;
        return (places, (x * x + z * z).sqrt() + reach);
    }
    let keys = camera.keys.iter().map(|key| (key.eye, key.target));
    let own = camera.keys.is_empty().then_some((camera.eye, camera.target));
    let mut places = Vec::new();
    for (eye, target) in keys.chain(own) {
        let way = [target[0] - eye[0], target[2] - eye[2]];
        let length = (way[0] * way[0] + way[1] * way[1]).sqrt();
        let ahead = if length > 1e-6 { 0.5 * reach / length } else { 0.0 };
        places.extend([[eye[0], eye[2]], [eye[0] + ahead * way[0], eye[2] + ahead * way[1]]]);
    }
    (places, 0.5 * reach)
}

impl Room {
    /// The box for a scene whose tallest plants are `tallest` \[m\].
    pub fn of(scene: &Scene, settings: &LightVolume, tallest: f32) -> Self {
        let (places, margin) = places(scene, f64::from(settings.reach));
        let bound = |axis: usize, pick: fn(f64, f64) -> f64, start: f64| places.iter().map(|place| place[axis]).fold(start, pick);
        let (mut corner, mut voxel, mut size) = ([0.0; 2], [0.0; 2], [1, 1, settings.layers.clamp(2, 32)]);
        for axis in 0..2 {
            let (low, high) = (bound(axis, f64::min, f64::INFINITY) - margin, bound(axis, f64::max, f64::NEG_INFINITY) + margin);
            let side = (high - low).max(f64::from(settings.voxel));
            let count = (side / f64::from(settings.voxel)).ceil().clamp(1.0, MOST);
            // Whole voxels from a whole place: a camera that moves a little keeps its volume's grid.
            voxel[axis] = f64::from(settings.voxel).max(side / count);
            corner[axis] = (low / voxel[axis]).floor() * voxel[axis];
            size[axis] = count as u32;
        }
        let height = settings.height.unwrap_or(ABOVE * tallest).max(LEAST_HEIGHT);
        Self { corner, voxel, size, height }
    }

    /// Sides, m.
    pub fn extent(&self) -> [f64; 2] {
        [0, 1].map(|axis| self.voxel[axis] * f64::from(self.size[axis]))
    }

    /// The middle of a column on the ground, m from the corner of the origin patch.
    pub fn middle(&self, column: u32, row: u32) -> [f64; 2] {
        let at = |axis: usize, index: u32| self.corner[axis] + (f64::from(index) + 0.5) * self.voxel[axis];
        [at(0, column), at(1, row)]
    }

    /// Columns in all.
    pub fn columns(&self) -> usize {
        self.size[0] as usize * self.size[1] as usize
    }
}
