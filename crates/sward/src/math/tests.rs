//! Error bounds, same bits in scalar and vector loops, same coefficients in both twins.

use super::*;
use std::hint::black_box;

/// Many evenly spaced arguments, ends included.
fn sweep(low: f64, high: f64) -> impl Iterator<Item = f32> {
    const COUNT: u32 = 1_000_000;
    (0..=COUNT).map(move |i| (low + (high - low) * f64::from(i) / f64::from(COUNT)) as f32)
}

/// Positive arguments over all magnitudes in a range, by their bits.
fn sweep_bits(low: f32, high: f32) -> impl Iterator<Item = f32> {
    let step = (high.to_bits() - low.to_bits()) / 1_000_000;
    (low.to_bits()..=high.to_bits()).step_by(step as usize).map(f32::from_bits)
}

fn relative(ours: f32, exact: f64) -> f64 {
    if exact == 0.0 { f64::from(ours).abs() } else { ((f64::from(ours) - exact) / exact).abs() }
}

fn absolute(ours: f32, exact: f64) -> f64 {
    (f64::from(ours) - exact).abs()
}

fn worst(arguments: impl Iterator<Item = f32>, error: impl Fn(f32) -> f64) -> f64 {
    let mut count = 0;
    let mut worst = 0.0;
    for x in arguments {
        count += 1;
        let error = error(x);
        // NaN is the worst error of all, and stays.
        worst = if error <= worst || f64::is_nan(worst) { worst } else { error };
    }
    assert!(count >= 1_000_000, "a sweep of {count} arguments proves little");
    worst
}

fn check(what: &str, worst: f64, bound: f64) {
    println!("{what}: {worst:.3e} (allowed {bound:.1e})");
    assert!(worst <= bound, "{what}: error {worst:.3e} exceeds {bound:.1e}");
}

#[test]
fn errors_stay_within_the_documented_bounds() {
    check("exp", worst(sweep(-87.3, 88.0), |x| relative(exp(x), f64::from(x).exp())), 1.2e-7);
    for reach in [1.0, 10.0, 1e4] {
        let wide = || sweep(-reach, reach);
        check("sin", worst(wide(), |x| absolute(sin_cos(x).0, f64::from(x).sin())), 1e-7);
        check("cos", worst(wide(), |x| absolute(sin_cos(x).1, f64::from(x).cos())), 1e-7);
    }
    check("sin, digits", worst(sweep(-6.3, 6.3), |x| relative(sin_cos(x).0, f64::from(x).sin())), 1.3e-7);
    check("cos, digits", worst(sweep(-6.3, 6.3), |x| relative(sin_cos(x).1, f64::from(x).cos())), 1.3e-7);
    check("tan", worst(sweep(-1.57, 1.57), |x| relative(tan(x), f64::from(x).tan())), 3e-7);
    check("atan", worst(sweep(-5.0, 5.0), |x| relative(atan(x), f64::from(x).atan())), 2.1e-7);
    check("atan, all", worst(sweep_bits(1e-37, f32::MAX), |x| relative(atan(x), f64::from(x).atan())), 2.1e-7);
    check("cbrt", worst(sweep_bits(1.2e-38, 1e38), |x| relative(cbrt(x), f64::from(x).cbrt())), 1.3e-7);
    check(
        "atan2",
        worst(sweep(-10.0, 10.0), |a| {
            let (s, c) = f64::from(a).sin_cos();
            let (y, x) = ((3.0 * s) as f32, (3.0 * c) as f32);
            absolute(atan2(y, x), f64::from(y).atan2(f64::from(x)))
        }),
        4e-7,
    );
}

#[test]
fn the_error_check_notices_one_wrong_digit() {
    let off = |x: f32| exp(x) * 1.000001;
    assert!(worst(sweep(-87.3, 88.0), |x| relative(off(x), f64::from(x).exp())) > 1.2e-7);
    let nan = |x: f32| relative(if x == 1.0 { f32::NAN } else { x }, f64::from(x));
    assert!(worst(sweep(0.0, 2.0), nan).is_nan());
}

