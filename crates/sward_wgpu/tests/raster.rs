//! Pictures drawn on the CPU by `sward_raster` against the GPU's.

#[path = "support/adapter.rs"]
mod adapter;
#[path = "support/rastered.rs"]
mod rastered;

fn main() -> std::process::ExitCode {
    let tests: &[adapter::Test] = &[
        ("hello", rastered::hello),
        ("sparse", rastered::sparse),
        ("lawn", rastered::lawn),
        ("reed", rastered::reed),
        ("crossing", rastered::crossing),
        ("road", rastered::road),
        ("detail", rastered::detail),
        ("paper", rastered::paper),
        ("endless", rastered::endless),
        ("blades", rastered::blades),
        ("footsteps", rastered::footsteps),
        ("sheets", rastered::sheets),
        ("deformed_sheets", rastered::deformed_sheets),
        ("combed", rastered::combed),
        ("surroundings", rastered::surroundings),
        ("layers", rastered::layers),
    ];
    adapter::run(tests, |_, _| None)
}
