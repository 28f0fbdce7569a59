//! A picture of a scene, without a window: shadow pass, main pass, resolve, read-back; and outputs beside it where they are asked for.

use std::sync::Arc;

pub use crate::render::aov::Before;
use sward::geometry::mesh::Mesh;
use sward::geometry::relief::Relief;
pub use sward::picture::Picture;
use sward::picture::aov::Aov;
use sward::picture::frame::{FrameInput, FrameUniform};
use sward::picture::subject::SHADOW_REACH;
use sward::picture::volume::{AmbientUniform, Lighting};
use sward::shading::look::{Look, Turf};

use crate::gpu::{Gpu, GpuError};
use crate::render::Surroundings;
use crate::render::aov::{AovPass, Drawn};
use crate::render::blades::BladePass;
use crate::render::bodies::BodyPass;
use crate::render::ground::GroundPass;
use crate::render::layers::LayerPass;
use crate::render::plant_pass::PlantPass;
use crate::render::plants::PlantDraws;
use crate::render::shadow::ShadowMap;
use crate::render::sky::SkyPass;
use crate::render::targets::{Resolve, Targets};
use crate::stopwatch::Stopwatch;

/// What stays the same from picture to picture.
#[derive(Clone, Debug)]
pub struct Setup {
    /// The ground's shape.
    pub relief: Relief,
    /// Looks that batches of plants refer to. The first one also colours the ground where plants are too far to draw.
    pub looks: Vec<Look>,
    /// Half side of the square around the focus that casts shadows, metres.
    pub shadow_reach: f32,
    /// The light of the scene's surroundings, where it has some.
    pub lighting: Option<Arc<Lighting>>,
}

impl Default for Setup {
    fn default() -> Self {
        Self {
            relief: Relief::flat(0.0),
            looks: vec![Look::of(sward::shading::clump::Kind::Meadow)],
            shadow_reach: SHADOW_REACH,
            lighting: None,
        }
    }
}

/// Draws pictures of one scene.
pub struct Renderer {
    frame: wgpu::Buffer,
    /// What the surroundings bind, and where the volume lies.
    surroundings: Option<(Surroundings, Arc<Lighting>)>,
    shadow: ShadowMap,
    sky: SkyPass,
    ground: GroundPass,
    bodies: BodyPass,
    plants: PlantPass,
    /// Made when there are blades.
    blades: Option<BladePass>,
    /// Made when there are stands of meshes.
    layers: Option<LayerPass>,
    resolve: Resolve,
    targets: Option<Targets>,
    /// Made when outputs beside a picture are first asked for.
    aov: Option<AovPass>,
    relief: Relief,
    shadow_reach: f32,
    /// Times the passes of the pictures while there is one.
    pub stopwatch: Option<Stopwatch>,
}

impl Renderer {
    /// Builds all passes.
    ///
    /// # Errors
    /// What the device reports, for instance a shader the driver refuses.
    pub fn new(gpu: &Gpu, setup: &Setup) -> Result<Self, GpuError> {
        let frame = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("frame"),
            size: size_of::<FrameUniform>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let shadow = ShadowMap::new(&gpu.device);
        let surroundings = setup.lighting.as_ref().map(|lighting| (Surroundings::new(gpu, lighting), Arc::clone(lighting)));
        let lit = surroundings.as_ref().map(|(bound, _)| bound);
        let looks = if setup.looks.is_empty() { Setup::default().looks } else { setup.looks.clone() };
        let mut relief = setup.relief.clone();
        // Only the mapping is needed from here on; the samples live on the GPU.
        let renderer = Self {
            sky: SkyPass::new(gpu, &frame, lit),
            ground: GroundPass::new(gpu, &frame, &shadow, lit, &relief, Turf::of(&looks)),
            bodies: BodyPass::new(gpu, &frame, &shadow, lit),
            plants: PlantPass::new(gpu, &looks, lit),
            blades: None,
            layers: None,
            resolve: Resolve::new(gpu),
            targets: None,
            aov: None,
            relief: {
                relief.heights = Vec::new();
                relief
            },
            shadow_reach: setup.shadow_reach.clamp(1.0, 1000.0),
            frame,
            surroundings,
            shadow,
            stopwatch: None,
        };
        gpu.check()?;
        Ok(renderer)
    }

