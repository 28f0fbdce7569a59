//! Pictures of shipped scenes against stored ones, and what pictures must and must not depend on.
//!
//! `SWARD_GOLDEN=create:all cargo test --test golden` stores the pictures that are missing.

#[path = "support/adapter.rs"]
mod adapter;
#[path = "support/pictures.rs"]
mod pictures;
#[path = "support/views.rs"]
mod views;

/// Software drivers and the pictures stored for each; every hardware driver draws its own. SwiftShader is slow, and two pictures hold
/// what passes there: many segments, hills, two stands and a truck; one segment, level ground and a ball.
const STORED: [(&str, &[&str]); 2] = [
    (
        "llvmpipe",
        &[
            "hello",
            "lawn",
            "reed",
            "crossing",
            "blades",
            "grassland",
            "footsteps",
            "stamp",
            "walkers",
            "shrub",
            "crown",
            "field",
            "aquarium",
        ],
    ),
    ("swiftshader", &["hello", "lawn"]),
];

fn main() -> std::process::ExitCode {
    let tests: &[adapter::Test] = &[
        ("golden_hello", views::hello),
        ("golden_lawn", views::lawn),
        ("golden_reed", views::reed),
        ("golden_crossing", views::crossing),
        ("golden_blades", views::blades),
        ("golden_grassland", views::grassland),
        ("golden_footsteps", views::footsteps),
        ("golden_stamp", views::stamp),
        ("golden_walkers", views::walkers),
        ("golden_shrub", views::shrub),
        ("golden_crown", views::crown),
        ("golden_field", views::field),
        ("golden_aquarium", views::aquarium),
        ("pictures_tell_what_matters", views::pictures_tell_what_matters),
        ("far_from_home", views::far_from_home),
        ("joints_stay_above_ground", views::joints_stay_above_ground),
        ("joints_stay_above_bumps", views::joints_stay_above_bumps),
        ("far_plants_need_one_segment", views::far_plants_need_one_segment),
        ("pictures_between_steps", views::pictures_between_steps),
        ("pictures_at_half_precision", views::pictures_at_half_precision),
    ];
    adapter::run(tests, not_stored)
}

/// Why a test has nothing to compare with on this adapter.
fn not_stored(gpu: &sward_wgpu::gpu::Gpu, name: &str) -> Option<String> {
    let picture = name.strip_prefix("golden_")?;
    let driver = pictures::driver(gpu);
    // OpenGL has its own way to average samples.
    let on_vulkan = gpu.adapter_info.backend == wgpu::Backend::Vulkan;
    let stored = on_vulkan && STORED.iter().any(|(name, pictures)| *name == driver && pictures.contains(&picture));
    (!stored).then(|| format!("no picture is stored for {driver} on {:?}", gpu.adapter_info.backend))
}
