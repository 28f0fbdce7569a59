//! Which samples surround a place, and the spline over them.

/// After how many samples a row mirrored about both ends repeats.
pub(super) fn period(samples: i32) -> i32 {
    if samples > 1 { 2 * (samples - 1) } else { 1 }
}

/// The sample that stands at `index` of a row mirrored about its first and last one.
pub(super) fn mirrored(index: i32, samples: i32) -> i32 {
    let within = index.rem_euclid(period(samples));
    if within < samples { within } else { period(samples) - within }
}

/// The Catmull-Rom surface over the middle of 4 × 4 samples, in one precision.
///
/// Only differences from the sample before the place are weighted, so that high ground is as exact as low ground.
macro_rules! catmull_rom {
    ($surface:ident, $weights:ident, $slopes:ident, $float:ty) => {
        fn $weights(t: $float) -> [$float; 4] {
            [((-0.5 * t + 1.0) * t - 0.5) * t, (1.5 * t - 2.5) * t * t + 1.0, ((-1.5 * t + 2.0) * t + 0.5) * t, (0.5 * t - 0.5) * t * t]
        }

        fn $slopes(t: $float) -> [$float; 4] {
            [(-1.5 * t + 2.0) * t - 0.5, (4.5 * t - 5.0) * t, (-4.5 * t + 4.0) * t + 0.5, (1.5 * t - 1.0) * t]
        }

        pub(super) fn $surface(samples: &[[f32; 4]; 4], t: [$float; 2]) -> ($float, [$float; 2]) {
            let base = samples[1][1] as $float;
            let (along_x, slope_x) = ($weights(t[0]), $slopes(t[0]));
            let (along_z, slope_z) = ($weights(t[1]), $slopes(t[1]));
            let (mut height, mut gradient) = (0.0, [0.0; 2]);
            for j in 0..4 {
                let (mut row, mut row_slope) = (0.0, 0.0);
                for i in 0..4 {
                    let above = samples[j][i] as $float - base;
                    row += along_x[i] * above;
                    row_slope += slope_x[i] * above;
                }
                height += along_z[j] * row;
                gradient[0] += along_z[j] * row_slope;
                gradient[1] += slope_z[j] * row;
            }
            (base + height, gradient)
        }
    };
}

catmull_rom!(surface_f32, weights_f32, slopes_f32, f32);
catmull_rom!(surface_f64, weights_f64, slopes_f64, f64);
