//! Every assembled shader text parses and validates, with WebGPU's default abilities only.

use sward_wgpu::render;

fn validate(text: &str) -> Result<(), String> {
    let module = naga::front::wgsl::parse_str(text).map_err(|error| error.emit_to_string(text))?;
    naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty())
        .validate(&module)
        .map(drop)
        .map_err(|error| error.emit_to_string(text))
}

#[test]
fn assembled_texts_are_valid() {
    let texts = render::assembled();
    assert!(!texts.is_empty());
    for (name, text) in texts {
        validate(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
    }
}

#[test]
fn the_shading_library_stands_alone() {
    validate(&sward::shading::WGSL.join("\n")).unwrap();
}

/// The check must be able to fail.
#[test]
fn a_broken_text_is_refused() {
    let text = render::assemble(&["fn broken() -> f32 { return vec2<f32>(0.0, 0.0); }"]);
    assert!(validate(&text).is_err());
}

/// Size and member offsets of a struct as the shader of `pass` sees it.
fn shader_layout(pass: &str, name: &str) -> (usize, Vec<usize>) {
    let (_, text) = render::assembled().into_iter().find(|(label, _)| *label == pass).unwrap();
    let module = naga::front::wgsl::parse_str(&text).unwrap();
    let (_, found) = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(name)).unwrap();
    match &found.inner {
        naga::TypeInner::Struct { span, members } => (*span as usize, members.iter().map(|member| member.offset as usize).collect()),
        other => panic!("{name} is {other:?}"),
    }
}

#[test]
fn struct_layouts_agree() {
    use render::plants::Plant;
    let (size, offsets) = shader_layout("plants", "Plant");
    assert_eq!(size, size_of::<Plant>());
    let own = [
        std::mem::offset_of!(Plant, root),
        std::mem::offset_of!(Plant, height),
        std::mem::offset_of!(Plant, yaw),
        std::mem::offset_of!(Plant, width),
        std::mem::offset_of!(Plant, tint),
        std::mem::offset_of!(Plant, layer),
    ];
    assert_eq!(offsets, own);
    let (size, _) = shader_layout("sky", "Frame");
    assert_eq!(size, size_of::<render::frame::FrameUniform>());
}