    /// Puts a mesh in place of another one, or behind the last.
    pub fn put_mesh(&mut self, gpu: &Gpu, mesh: usize, other: &Mesh) {
        self.bodies.put_mesh(gpu, mesh, other);
    }

    /// Hands a body's mesh over; the answer is its number in [`sward::picture::frame::BodyDraw`].
    pub fn add_mesh(&mut self, gpu: &Gpu, mesh: &Mesh) -> usize {
        self.bodies.add_mesh(gpu, mesh)
    }

    /// Moves the vertices of a mesh handed over before; their number stays.
    pub fn move_mesh(&mut self, gpu: &Gpu, mesh: usize, moved: &Mesh) {
        self.bodies.move_mesh(gpu, mesh, moved);
    }

    /// Draws one picture of `size` pixels and keeps it on the GPU; sizes are limited to the device's largest texture.
    ///
    /// # Errors
    /// What the device reports.
    pub fn draw(&mut self, gpu: &Gpu, input: &FrameInput<'_>, plants: &PlantDraws<'_>, size: [u32; 2]) -> Result<(), GpuError> {
        self.draw_all(gpu, input, plants, None, size)
    }

    /// As [`Renderer::draw`], and depth, motion and plant of each pixel beside it, which [`Renderer::read_aov`] reads.
    ///
    /// # Errors
    /// What the device reports.
    pub fn draw_aov(
        &mut self,
        gpu: &Gpu,
        input: &FrameInput<'_>,
        plants: &PlantDraws<'_>,
        before: &Before<'_>,
        size: [u32; 2],
    ) -> Result<(), GpuError> {
        self.draw_all(gpu, input, plants, Some(before), size)
    }

