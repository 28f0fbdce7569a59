//! Every kernel against its CPU twin, and whole runs on both backends.

#[path = "support/adapter.rs"]
mod adapter;
#[path = "support/continuum.rs"]
mod continuum;
#[path = "support/kernels.rs"]
mod kernels;
#[path = "support/maths.rs"]
mod maths;

fn main() -> std::process::ExitCode {
    let tests: &[adapter::Test] = &[
        ("small_maths", maths::small_maths),
        ("hashes", maths::hashes),
        ("wind_nodes_and_places", maths::wind_nodes_and_places),
        ("terrain_heights", maths::terrain_heights),
        ("plants_placed", maths::plants_placed),
        ("segments", maths::segments),
        ("contacts", maths::contacts),
        ("bend", continuum::bend),
        ("propagate", continuum::propagate),
        ("limit", continuum::limit),
        ("rest", continuum::rest),
        ("lags", continuum::lags),
    ];
    adapter::run(tests, |_, _| false)
}
