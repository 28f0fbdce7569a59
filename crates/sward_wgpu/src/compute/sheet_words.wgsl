// Stored sheets of deformed billboards: how they lie in their words. Twin: response/springs/pool.rs in the core. Needs sheet.wgsl, push.wgsl.
// The host declares `fn sheet_word(index: u32) -> u32`.

fn sheet_words(co: SpringsCoefficients) -> u32 {
    let vertices = springs_columns(co) * (springs_rows(co) - 1u);
    return 3u * vertices + (vertices + 3u) / 4u + 1u;
}

// A vertex, counted from the first one above the feet.
fn sheet_vertex(first: u32, k: u32) -> vec3<f32> {
    let at = first + 3u * k;
    return bitcast<vec3<f32>>(vec3<u32>(sheet_word(at), sheet_word(at + 1u), sheet_word(at + 2u)));
}

fn sheet_steps(co: SpringsCoefficients, first: u32) -> u32 {
    return sheet_word(first + sheet_words(co) - 1u);
}
