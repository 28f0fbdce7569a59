//! Runs one WGSL function on many inputs and lays the answers beside its Rust twin's.

use libtest_mimic::Failed;
use sward::math::{hash, unit};
use sward_wgpu::compare::{Deviation, Tolerance};
use sward_wgpu::compute::readback;
use sward_wgpu::gpu::Gpu;
use wgpu::util::DeviceExt;

use crate::adapter::{Verdict, ensure};

/// Inputs per kernel.
pub(crate) const COUNT: u32 = 100_000;

/// Random numbers that are the same in every run.
pub(crate) struct Random {
    seed: u32,
    next: u32,
    /// What has been drawn for this input so far, as bits.
    pub(crate) words: Vec<u32>,
}

impl Random {
    /// For input number `seed`.
    pub(crate) fn new(seed: u32) -> Self {
        Self { seed, next: 0, words: Vec::new() }
    }

    /// 32 random bits that are not part of the input.
    pub(crate) fn bits(&mut self) -> u32 {
        self.next += 1;
        hash(17, 0, 0, self.seed, self.next)
    }

    /// A number in `low..high` that is not part of the input.
    pub(crate) fn drawn(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * unit(self.bits())
    }

    /// Adds a number in `low..high` to the input.
    pub(crate) fn float(&mut self, low: f32, high: f32) -> f32 {
        let value = self.drawn(low, high);
        self.put(value)
    }

    /// Adds this number to the input.
    pub(crate) fn put(&mut self, value: f32) -> f32 {
        self.words.push(value.to_bits());
        value
    }

    /// Adds a whole number in `low..high` to the input.
    pub(crate) fn whole(&mut self, low: i32, high: i32) -> i32 {
        let value = low + (self.bits() % (high - low) as u32) as i32;
        self.words.push(value as u32);
        value
    }

    /// Adds 32 random bits to the input.
    pub(crate) fn any(&mut self) -> u32 {
        let bits = self.bits();
        self.words.push(bits);
        bits
    }
}

/// How answers are compared.
#[derive(Clone, Copy)]
pub(crate) enum By {
    /// All numbers alike.
    Absolute(Tolerance),
    /// Differences as a share of the twin's number, or of this where that is smaller.
    Relative(Tolerance, f32),
    /// Bit for bit.
    Bits,
}

/// A kernel and its twin.
pub(crate) struct Twin<'a, C: Fn(u32, &mut Vec<u32>) -> Vec<u32>> {
    /// What the lines printed begin with.
    pub(crate) name: &'a str,
    /// Library texts, joined in this order.
    pub(crate) library: &'a [&'a str],
    /// Declarations of tables at bindings 2 and up, host functions, and `fn twin()`.
    ///
    /// `twin` takes inputs by `next_f()`, `next_v()`, `next_i()`, `next_u()` and answers by `put_f(…)`, `put_v(…)`, `put_u(…)`.
    pub(crate) host: &'a str,
    /// What the tables hold.
    pub(crate) tables: &'a [&'a [u8]],
    /// Makes input number n (pushed to the list) and returns the Rust answers to it, as bits.
    pub(crate) rust: C,
}

/// Bits of some numbers.
pub(crate) fn bits(values: impl IntoIterator<Item = f32>) -> Vec<u32> {
    values.into_iter().map(f32::to_bits).collect()
}

const ENTRY: &str = "
@group(0) @binding(0) var<storage, read> input: array<u32>;
@group(0) @binding(1) var<storage, read_write> output: array<u32>;
var<private> in_at: u32;
var<private> out_at: u32;
fn next_u() -> u32 { in_at++; return input[in_at - 1u]; }
fn next_i() -> i32 { return bitcast<i32>(next_u()); }
fn next_f() -> f32 { return bitcast<f32>(next_u()); }
fn next_v() -> vec2<f32> { let x = next_f(); return vec2<f32>(x, next_f()); }
fn next_w() -> vec2<i32> { let x = next_i(); return vec2<i32>(x, next_i()); }
fn put_u(value: u32) { output[out_at] = value; out_at++; }
fn put_f(value: f32) { put_u(bitcast<u32>(value)); }
fn put_v(value: vec2<f32>) { put_f(value.x); put_f(value.y); }
@compute @workgroup_size(64)
fn entry(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= COUNT { return; }
    in_at = id.x * READS;
    out_at = id.x * WRITES;
    twin();
}
";

