// What makes air neither come from nowhere nor go there, and what makes it spread; twin of project.rs, where everything is explained.

// A wave of the flow without its divergence, from it and the one that goes the other way; `slopes` are the differences of the wave along x and y,
// `lasts` what is left of it after spreading.
fn fluid_projected(here: vec2<f32>, there: vec2<f32>, slopes: vec2<f32>, lasts: f32) -> vec2<f32> {
    var u = vec2<f32>(here.x + there.x, here.y - there.y) * 0.5;
    var v = vec2<f32>(here.y + there.y, there.x - here.x) * 0.5;
    let size = slopes.x * slopes.x + slopes.y * slopes.y;
    if size > 0.0 {
        let along = (slopes.x * u + slopes.y * v) / size;
        u -= slopes.x * along;
        v -= slopes.y * along;
    }
    u *= lasts;
    v *= lasts;
    return vec2<f32>(u.x - v.y, u.y + v.x);
}
