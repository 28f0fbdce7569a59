//! `sward grow`: a plant made by code, as a file.

use sward::specimen::grow;

use crate::arguments::{self, Form};
use crate::commands::show::grouped;
use crate::console::Console;
use crate::failure::Failure;
use crate::output;

/// Grows and writes.
pub(crate) fn run(arguments: &arguments::Grow, console: &Console) -> Result<(), Failure> {
    let (form, name) = match arguments.form {
        Form::Bush => (grow::Form::Bush, "bush"),
        Form::Tree => (grow::Form::Tree, "tree"),
        Form::WaterPlant => (grow::Form::WaterPlant, "water-plant"),
    };
    let path = output::plant(arguments.output.as_deref(), name)?;
    let height = arguments.height.unwrap_or(form.height());
    let plant = grow::Grow { form, seed: arguments.seed, triangles: arguments.triangles, height };
    let grown = plant.mesh().map_err(|error| Failure::input(error.to_string(), "see sward grow --help"))?;
    output::write_whole(&path, |out| grown.write(out))?;
    let [triangles, leaves] = [grown.triangles(), grown.leaves].map(grouped);
    console.summary(&format!("{}: {height} m high, {triangles} triangles, {leaves} leaves", path.display()))
}
