//! What is drawn from where, in which light; and its layout for the shaders.

use glam::{DVec2, Mat4, Quat, Vec3, Vec4};

use crate::geometry::relief::ReliefFrame;
use crate::growth::Near;
use crate::shading::common::PERIOD;
use crate::shading::sky::Light;
use crate::shading::water;
use crate::terrain::Terrain;

/// Texels along each side of the sun's shadow map (`2048` in `shadows.wgsl`).
pub const SHADOW_SIDE: u32 = 2048;
/// Distance of the near plane, m.
pub const NEAR: f32 = 0.05;

/// Where the camera is and where it looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Metres relative to the frame origin, y absolute.
    pub position: Vec3,
    /// Turns camera axes (x right, y up, −z ahead) into world axes.
    pub rotation: Quat,
    /// Vertical angle of view, radians, 0.05..=2.5.
    pub field_of_view: f32,
}

impl View {
    /// A camera at `eye` that looks at `target`, both relative to the frame origin.
    pub fn looking_at(eye: Vec3, target: Vec3, field_of_view: f32) -> Self {
        let ahead = (target - eye).normalize_or(Vec3::Z);
        let right = ahead.cross(Vec3::Y).normalize_or(Vec3::X);
        let axes = glam::Mat3::from_cols(right, right.cross(ahead), -ahead);
        Self { position: eye, rotation: Quat::from_mat3(&axes), field_of_view }
    }

    /// Frame space to clip space of a picture of `size` pixels; depth 1 at the near plane, 0 at infinity.
    pub fn projection(&self, size: [u32; 2]) -> Mat4 {
        let aspect = size[0].max(1) as f32 / size[1].max(1) as f32;
        let turn = Mat4::from_rotation_translation(self.rotation, self.position).inverse();
        Mat4::perspective_infinite_reverse_rh(self.field_of_view, aspect, NEAR) * turn
    }
}

/// Sun and air.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightInput {
    /// Heading of the sun, radians: 0 = +x, towards +z.
    pub azimuth: f32,
    /// Height of the sun, radians, 0.02..=1.57.
    pub elevation: f32,
    /// Factor on the sun's light, 0..=10.
    pub strength: f32,
    /// Haziness of the sky, 0..=1.
    pub haze: f32,
    /// Fog density, 1/m, 0..=1.
    pub fog: f32,
    /// Exposure, EV, −8..=8.
    pub exposure: f32,
    /// Cloud cover, 0..=1.
    pub clouds: f32,
    /// Depth under water, m, 0..=40; 0 is in air.
    pub water: f32,
    /// Light and exposure factor of a picture of the surroundings, which hold instead.
    pub surroundings: Option<(Light, f32)>,
}

impl Default for LightInput {
    fn default() -> Self {
        Self {
            azimuth: 0.6,
            elevation: 0.22,
            strength: 1.0,
            haze: 0.3,
            fog: 0.0015,
            exposure: 0.0,
            clouds: 0.4,
            water: 0.0,
            surroundings: None,
        }
    }
}

/// One body to draw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyDraw {
    /// A mesh handed to the renderer before.
    pub mesh: usize,
    /// Body to frame space.
    pub transform: Mat4,
    /// Linear RGB of the painted parts.
    pub paint: [f32; 3],
    /// Height of the ground under the body, metres.
    pub ground: f32,
    /// Number of the body in the scene, from 1.
    pub number: u32,
}

/// Everything a picture depends on, except its plants.
#[derive(Clone, Debug)]
pub struct FrameInput<'a> {
    /// The camera.
    pub view: View,
    /// Ground position (x, z) of the frame origin, metres.
    pub origin: [f64; 2],
    /// Where shadows are wanted: a point on the ground, relative to the frame origin.
    pub focus: Vec3,
    /// Sun and air.
    pub light: LightInput,
    /// Bodies.
    pub bodies: &'a [BodyDraw],
    /// Seconds; moves the clouds.
    pub time: f64,
    /// The ground, for what has been added to it.
    pub terrain: &'a Terrain,
    /// Where the ground is bare, relative to the frame origin.
    pub growth: Near,
}

/// Uniform `Frame` of `frame.wgsl`.
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct FrameUniform {
    /// Frame space to clip space; depth 1 at the near plane, 0 at infinity.
    pub view_projection: Mat4,
    /// Frame space to shadow map: xy 0..=1, v down; z depth 0..=1.
    pub shadow: Mat4,
    /// Camera's right, scaled by the half width of the picture plane; w = height of one pixel at distance 1.
    pub right: Vec4,
    /// Camera's up, scaled by the half height; w = time, s.
    pub up: Vec4,
    /// Unit vector ahead; w = exposure factor.
    pub forward: Vec4,
    /// Eye, m; w = fog density, 1/m.
    pub camera: Vec4,
    /// Frame origin modulo the pattern's period, m; zw = drift of the clouds.
    pub phase: Vec4,
    /// Unit vector towards the sun; w = haze.
    pub sun: Vec4,
    /// Irradiance of a surface facing the sun; w = cloud cover.
    pub sun_colour: Vec4,
    /// Mean radiance of the sky; w = metres per shadow texel.
    pub sky: Vec4,
    /// Mean radiance of the ground; w = 1 where the shadow map is in use.
    pub ground: Vec4,
    /// Terrain: samples per metre (xy), sample position of the frame origin (zw).
    pub relief: Vec4,
    /// Columns, rows.
    pub relief_size: [u32; 4],
    /// Noise on top: 1/wavelength, amplitude, roughness; w = depth under water, m, 0 in air.
    pub detail: Vec4,
    /// Way of the frame origin through its cell of the noise.
    pub detail_place: Vec4,
    /// That cell; octaves; seed.
    pub detail_cell: [i32; 4],
    /// What was added to the ground: samples per metre, not used, sample position of the frame origin.
    pub edit: Vec4,
    /// Columns, rows, place of the first sample, not used.
    pub edit_size: [u32; 4],
}

