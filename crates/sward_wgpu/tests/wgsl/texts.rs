//! All shaders, as the passes hand them to the device.

use sward_wgpu::render::prepare::{Bending, Solved};
use sward_wgpu::{compute, render};

/// Every assembled shader with its name. A new host of WGSL adds its text here.
pub(crate) fn assembled() -> Vec<(&'static str, String)> {
    let mut texts = render::assembled();
    texts.push(("step", compute::passes::assembled()));
    for (names, solved) in [
        (["prepare", "prepare blade by blade", "prepare plant by plant", "prepare sheet by sheet"], Solved::Spines),
        (["prepare sheets", "prepare sheets blade by blade", "prepare sheets plant by plant", "prepare deformed sheets"], Solved::Sheets),
    ] {
        let bendings = [Bending::Continuum, Bending::Chain, Bending::Swing, Bending::Sheet];
        texts.extend(names.into_iter().zip(bendings.map(|bending| render::prepare::assembled(bending, solved))));
    }
    let names = ["ask", "ask blade by blade", "ask plant by plant", "ask sheet by sheet"];
    let bendings = [Bending::Continuum, Bending::Chain, Bending::Swing, Bending::Sheet];
    texts.extend(names.into_iter().zip(bendings.map(compute::ask::assembled)));
    texts.push(("step sheet by sheet", compute::sheets::assembled()));
    texts.push(("step plant by plant", compute::swings::assembled()));
    texts.push(("distance maps", compute::distance_maps::assembled()));
    texts.push(("waves of meshes", compute::layers::assembled()));
    texts.push(("air that flows", compute::fluid::assembled()));
    texts.push(("step blade by blade", compute::blades::assembled()));
    texts
}

/// The text of one shader.
pub(crate) fn text_of(name: &str) -> String {
    assembled().into_iter().find(|(label, _)| *label == name).unwrap_or_else(|| panic!("no shader called {name}")).1
}

pub(crate) fn parse(text: &str) -> Result<naga::Module, String> {
    naga::front::wgsl::parse_str(text).map_err(|error| error.emit_to_string(text))
}

/// Checks a text as WebGPU does without optional features.
pub(crate) fn validate(text: &str) -> Result<naga::valid::ModuleInfo, String> {
    let module = parse(text)?;
    naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty())
        .validate(&module)
        .map_err(|error| error.emit_to_string(text))
}
