// What every drawing pass knows about the frame. Positions are metres relative to the frame origin: the ground position of
// the corner of the camera's patch, y absolute.

struct Frame {
    view_projection: mat4x4<f32>,
    shadow: mat4x4<f32>,  // frame space -> shadow map (xy 0..1, z depth)
    right: vec4<f32>,     // xyz scaled by the half width of the picture plane; w = height of one pixel at distance 1
    up: vec4<f32>,        // xyz scaled by the half height; w = time, s
    forward: vec4<f32>,   // xyz unit; w = exposure factor
    camera: vec4<f32>,    // xyz; w = fog density, 1/m
    phase: vec4<f32>,     // xy = frame origin modulo SHADING_PERIOD; zw = drift of the clouds
    sun: vec4<f32>,       // xyz unit towards the sun; w = haze
    sun_colour: vec4<f32>,// rgb; w = cloud cover
    sky: vec4<f32>,       // rgb mean radiance of the sky; w = metres per shadow texel
    ground: vec4<f32>,    // rgb mean radiance of the ground; w = 1 where the shadow map is in use
    relief: vec4<f32>,    // terrain: xy = samples per metre, zw = sample position of the frame origin
    relief_size: vec4<u32>, // columns, rows
    detail: vec4<f32>,      // noise on top: 1/wavelength, amplitude, roughness; w = depth under water, m, 0 in air
    detail_place: vec4<f32>,// xy = way of the frame origin through its cell
    detail_cell: vec4<i32>, // xy = that cell; z = octaves, w = seed
    edit: vec4<f32>,        // what was added to the ground: x = samples per metre, zw = sample position of the frame origin
    edit_size: vec4<u32>,   // columns, rows, place of the first sample
}

@group(0) @binding(0) var<uniform> frame: Frame;

fn frame_light() -> ShadingLight {
    return ShadingLight(frame.sun.xyz, frame.sun_colour.rgb, frame.sky.rgb, frame.ground.rgb);
}