impl FrameUniform {
    /// Lays a frame out for a picture of `size` pixels. `shadow_reach` is the half side of the shadowed square, metres.
    pub fn new(input: &FrameInput<'_>, relief: ReliefFrame, size: [u32; 2], shadow_reach: f32) -> Self {
        let light = &input.light;
        let (sun, exposed) = light_of(light);
        let view = &input.view;
        let half = (0.5 * view.field_of_view).tan();
        let aspect = size[0].max(1) as f32 / size[1].max(1) as f32;
        let (right, up, ahead) = (view.rotation * Vec3::X, view.rotation * Vec3::Y, view.rotation * Vec3::NEG_Z);
        let phase = DVec2::from(input.origin).rem_euclid(DVec2::splat(PERIOD)).as_vec2();
        let edits = input.terrain.edits().frame(input.origin);
        let drift = (input.time * 0.002).rem_euclid(256.0) as f32;
        Self {
            view_projection: view.projection(size),
            shadow: shadow_matrix(input.focus, sun.sun, shadow_reach),
            right: (right * half * aspect).extend(2.0 * half / size[1].max(1) as f32),
            up: (up * half).extend(input.time.rem_euclid(4096.0) as f32),
            forward: ahead.extend(light.exposure.exp2() * exposed),
            camera: view.position.extend(light.fog),
            phase: Vec4::new(phase.x, phase.y, drift, 0.4 * drift),
            sun: sun.sun.extend(light.haze),
            sun_colour: sun.sun_colour.extend(light.clouds),
            sky: sun.sky.extend(2.0 * shadow_reach / SHADOW_SIDE as f32),
            ground: sun.ground.extend(1.0),
            relief: Vec4::from(relief.mapping),
            relief_size: [relief.size[0], relief.size[1], 0, 0],
            detail: Vec4::new(
                relief.detail.inverse_wavelength,
                relief.detail.amplitude,
                relief.detail.roughness,
                if light.surroundings.is_some() { 0.0 } else { light.water },
            ),
            detail_place: Vec4::new(relief.detail_anchor.1[0], relief.detail_anchor.1[1], 0.0, 0.0),
            detail_cell: {
                let [x, z] = relief.detail_anchor.0;
                [x, z, relief.detail.octaves as i32, relief.detail.seed as i32]
            },
            edit: Vec4::from(edits.mapping),
            edit_size: [edits.size[0], edits.size[1], input.terrain.heights().len() as u32, 0],
        }
    }
}

/// Unit vector towards the sun.
pub fn sun_of(light: &LightInput) -> Vec3 {
    light_of(light).0.sun
}

/// Sun and sky, and the factor on exposure.
fn light_of(light: &LightInput) -> (Light, f32) {
    light.surroundings.unwrap_or_else(|| {
        let above = Light::new(light.azimuth, light.elevation, light.strength, light.haze, light.clouds);
        let sun = if light.water > 0.0 { water::sunk(&above, light.water) } else { above };
        (sun, base_exposure(&sun))
    })
}

/// What 0 EV means: a well-exposed evening. A photographer opens up as the light goes, but less than the light goes.
fn base_exposure(light: &Light) -> f32 {
    let brightness = (0.2 * light.sun_colour + std::f32::consts::PI * light.sky).dot(Vec3::new(0.2126, 0.7152, 0.0722));
    1.4 * (3.0 / brightness.max(0.05)).powf(0.6).clamp(0.4, 4.0)
}

/// Frame space to shadow map (xy 0..1, v down; z depth 0..1) for a sun in direction `sun`.
fn shadow_matrix(focus: Vec3, sun: Vec3, reach: f32) -> Mat4 {
    let right = Vec3::Y.cross(sun).normalize_or(Vec3::X);
    let up = sun.cross(right);
    // A low sun sees level ground foreshortened: the map need not be square in metres. Slopes and tall bodies add to it.
    let half_up = reach * (sun.y + 0.12).min(1.0) + 4.0;
    let texel = [2.0 * reach / SHADOW_SIDE as f32, 2.0 * half_up / SHADOW_SIDE as f32];
    // Steps of whole texels keep the rims of shadows from crawling with the camera.
    let snap = |value: f32, step: f32| (value / step).round() * step;
    let centre = [snap(focus.dot(right), texel[0]), snap(focus.dot(up), texel[1]), focus.dot(sun)];
    let depth = reach + 60.0;
    let row = |axis: Vec3, centre: f32, half: f32, flip: f32| (axis * (flip * 0.5 / half)).extend(0.5 - flip * centre * 0.5 / half);
    Mat4::from_cols(row(right, centre[0], reach, 1.0), row(up, centre[1], half_up, -1.0), row(sun, centre[2], depth, -1.0), Vec4::W)
        .transpose()
}
