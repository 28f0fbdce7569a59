//! Pictures of shipped scenes against stored ones, and what pictures must and must not depend on.
//!
//! `SWARD_GOLDEN=create:all cargo test -p sward_wgpu --test golden` stores the pictures that are missing.

#[path = "support/adapter.rs"]
mod adapter;
#[path = "support/pictures.rs"]
mod pictures;
#[path = "support/views.rs"]
mod views;

fn main() -> std::process::ExitCode {
    let tests: &[adapter::Test] = &[
        ("golden_hello", views::hello),
        ("golden_lawn", views::lawn),
        ("golden_reed", views::reed),
        ("golden_crossing", views::crossing),
        ("pictures_tell_what_matters", views::pictures_tell_what_matters),
        ("far_from_home", views::far_from_home),
        ("joints_stay_above_ground", views::joints_stay_above_ground),
        ("far_plants_need_one_segment", views::far_plants_need_one_segment),
        ("pictures_between_steps", views::pictures_between_steps),
    ];
    // Every hardware driver draws its own picture, so stored ones are for software drivers.
    adapter::run(tests, |gpu, name| name.starts_with("golden_") && gpu.adapter_info.device_type != wgpu::DeviceType::Cpu)
}
