//! The motion of two frames, followed from the later to the earlier, and held against what it should be.

use glam::DVec2;
use sward::model::{Assets, Folder};
use sward::picture::aov::Aov;
use sward::picture::identity::Identity;
use sward::scene::Scene;
use sward::world::World;

use crate::exact::{self, Moment};

/// A truck drives through two stands in gusts, past a camera that moves as well; a ball rolls, a post walks and bows, a crate stands.
pub(crate) const CAR_PASS: &str = r#"(version: 1, field: (patch_side: 16),
    stands: [(species: Meadow, cells: 96), (species: Tussock, cells: 40, cover: 0.2)], wind: [Natural(velocity: (4, 1))],
    terrain: Image(path: "assets/jacksboro.png", scale: 0.1),
    interactors: [
        (name: "truck", shape: Truck, path: Keyframes(keys: [(time: 0, at: (-7, 8)), (time: 1.5, at: (8, 6))])),
        (name: "ball", shape: Sphere(radius: 0.5), path: Circle(centre: (-2, 4), radius: 2, speed: 3)),
        (name: "post", shape: Mesh(file: "post.glb", clip: "Bow"), path: Circle(centre: (-1.5, 10), radius: 1, speed: 1)),
        (name: "crate", shape: Box(size: (1, 0.8, 1)), path: Still(at: (4, 12), yaw: 0.4)),
    ],
    camera: (keys: [(time: 0, eye: (-3, 2.8, 0), target: (-3, 0.6, 8)), (time: 1.5, eye: (1.5, 3.2, 0.5), target: (1.5, 0.5, 8))],
        field_of_view: 0.75),
    budget: (patches: 25, focus_distance: 20, lag_distance: 20))"#;

/// The same pass through blades.
pub(crate) fn blade_pass() -> String {
    CAR_PASS.replace("species: Meadow,", "species: Meadow, representation: Blade(blades: 12, width: 0.02),")
}

/// The same pass through sheets, seen larger.
pub(crate) fn sheet_pass() -> String {
    sheets("representation: Sheet()")
}

/// The same through billboards that bodies deform, drawn as the sheets they are. They recover so fast that the track moves.
pub(crate) fn deformed_pass() -> String {
    sheets("response: Springs(recover: 0.3)")
}

fn sheets(kind: &str) -> String {
    CAR_PASS.replace("field_of_view: 0.75", "field_of_view: 0.63").replace("species: Meadow,", &format!("species: Meadow, {kind},"))
}

/// Size of the pictures, pixels.
pub(crate) const SIZE: [u32; 2] = [320, 180];
/// The two frames, of 24 a second: whole steps, and how far before that the frame lies.
pub(crate) const FRAMES: [(u64, f64); 2] = [(60, 0.0), (63, 0.5)];

/// The repository's files, and a body with a skin and a clip.
struct Files;

impl Assets for Files {
    fn read(&self, path: &str) -> Result<Vec<u8>, String> {
        let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
        if path == "post.glb" { Ok(crate::glb::post().bytes()) } else { Folder(root.into()).read(path) }
    }
}

/// The world of a scene.
pub(crate) fn world(text: &str) -> World {
    World::new(Scene::parse(text, "pass.ron").expect("valid"), &Files).expect("it compiles")
}

/// Two frames in a row.
pub(crate) struct Pair {
    /// The later one's.
    world: World,
    pub(crate) frames: [Aov; 2],
    moments: [Moment; 2],
    /// What each pixel of the later one shows.
    pub(crate) kinds: Vec<Kind>,
}

/// What became of the pixels of some surfaces, followed into the frame before.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Followed {
    /// Same number, and a depth at which the point can be.
    pub(crate) landed: usize,
    /// Something nearer is there.
    pub(crate) hidden: usize,
    /// Beside the frame.
    pub(crate) outside: usize,
    /// None of these.
    pub(crate) lost: usize,
}

impl Followed {
    /// Share of the pixels within the frame before that landed; of all but the hidden ones.
    pub(crate) fn share(&self) -> f64 {
        self.landed as f64 / (self.landed + self.lost).max(1) as f64
    }
}

/// How far motion is from what it should be.
#[derive(Clone, Debug, Default)]
pub(crate) struct Errors {
    /// Pixels off, sorted.
    pub(crate) off: Vec<f64>,
    /// Pixels with nothing to compare with.
    pub(crate) unknown: usize,
    /// Median length of the true motion, pixels.
    pub(crate) moved: f64,
}

impl Errors {
    /// The error that a share of the pixels does not exceed.
    pub(crate) fn at(&self, share: f64) -> f64 {
        self.off.get(((self.off.len() as f64 - 1.0) * share) as usize).copied().unwrap_or(f64::INFINITY)
    }
}

/// The kinds of surfaces in a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Plant,
    Body,
    Ground,
    Sky,
}

