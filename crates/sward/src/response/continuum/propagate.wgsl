// Propagation: bending spreads through the field as a damped wave. Twin: propagate.rs (Chen & Johan eq. 2-6), one cell of its row.

fn continuum_wave_speed(co: ContinuumCoefficients, rate: vec2<f32>) -> f32 {
    return min(co.base_speed + co.speed_gain * continuum_length(rate), co.speed_cap);
}

/// `around` = sum over the four neighbours now; `old` = the cell one step earlier.
fn continuum_propagate(co: ContinuumCoefficients, now: ContinuumCell, old: ContinuumCell, around: ContinuumCell, rest: vec2<f32>) -> ContinuumCell {
    let speed = continuum_wave_speed(co, now.rate);
    let speed_before = continuum_wave_speed(co, old.rate);
    let ratio = select(1.0, speed / speed_before, speed < speed_before);
    let keep = (1.0 - co.damping) * ratio;
    let laplacian = around.bend - 4.0 * now.bend;
    let pulled = speed * speed * co.spread * laplacian - co.restoring * (now.bend - rest);
    var next: ContinuumCell;
    next.bend = now.bend + (keep * (now.bend - old.bend) + pulled);
    let here = 1.0 - 4.0 * co.rate_spread - co.rate_restoring;
    next.rate = here * now.rate + ((1.0 - co.rate_damping) * (now.rate - old.rate) + co.rate_spread * around.rate);
    return next;
}

struct ContinuumLimited {
    cell: ContinuumCell,
    clamped: bool,
}

/// Goes by the comparisons alone: what is no number is over no limit.
fn continuum_limited(cell: ContinuumCell, slope: vec2<f32>) -> ContinuumLimited {
    var next = cell;
    var clamped = false;
    let limit = continuum_bend_limit(slope, cell.bend);
    let size = continuum_length(cell.bend);
    if size > limit {
        next.bend = cell.bend * (limit / size);
        clamped = true;
    }
    let rate = continuum_length(cell.rate);
    if rate > CONTINUUM_RATE_LIMIT {
        next.rate = cell.rate * (CONTINUUM_RATE_LIMIT / rate);
        clamped = true;
    }
    return ContinuumLimited(next, clamped);
}

fn continuum_faded(cell: ContinuumCell, rest: vec2<f32>, keep: f32) -> ContinuumCell {
    return ContinuumCell(rest + (cell.bend - rest) * keep, cell.rate * keep);
}

/// Squared deviation from rest: max(|β − β_eq|², |ω|²).
fn continuum_deviation(cell: ContinuumCell, rest: vec2<f32>) -> f32 {
    let away = cell.bend - rest;
    return max(dot(away, away), dot(cell.rate, cell.rate));
}
