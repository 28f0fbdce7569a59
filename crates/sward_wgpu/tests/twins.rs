//! Every kernel against its CPU twin, and whole runs on both backends.

#[path = "support/adapter.rs"]
mod adapter;
#[path = "support/asked.rs"]
mod asked;
#[path = "support/blades.rs"]
mod blades;
#[path = "support/chains.rs"]
mod chains;
#[path = "support/continuum.rs"]
mod continuum;
#[path = "support/controls.rs"]
mod controls;
#[path = "support/counted.rs"]
mod counted;
#[path = "support/distance_maps.rs"]
mod distance_maps;
#[path = "support/fluids.rs"]
mod fluids;
#[path = "../../sward/tests/figures/glb.rs"]
#[allow(dead_code)] // Only two of its figures are used.
mod glb;
#[path = "support/halves.rs"]
mod halves;
#[path = "support/inputs.rs"]
mod inputs;
#[path = "support/kernels.rs"]
mod kernels;
#[path = "support/layers.rs"]
mod layers;
#[path = "support/lit.rs"]
mod lit;
#[path = "support/maths.rs"]
mod maths;
#[path = "support/matrix.rs"]
mod matrix;
#[path = "support/prepared.rs"]
mod prepared;
#[path = "support/reactions.rs"]
mod reactions;
#[path = "support/runs.rs"]
mod runs;
#[path = "support/scenes.rs"]
mod scenes;
#[path = "support/shading.rs"]
mod shading;
#[path = "support/sheets.rs"]
mod sheets;
#[path = "support/springs.rs"]
mod springs;
#[path = "support/swings.rs"]
mod swings;
#[path = "support/waits.rs"]
mod waits;

fn main() -> std::process::ExitCode {
    let tests: &[adapter::Test] = &[
        ("small_maths", maths::small_maths),
        ("hashes", maths::hashes),
        ("wind_nodes_and_places", maths::wind_nodes_and_places),
        ("counted_passes", counted::passes_of_all_responses),
        ("fluid_steps", fluids::steps),
        ("fluid_runs", fluids::runs),
        ("layer_waves", layers::waves),
        ("terrain_heights", maths::terrain_heights),
        ("terrain_detail", maths::terrain_detail),
        ("terrain_edits", maths::terrain_edits),
        ("plants_placed", maths::plants_placed),
        ("growth_covers", maths::growth_covers),
        ("segments", maths::segments),
        ("contacts", maths::contacts),
        ("bend", continuum::bend),
        ("propagate", continuum::propagate),
        ("limit", continuum::limit),
        ("limited", continuum::limited),
        ("rest", continuum::rest),
        ("lags", continuum::lags),
        ("patterns", shading::patterns),
        ("tones", shading::tones),
        ("skies", shading::skies),
        ("waters", shading::waters),
        ("leaves", shading::leaves),
        ("cards_pixels", shading::cards_pixels),
        ("grounds", shading::grounds),
        ("earths", shading::earths),
        ("bodies_lit", shading::bodies),
        ("surroundings", lit::surroundings),
        ("leaves_in_a_volume", lit::leaves),
        ("blades_in_a_volume", lit::blades),
        ("grounds_in_a_volume", lit::grounds),
        ("rungs", shading::rungs),
        ("reliefs", shading::reliefs),
        ("relief_edits", shading::relief_edits),
        ("denser_fog_is_found", shading::denser_fog_is_found),
        ("oscillations", chains::oscillations),
        ("swing_poses", swings::poses),
        ("swing_tilts", swings::tilts),
        ("swing_touches", swings::touches),
        ("swing_runs", swings::run),
        ("swing_costs", swings::released_plants_cost_nothing),
        ("air_solved", prepared::air_solved),
        ("swings_solved", prepared::swings_solved),
        ("sheets_solved", prepared::sheets_solved),
        ("sheets_stay_above_ground", prepared::sheets_stay_above_ground),
        ("sheet_runs", sheets::runs),
        ("sheet_steps", sheets::steps),
        ("sheets_of_figures", sheets::figures),
        ("sheets_by_the_thousand", sheets::many),
        ("sheets_handed_over", sheets::handed_over),
        ("sheet_costs", sheets::free_billboards_cost_nothing),
        ("sheets_bent", prepared::sheets_bent),
        ("deformed_sheets_solved", prepared::deformed_sheets_solved),
        ("distance_maps", distance_maps::solids),
        ("distance_maps_of_figures", distance_maps::figures),
        ("springs_contacts", springs::contacts),
        ("springs_poses", springs::poses),
        ("springs_recoveries", springs::recoveries),
        ("springs_pushes", springs::pushes),
        ("springs_lays", springs::lays),
        ("chain_steps", chains::steps),
        ("chain_poses", chains::poses),
        ("strips", blades::strips),
        ("blades_lit", blades::lit),
        ("blades_solved", blades::solved),
        ("blades_without_room", blades::room_ends),
        ("plants_solved", prepared::plants_solved),
        ("plants_on_edited_ground", prepared::plants_on_edited_ground),
        ("road_and_rising_ground", scenes::road_and_rising_ground),
        ("level_ground_is_raised", scenes::level_ground_is_raised),
        ("inputs_followed", inputs::followed),
        ("reactions_of_meshes", reactions::of_meshes),
        ("questions_answered", asked::answers),
        ("truck_on_hills", scenes::truck_on_hills),
        ("lawn_and_sphere", scenes::lawn_and_sphere),
        ("bodies_in_reed", scenes::bodies_in_reed),
        ("sleeping_and_waking", scenes::sleeping_and_waking),
        ("touched_blades", scenes::touched_blades),
        ("chains", scenes::chains),
        ("natural_wind", scenes::natural_wind),
        ("each_lag", scenes::each_lag),
        ("substeps", scenes::substeps),
        ("small_budget", scenes::small_budget),
        ("two_stands", scenes::two_stands),
        ("one_percent_is_found", controls::one_percent_is_found),
        ("swapped_planes_are_found", controls::swapped_planes_are_found),
        ("hand_over", controls::hand_over),
        ("nobody_waits", waits::nobody_waits),
        ("half_words", halves::half_words),
        ("half_runs", halves::half_runs),
        ("half_sleeps", halves::half_sleeps),
        ("half_continues", halves::half_continues),
        ("half_memory", halves::half_memory),
        ("room_ends", halves::room_ends),
        ("one_dispatch_a_stage", halves::one_dispatch_a_stage),
        ("everything_meets_everything", matrix::matrix),
    ];
    adapter::run(tests, |_, name| distance_maps::missing(name))
}