impl Pair {
    /// Of the worlds and outputs of [`FRAMES`].
    pub(crate) fn new(worlds: [World; 2], frames: [Aov; 2]) -> Self {
        let moments = [0, 1].map(|k| Moment::new(&worlds[k], FRAMES[k].1, SIZE));
        let [_, world] = worlds;
        let (identity, later) = (Identity::of(&world), &frames[1]);
        let kind = |at: usize| match later.plant[at] {
            0 if later.depth[at].is_infinite() => Kind::Sky,
            0 => Kind::Ground,
            number if identity.place(number, [0, 0]).is_some() => Kind::Plant,
            _ => Kind::Body,
        };
        let kinds = (0..later.plant.len()).map(kind).collect();
        Self { world, frames, moments, kinds }
    }

    /// Follows the pixels `of` the later frame by `motion`.
    pub(crate) fn follow(&self, of: impl Fn(usize) -> bool, motion: impl Fn(usize) -> DVec2) -> Followed {
        let [before, now] = &self.moments;
        let (then, later) = (&self.frames[0], &self.frames[1]);
        let mut followed = Followed::default();
        for at in (0..later.plant.len()).filter(|at| of(*at)) {
            let [x, y] = [at as u32 % later.width, at as u32 / later.width].map(|k| f64::from(k) + 0.5);
            let to = DVec2::new(x, y) + motion(at);
            let (column, row) = (to.x.floor(), to.y.floor());
            if !(1.0..f64::from(then.width) - 1.0).contains(&column) || !(1.0..f64::from(then.height) - 1.0).contains(&row) {
                followed.outside += 1;
                continue;
            }
            // A leaf is as narrow as a pixel: the point itself is between the centres of up to nine.
            let around = (0..9).map(|k| (row as usize + k / 3 - 1) * then.width as usize + column as usize + k % 3 - 1);
            // If it had stood still. Plants and bodies move by less than the tolerance in a frame.
            let expected = before.camera.project(now.camera.point(DVec2::new(x, y), f64::from(later.depth[at]))).1;
            let depth = |near: usize| f64::from(then.depth[near]) - expected;
            if around.clone().any(|near| then.plant[near] == later.plant[at] && depth(near).abs() < 0.5) {
                followed.landed += 1;
            } else if around.clone().any(|near| depth(near) < -0.02) {
                followed.hidden += 1;
            } else {
                followed.lost += 1;
            }
        }
        followed
    }

    /// What the camera alone would move.
    pub(crate) fn camera_only(&self) -> Vec<DVec2> {
        let ([before, now], later) = (&self.moments, &self.frames[1]);
        let motion = |at: usize| {
            let pixel = DVec2::new(f64::from(at as u32 % later.width) + 0.5, f64::from(at as u32 / later.width) + 0.5);
            let depth = f64::from(later.depth[at]).min(1e9);
            before.camera.project(now.camera.point(pixel, depth)).0 - pixel
        };
        (0..later.plant.len()).map(motion).collect()
    }

    /// How large the triangle a pixel shows was seen before, of what it is seen now: less than 0 from the other side. `None` where that is not known.
    pub(crate) fn size_before(&self, at: usize) -> Option<f64> {
        let identity = Identity::of(&self.world);
        exact::seen(&self.world, &identity, self.moments.each_ref(), &self.frames[1], at).map(|(_, size)| size)
    }

    /// The motion of the pixels of a kind, and what it should be; `None` where there is nothing to compare with.
    pub(crate) fn exact(&self, kind: Kind) -> Vec<Option<[DVec2; 2]>> {
        self.exact_of(|at| self.kinds[at] == kind)
    }

    /// The same of some pixels.
    pub(crate) fn exact_of(&self, of: impl Fn(usize) -> bool) -> Vec<Option<[DVec2; 2]>> {
        let (later, identity) = (&self.frames[1], Identity::of(&self.world));
        let both = |at: usize| Some([given(later, at), exact::motion(&self.world, &identity, self.moments.each_ref(), later, at)?]);
        (0..later.plant.len()).filter(|at| of(*at)).map(both).collect()
    }
}

impl Errors {
    /// Of motion, changed by `factor`, against what it should be.
    pub(crate) fn new(pairs: &[Option<[DVec2; 2]>], factor: f64) -> Self {
        let known = pairs.iter().flatten();
        let mut off: Vec<f64> = known.clone().map(|[given, exact]| (*given * factor).distance(*exact)).collect();
        let mut lengths: Vec<f64> = known.map(|[_, exact]| exact.length()).collect();
        off.sort_by(f64::total_cmp);
        lengths.sort_by(f64::total_cmp);
        Self { unknown: pairs.len() - off.len(), off, moved: lengths.get(lengths.len() / 2).copied().unwrap_or(0.0) }
    }
}

/// The motion a frame holds.
pub(crate) fn given(aov: &Aov, at: usize) -> DVec2 {
    DVec2::new(f64::from(aov.motion[at][0]), f64::from(aov.motion[at][1]))
}
