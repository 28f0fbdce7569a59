// Light of a picture of the surroundings, and of the volume among the plants. Twin: surroundings.rs of sward_raster. Without a picture: plain.wgsl.

struct Ambient {
    place: vec4<f32>, // corner of the volume in frame space (x, z); 1 / its sides
    shape: vec4<f32>, // 1 / its height; layers; turn of the surroundings; cosine of the sun's radius
    disc: vec4<f32>,  // radiance of the sun's disc; w = brightest that bodies mirror
    horizon: array<vec4<f32>, 5>, // colour of far air
}

@group(0) @binding(12) var<uniform> ambient: Ambient;
@group(0) @binding(13) var ambient_volume: texture_3d<f32>;
@group(0) @binding(14) var ambient_between: sampler;
@group(0) @binding(15) var ambient_picture: texture_2d<f32>;
@group(0) @binding(16) var ambient_round: sampler;

// The light at a place, at a share of the volume's height. The six sides lie above each other in the texture.
fn ambient_faces(place: vec3<f32>, up: f32) -> VolumeFaces {
    let across = (place.xz - ambient.place.xy) * ambient.place.zw;
    let layer = (clamp(up, 0.0, 1.0) * (ambient.shape.y - 1.0) + 0.5) / ambient.shape.y;
    var faces: VolumeFaces;
    for (var side = 0u; side < 6u; side++) {
        faces.sides[side] = textureSampleLevel(ambient_volume, ambient_between, vec3<f32>(across, (f32(side) + layer) / 6.0), 0.0);
    }
    return faces;
}

// Radiance of the surroundings, without the sun.
fn ambient_seen(direction: vec3<f32>) -> vec3<f32> {
    return textureSampleLevel(ambient_picture, ambient_round, environment_place(direction, ambient.shape.z), 0.0).rgb;
}

// Colour that the air adds between the eye and far away, by direction of the ray.
fn frame_air(ray: vec3<f32>) -> vec3<f32> {
    return environment_air(ambient.horizon, ray);
}

fn frame_backdrop(ray: vec3<f32>) -> vec3<f32> {
    return ambient_seen(ray) + environment_disc(ray, frame.sun.xyz, ambient.disc.rgb, ambient.shape.w);
}

// Light of the surroundings on a crown's leaf or wood: that above the grass.
fn frame_crown_sky(albedo: vec3<f32>, normal: vec3<f32>, open: f32, through: f32, place: vec3<f32>) -> vec3<f32> {
    let faces = ambient_faces(place, 1.0);
    return shading_crown_sky(albedo, volume_facing(faces, normal).rgb, volume_facing(faces, -normal).rgb, open, through);
}

// `above`: height of `place` over its root.
fn frame_foliage(species: ShadingSpecies, card: ShadingCard, texel: vec4<f32>, view: vec3<f32>, distance: f32, lit: f32, place: vec3<f32>, above: f32) -> vec3<f32> {
    let light = frame_light();
    let leaf = shading_surface(species, card, texel, view, distance, light);
    let faces = ambient_faces(place, lit_rise(above * ambient.shape.x, leaf.far, card.lying));
    return lit_leaf(leaf.albedo, leaf.normal, view, light, lit * leaf.reached, faces, species.tip.w);
}

fn frame_blade(style: BladeStyle, spot: BladeSpot, view: vec3<f32>, distance: f32, lit: f32, place: vec3<f32>, above: f32) -> vec3<f32> {
    let surface = shading_blade_surface(style, spot, view, distance);
    let faces = ambient_faces(place, lit_rise(above * ambient.shape.x, surface.far, 0.0));
    return lit_blade(style, spot, surface, view, frame_light(), lit, faces);
}

fn frame_ground(turf: ShadingTurf, p: vec2<f32>, normal: vec3<f32>, view: vec3<f32>, distance: f32, lit: f32, place: vec3<f32>) -> vec3<f32> {
    return lit_ground(turf, p, normal, view, distance, frame.right.w, frame_light(), lit, ambient_faces(place, 0.0), ambient_faces(place, 1.0));
}

fn frame_earth(colour: vec3<f32>, p: vec2<f32>, normal: vec3<f32>, view: vec3<f32>, distance: f32, lit: f32, place: vec3<f32>) -> vec3<f32> {
    return lit_earth(colour, p, normal, view, distance, frame.right.w, frame_light(), lit, ambient_faces(place, 0.0));
}

fn frame_body(colour: vec3<f32>, surface: vec3<f32>, normal: vec3<f32>, view: vec3<f32>, lit: f32) -> vec3<f32> {
    let mirror = reflect(-view, normal);
    let seen = min(ambient_seen(shading_mirror_level(mirror)), vec3<f32>(ambient.disc.w));
    let light = frame_light();
    return shading_body_seeing(colour, surface, normal, view, light, lit, shading_reflected(mirror, surface.x, light, seen));
}