#[test]
fn every_argument_is_answered() {
    let edges = [0.0, -0.0, 1e-45, f32::MIN_POSITIVE, 1e9, 3e38, f32::INFINITY, f32::NEG_INFINITY, f32::NAN];
    for x in edges.into_iter().flat_map(|x| [x, -x]) {
        assert!(exp(x).is_normal(), "exp({x})");
        let (s, c) = sin_cos(x);
        assert!(s.abs() <= 1.0 && c.abs() <= 1.0, "sin_cos({x}) = {s}, {c}");
        let (s, c) = sin_cos_f64(f64::from(x));
        assert!(s.abs() <= 1.0 && c.abs() <= 1.0, "sin_cos_f64({x}) = {s}, {c}");
        assert_eq!(clamped(x, -2.0, 3.0), if x.is_nan() { -2.0 } else { x.clamp(-2.0, 3.0) });
        let _ = (tan(x), cbrt(x), atan2(x, x), atan2_f64(f64::from(x), f64::from(x)));
    }
    assert_eq!(atan(f32::INFINITY), FRAC_PI_2);
    assert_eq!(atan(f32::NEG_INFINITY), -FRAC_PI_2);
    let floors = [-2.5, -2.0, -0.1, -0.0, 0.9, 3e9, f32::NAN].map(floored);
    assert_eq!(floors, [-3, -2, -1, 0, 0, i32::MAX, 0]);
    assert_eq!(cbrt(0.0), 0.0);
    assert_eq!(cbrt(-27.0), -3.0);
    for x in [0.0, -0.0] {
        assert_eq!(atan2(x, x), 0.0);
        assert_eq!(atan2(2.0, x), FRAC_PI_2);
        assert_eq!(atan2_f64(2.0, f64::from(x)), std::f64::consts::FRAC_PI_2);
        assert_eq!(atan2_f64(-2.0, f64::from(x)), -std::f64::consts::FRAC_PI_2);
    }
}

/// One plain loop, which vectorises; the same code for each instruction set.
#[inline(always)]
fn each(arguments: &[f32], function: impl Fn(f32) -> f32) -> Vec<u32> {
    let mut results = vec![0; arguments.len()];
    for (x, result) in arguments.iter().zip(&mut results) {
        *result = function(*x).to_bits();
    }
    results
}

/// How many results of a loop differ from those of single calls that cannot be vectorised.
fn differing(wide: &[u32], arguments: &[f32], function: impl Fn(f32) -> f32) -> usize {
    let single = arguments.iter().map(|x| function(black_box(*x)).to_bits());
    assert!(wide.len() == arguments.len() && !wide.is_empty());
    wide.iter().zip(single).filter(|(wide, single)| **wide != *single).count()
}

#[test]
fn scalar_and_vector_loops_give_the_same_bits() {
    let arguments: Vec<f32> = sweep(-100.0, 100.0).step_by(7).collect();
    macro_rules! same {
        ($($function:expr),*) => {$(
            let wide = pulp::Arch::new().dispatch(|| each(&arguments, $function));
            assert_eq!(differing(&wide, &arguments, $function), 0, stringify!($function));
        )*};
    }
    same!(exp, |x| sin_cos(x).0, |x| sin_cos(x).1, tan, atan, |x| atan2(x, 1.5), |x| atan2(-1.5, x), cbrt);
    same!(|x| lower(x, 2.0), |x| upper(x, -0.0), |x| clamped(x, -1.0, 1.0));
    same!(|x: f32| unit(hash(x.to_bits(), 1, -2, 3, 4)));
    let fused = each(&arguments, |x| x.mul_add(x, 0.1));
    assert!(differing(&fused, &arguments, |x| x * x + 0.1) > 0, "the comparison must notice a fused product");
}

/// The numbers with a point or an exponent in a WGSL text.
fn literals(text: &str) -> Vec<f32> {
    let code = text.lines().map(|line| line.split("//").next().unwrap_or_default());
    let mut found = Vec::new();
    for line in code {
        for word in line.replace("e-", "e~").split(|c: char| !(c.is_ascii_alphanumeric() || c == '.' || c == '~')) {
            if word.starts_with(|c: char| c.is_ascii_digit()) {
                found.extend(word.replace('~', "-").parse::<f32>().ok().filter(|_| word.contains('.')));
            }
        }
    }
    found
}

fn missing(coefficients: &[f32], text: &str) -> Vec<f32> {
    let found = literals(text);
    coefficients.iter().copied().filter(|c| !found.iter().any(|f| f.to_bits() == c.abs().to_bits())).collect()
}

#[test]
fn both_twins_use_the_same_coefficients() {
    let all: Vec<f32> =
        [&EXP_RANGE[..], &EXP_REDUCTION, &EXP, &QUARTER_TURN, &[EIGHTH_TURN], &SIN, &COS, &ATAN_FOLDS, &ATAN, &[SMALLEST, PI]].concat();
    assert_eq!(all.len(), 32);
    assert_eq!(missing(&all, WGSL), [0.0; 0], "not in math.wgsl");
    let off = f32::from_bits(EXP[3].to_bits() + 1);
    assert_eq!(missing(&[EXP[3], off], WGSL), [off], "the search must notice a last digit");
}

/// Parses and validates WGSL files joined to one text, as a GPU would.
pub(crate) fn validate(parts: &[&str]) -> Result<(), String> {
    let text = parts.concat();
    let module = naga::front::wgsl::parse_str(&text).map_err(|e| e.emit_to_string(&text))?;
    let mut validator = naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty());
    validator.validate(&module).map_err(|e| e.emit_to_string(&text))?;
    Ok(())
}

#[test]
fn the_twin_is_valid() {
    validate(&[WGSL]).unwrap();
    assert!(validate(&[WGSL, "fn wrong() -> f32 { return 1u; }"]).is_err());
}
