// Plants that go on swinging when the numbers change by which they swing. Twin: rebase.rs. Needs swing.wgsl.

fn swing_rebased(co: OscillatorCoefficients, own: SwingOwn, record: SwingRecord, now: u32) -> SwingRecord {
    let steps = swing_steps_to(record, now);
    if all(record.deviation == vec2<f32>(0.0)) && record.rate == 0.0 || swing_is_aged(co, record, now) {
        return SwingRecord(vec2<f32>(0.0), 0.0, 0u);
    }
    if steps <= 0 {
        return record;
    }
    return swing_later(own, record, f32(steps) * co.dt, now);
}