impl<C: Fn(u32, &mut Vec<u32>) -> Vec<u32>> Twin<'_, C> {
    /// Answers of Rust and of the GPU to so many inputs, as bits.
    fn answers(&self, gpu: &Gpu, count: u32) -> Result<[Vec<u32>; 2], Failed> {
        let (mut input, mut expected) = (Vec::new(), Vec::new());
        for number in 0..count {
            expected.extend((self.rust)(number, &mut input));
        }
        let (reads, writes) = (input.len() / count as usize, expected.len() / count as usize);
        let sizes = format!("const COUNT: u32 = {count}u;\nconst READS: u32 = {reads}u;\nconst WRITES: u32 = {writes}u;\n");
        let text = [&*self.library.join("\n"), &sizes, ENTRY, self.host].join("\n");
        let actual = run(gpu, &text, count, &input, expected.len(), self.tables)?;
        Ok([expected, actual])
    }

    /// Compares, prints the deviation, and fails beyond the tolerance.
    pub(crate) fn check(&self, gpu: &Gpu, by: By) -> Verdict {
        self.check_some(gpu, by, COUNT)
    }

    /// As [`Self::check`], of so many inputs: for kernels that are slow on software adapters.
    pub(crate) fn check_some(&self, gpu: &Gpu, by: By, count: u32) -> Verdict {
        let [expected, actual] = self.answers(gpu, count)?;
        let floats = |list: &[u32]| -> Vec<f32> { list.iter().map(|bits| f32::from_bits(*bits)).collect() };
        let (rust, wgsl) = (floats(&expected), floats(&actual));
        match by {
            By::Bits => {
                let differing = expected.iter().zip(&actual).filter(|(a, b)| a != b).count();
                println!("{}: {} words, {differing} differ", self.name, expected.len());
                ensure(differing == 0 && !expected.is_empty(), || format!("{}: {differing} words differ", self.name))
            }
            By::Absolute(tolerance) => judge(self.name, &rust, &wgsl, &tolerance),
            By::Relative(tolerance, floor) => {
                let scale = |list: &[f32]| -> Vec<f32> {
                    list.iter().zip(&rust).map(|(value, by)| value / if by.abs() > floor { by.abs() } else { floor }).collect()
                };
                judge(self.name, &scale(&rust), &scale(&wgsl), &tolerance)
            }
        }
    }
}

/// Prints how far two lists are apart and fails beyond the tolerance.
pub(crate) fn judge(name: &str, a: &[f32], b: &[f32], tolerance: &Tolerance) -> Verdict {
    let deviation = Deviation::of(a, b, tolerance.outlier);
    println!("{}", line(name, &deviation));
    ensure(deviation.within(tolerance), || format!("{} beyond {tolerance:?}", line(name, &deviation)))
}

/// One line of numbers.
pub(crate) fn line(name: &str, deviation: &Deviation) -> String {
    let Deviation { count, p999, rms, max, outliers } = deviation;
    format!("{name}: {count} numbers, max {max:.2e}, rms {rms:.2e}, p99.9 {p999:.2e}, outliers {outliers}")
}

fn run(gpu: &Gpu, text: &str, count: u32, input: &[u32], words: usize, tables: &[&[u8]]) -> Result<Vec<u32>, Failed> {
    let module = gpu
        .device
        .create_shader_module(wgpu::ShaderModuleDescriptor { label: Some("twin"), source: wgpu::ShaderSource::Wgsl(text.into()) });
    let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some("twin"),
        layout: None,
        module: &module,
        entry_point: Some("entry"),
        compilation_options: Default::default(),
        cache: None,
    });
    gpu.check()?;
    let filled = |contents: &[u8]| {
        let usage = wgpu::BufferUsages::STORAGE;
        gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: None, contents, usage })
    };
    let output = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: words as u64 * 4,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    let mut buffers = vec![filled(bytemuck::cast_slice(input)), output];
    buffers.extend(tables.iter().map(|table| filled(table)));
    let entries: Vec<wgpu::BindGroupEntry> =
        buffers.iter().zip(0..).map(|(buffer, binding)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() }).collect();
    let layout = &pipeline.get_bind_group_layout(0);
    let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries });
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    {
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(count.div_ceil(64), 1, 1);
    }
    gpu.queue.submit([encoder.finish()]);
    Ok(readback::read(gpu, &buffers[1], words as u64 * 4)?)
}
