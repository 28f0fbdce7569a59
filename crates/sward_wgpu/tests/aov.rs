//! Outputs beside pictures: a car pass followed from frame to frame, and the CPU's outputs against the GPU's.

#[path = "support/adapter.rs"]
mod adapter;
#[path = "../../sward_raster/tests/support/edited.rs"]
mod edited;
#[path = "../../sward_raster/tests/support/exact.rs"]
mod exact;
#[allow(dead_code)]
#[path = "../../sward/tests/figures/glb.rs"]
mod glb;
#[path = "support/outputs.rs"]
mod outputs;
#[path = "../../sward_raster/tests/support/reprojection.rs"]
mod reprojection;
#[path = "../../sward_raster/tests/support/verdicts.rs"]
mod verdicts;

fn main() -> std::process::ExitCode {
    let tests: &[adapter::Test] = &[
        ("a_car_pass_is_followed", outputs::a_car_pass_is_followed),
        ("outputs_agree", outputs::outputs_agree),
        ("sheets_are_followed", outputs::sheets_are_followed),
        ("outputs_of_sheets_agree", outputs::outputs_of_sheets_agree),
        ("deformed_sheets_are_followed", outputs::deformed_sheets_are_followed),
        ("outputs_of_deformed_sheets_agree", outputs::outputs_of_deformed_sheets_agree),
        ("blades_are_followed", outputs::blades_are_followed),
        ("outputs_of_blades_agree", outputs::outputs_of_blades_agree),
        ("cells_of_the_gpu_are_remembered", outputs::cells_of_the_gpu_are_remembered),
        ("outputs_of_layers_agree", outputs::outputs_of_layers_agree),
        ("waves_of_the_gpu_are_remembered", outputs::waves_of_the_gpu_are_remembered),
        ("air_of_the_gpu_is_remembered", outputs::air_of_the_gpu_is_remembered),
        ("cells_may_change_their_place", outputs::cells_may_change_their_place),
        ("edited_ground_is_no_motion", outputs::edited_ground_is_no_motion),
        ("asking_for_outputs_changes_no_picture", outputs::asking_for_outputs_changes_no_picture),
    ];
    adapter::run(tests, |_, _| None)
}
