//! Every shader text is valid, and says the same as its Rust twin: struct layouts, constants.

mod constants;
mod layouts;
mod libraries;
mod texts;

use texts::{assembled, parse, validate};

#[test]
fn assembled_texts_are_valid() {
    let texts = assembled();
    assert!(texts.len() > 6, "only {} shaders: is one missing from texts.rs?", texts.len());
    for (name, text) in texts {
        validate(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
    }
}

/// The check must be able to fail.
#[test]
fn a_broken_text_is_refused() {
    for (name, text) in assembled() {
        let broken = format!("{text}\nfn broken() -> f32 {{ return vec2<f32>(0.0, 0.0); }}");
        assert!(validate(&broken).is_err(), "{name}");
    }
}

/// WebGPU's default limits: 4 bind groups, 8 storage buffers per stage.
#[test]
fn no_shader_asks_for_more_than_webgpu_grants() {
    for (name, text) in assembled() {
        let module = parse(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
        let info = validate(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
        for (index, entry) in module.entry_points.iter().enumerate() {
            let used = module.global_variables.iter().filter(|(handle, _)| !info.get_entry_point(index)[*handle].is_empty());
            let used: Vec<_> = used.map(|(_, variable)| variable).collect();
            let storage = used.iter().filter(|variable| matches!(variable.space, naga::AddressSpace::Storage { .. })).count();
            assert!(storage <= 8, "{name}: {} uses {storage} storage buffers", entry.name);
            let groups = used.iter().filter_map(|variable| variable.binding).map(|binding| binding.group);
            assert!(groups.into_iter().all(|group| group < 4), "{name}: {} uses too many bind groups", entry.name);
        }
    }
}
