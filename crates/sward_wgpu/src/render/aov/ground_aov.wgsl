// The ground's outputs: it stays where it is.

@vertex
fn ground_aov_vertex(@location(0) corner: vec3<f32>) -> AovPoint {
    let place = ground_place(corner.xy);
    return aov_point(place, place, 0u);
}