    fn draw_all(
        &mut self,
        gpu: &Gpu,
        input: &FrameInput<'_>,
        plants: &PlantDraws<'_>,
        before: Option<&Before<'_>>,
        size: [u32; 2],
    ) -> Result<(), GpuError> {
        let size = fitting(gpu, size);
        let uniform = FrameUniform::new(input, self.relief.frame(input.origin), size, self.shadow_reach);
        gpu.queue.write_buffer(&self.frame, 0, bytemuck::bytes_of(&uniform));
        if let Some((bound, lighting)) = &self.surroundings {
            bound.write(gpu, &AmbientUniform::new(lighting, input.origin, input.light.strength));
        }
        self.ground.place(gpu, [input.view.position.x, input.view.position.z], input.origin);
        self.ground.lay(gpu, input.terrain, &input.growth);
        self.bodies.place(gpu, input.bodies);
        let ready = self.plants.ready(gpu, &self.frame, &self.shadow, plants);
        if self.blades.is_none() && !plants.blades.is_empty() {
            self.blades = Some(BladePass::new(gpu, self.surroundings.as_ref().map(|(bound, _)| bound)));
        }
        let ready_blades = self.blades.as_mut().map(|pass| pass.ready(gpu, &self.frame, &self.shadow, plants.blades)).unwrap_or_default();
        let targets = match self.targets.take() {
            Some(targets) if targets.size == size => targets,
            _ => self.resolve.targets(gpu, &self.frame, size),
        };
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let ready_layers = plants.layers.map(|draws| {
            let lit = self.surroundings.as_ref().map(|(bound, _)| bound);
            let pass = self.layers.get_or_insert_with(|| LayerPass::new(gpu, draws.stands, lit));
            pass.ready(gpu, &mut encoder, &self.frame, &self.shadow, &draws, self.stopwatch.as_mut())
        });
        let layers = self.layers.as_ref().zip(ready_layers.as_ref());
        {
            let writes = self.stopwatch.as_mut().and_then(|stopwatch| stopwatch.render("shadow", &[]));
            let mut pass = self.shadow.begin(&mut encoder, writes.map(|(_, writes)| writes));
            self.bodies.draw_shadow(&mut pass);
            self.plants.draw_shadow(&mut pass, &ready);
            if let Some(blades) = &self.blades {
                blades.draw_shadow(&mut pass, &ready_blades);
            }
            if let Some((pass_of, ready)) = layers {
                pass_of.draw_shadow(&mut pass, ready);
            }
        }
        {
            // Near things first: what they hide is never shaded.
            let writes =
                self.stopwatch.as_mut().and_then(|stopwatch| stopwatch.render("main pass", &["bodies", "plants", "ground", "sky"]));
            let (first, writes) = writes.unzip();
            let mut pass = targets.begin(&mut encoder, writes);
            let next = |pass: &mut wgpu::RenderPass<'_>, stage: u32| {
                if let (Some(stopwatch), Some(first)) = (&self.stopwatch, first) {
                    stopwatch.next(pass, first + stage);
                }
            };
            self.bodies.draw(&mut pass);
            next(&mut pass, 1);
            self.plants.draw(&mut pass, &ready);
            if let Some(blades) = &self.blades {
                blades.draw(&mut pass, &ready_blades);
            }
            if let Some((pass_of, ready)) = layers {
                pass_of.draw(&mut pass, ready);
            }
            next(&mut pass, 2);
            self.ground.draw(&mut pass);
            next(&mut pass, 3);
            self.sky.draw(&mut pass);
        }
        let writes = self.stopwatch.as_mut().and_then(|stopwatch| stopwatch.render("resolve", &[]));
        let display = targets.display.create_view(&Default::default());
        self.resolve.draw(&mut encoder, &targets, &display, writes.map(|(_, writes)| writes));
        if let Some(stopwatch) = &self.stopwatch {
            stopwatch.resolve(&mut encoder);
        }
        gpu.queue.submit([encoder.finish()]);
        self.targets = Some(targets);
        if let Some(before) = before {
            let Self { frame, ground, bodies, plants, blades, layers, .. } = self;
            let layers = layers.as_ref().zip(ready_layers.as_ref());
            let blades = blades.as_ref().filter(|_| !ready_blades.0.is_empty());
            let pass = self.aov.get_or_insert_with(|| AovPass::new(gpu, frame, bodies));
            pass.draw(
                gpu,
                &Drawn { frame, ground, bodies, plants, ready: &ready, blades, ready_blades: &ready_blades, layers },
                before,
                size,
            );
        }
        gpu.check()
    }

    /// The last picture on the device, sRGB code values in `Rgba8Unorm`; another texture after another size.
    pub fn shown(&self) -> Option<&wgpu::Texture> {
        self.targets.as_ref().map(|targets| &targets.display)
    }

    /// Plants cut into layers since the beginning, and pixels of all layers that are kept.
    pub fn layers_kept(&self) -> [u64; 2] {
        self.layers.as_ref().map_or([0; 2], |pass| [pass.cut, pass.pixels()])
    }

    /// Reads the last outputs beside a picture back; empty ones if none were drawn.
    ///
    /// # Errors
    /// What the device reports.
    pub fn read_aov(&self, gpu: &Gpu) -> Result<Aov, GpuError> {
        self.aov.as_ref().map_or_else(|| Ok(Aov::default()), |pass| pass.read(gpu))
    }

    /// Reads the last picture back; an empty one if nothing was drawn.
    ///
    /// # Errors
    /// What the device reports.
    pub fn read(&self, gpu: &Gpu) -> Result<Picture, GpuError> {
        let Some(targets) = &self.targets else {
            return Ok(Picture { width: 0, height: 0, rgba8: Vec::new() });
        };
        let [width, height] = targets.size;
        let row = (4 * width).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("read-back"),
            size: u64::from(row) * u64::from(height),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encoder.copy_texture_to_buffer(
            targets.display.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None },
            },
            wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        );
        let submission = gpu.queue.submit([encoder.finish()]);
        let lines = |bytes: &[u8]| bytes.chunks_exact(row as usize).flat_map(|line| &line[..4 * width as usize]).copied().collect();
        let rgba8 = gpu.mapped(&buffer, buffer.size(), Some(submission), lines)?;
        Ok(Picture { width, height, rgba8 })
    }
}

/// The size of a picture that the device can draw, nearest to the one asked for.
pub(crate) fn fitting(gpu: &Gpu, size: [u32; 2]) -> [u32; 2] {
    let most = gpu.device.limits().max_texture_dimension_2d;
    size.map(|side| side.clamp(1, most))
}
