//! Compute pipelines, each made once for a device: drivers take seconds for some of them, and every world and picture asks for the same ones.

use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::{Mutex, OnceLock, PoisonError};

use super::Gpu;

/// A text, an entry point, and the bits of its constants.
type Key = (u64, &'static str, Vec<u64>);

/// The pipelines of a device.
#[derive(Default)]
pub(super) struct Programs(Mutex<BTreeMap<Key, wgpu::ComputePipeline>>);

/// The text of a compute shader, which becomes a module when a pipeline of it is not there yet.
pub(crate) struct Program {
    label: &'static str,
    text: String,
    number: u64,
    module: OnceLock<wgpu::ShaderModule>,
}

impl Program {
    /// A full text.
    pub(crate) fn new(label: &'static str, text: String) -> Self {
        let mut hasher = DefaultHasher::new();
        text.hash(&mut hasher);
        Self { label, number: hasher.finish(), text, module: OnceLock::new() }
    }

    /// The pipeline of an entry point, with constants put in; `layout` is the same for all of a text.
    pub(crate) fn pipeline(
        &self,
        gpu: &Gpu,
        layout: Option<&wgpu::PipelineLayout>,
        entry: &'static str,
        constants: &[(&str, f64)],
    ) -> wgpu::ComputePipeline {
        let key = (self.number, entry, constants.iter().map(|(_, value)| value.to_bits()).collect());
        let mut made = gpu.programs.0.lock().unwrap_or_else(PoisonError::into_inner);
        let make = || {
            let module = self.module.get_or_init(|| {
                let source = wgpu::ShaderSource::Wgsl(self.text.as_str().into());
                gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor { label: Some(self.label), source })
            });
            gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(entry),
                layout,
                module,
                entry_point: Some(entry),
                compilation_options: wgpu::PipelineCompilationOptions { constants, ..Default::default() },
                cache: None,
            })
        };
        made.entry(key).or_insert_with(make).clone()
    }
}
