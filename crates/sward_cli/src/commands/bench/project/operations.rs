//! How many operations an invocation of each pass takes.
//!
//! Instructions that the pass's twin in Rust retires for one cell, plant, blade or sheet, counted by valgrind's `callgrind`, of vector instructions one
//! for each lane: bench/epyc-milan-2-cores/operations.txt has the scenes and the counts. A shader's text does not say it: how often its loops
//! run depends on what bodies do. So these are averages, and right to a factor of two; of the two passes on sheets to three.

/// Pass, and operations of an invocation.
const OPERATIONS: [(&str, f64); 25] = [
    ("rest_pass", 400.0),
    ("wake_pass", 80.0),
    ("contact_pass", 220.0),
    ("wave_pass", 550.0),
    ("lag_pass", 200.0),
    ("virtual_pass", 4600.0),
    ("busy_pass", 130.0),
    ("blades_pass", 11_000.0),
    ("air_pass", 600.0),
    ("fade_pass", 30.0),
    ("touch_pass", 1800.0),
    ("sheet_touch_pass", 16_000.0),
    ("sheet_resolve_pass", 60_000.0),
    ("draw_pass", 170.0),
    ("large_pass", 100.0),
    ("write_pass", 30.0),
    ("plane_pass", 400.0),
    ("plant_pass", 160.0),
    ("force_pass", 50.0),
    ("columns_pass", 370.0),
    ("spread_pass", 370.0),
    ("rows_pass", 370.0),
    ("advect_pass", 110.0),
    ("project_pass", 370.0),
    ("end_pass", 50.0),
];

/// Of a pass; `None` of one that is not known.
pub(crate) fn of(pass: &str) -> Option<f64> {
    OPERATIONS.iter().find(|(name, _)| *name == pass).map(|(_, operations)| *operations)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pass_of_a_step_has_its_operations_and_no_other() {
        let mut known: Vec<&str> = OPERATIONS.iter().map(|(pass, _)| *pass).collect();
        known.sort_unstable();
        assert_eq!(known, sward_wgpu::compute::counted::PASSES);
        assert!(of("wave_pass").is_some() && of("paint_pass").is_none());
    }
}
