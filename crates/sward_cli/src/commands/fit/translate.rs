//! One response from another.

use std::fmt::Write;

use serde::Serialize;
use sward::fit::{ExperimentError, Swing, Translation};
use sward::scene::{Field, Scene, Stand};

use super::{Numbers, asked, json, plain};
use crate::arguments::{self, Kind};
use crate::console::Console;
use crate::failure::Failure;
use crate::scenes::{Opened, open};

/// A translation as JSON.
#[derive(Serialize)]
struct Translated {
    stand: String,
    from_response: String,
    from: Numbers,
    to: Numbers,
    r_squared: f64,
    response: String,
    notes: Vec<String>,
}

/// Translates the response of a species or of a scene's stand, and prints it.
pub(super) fn run(arguments: &arguments::Fit, console: &Console) -> Result<(), Failure> {
    let (mut stand, patch_side) = given(arguments)?;
    if let Some(from) = arguments.from {
        let plain = plain(from);
        // What a stand says about this very response holds.
        let own = stand.response.as_ref().is_some_and(|own| std::mem::discriminant(own) == std::mem::discriminant(&plain));
        stand.response = if own { stand.response } else { Some(plain) };
    }
    let own = plain(if stand.is_layered() { Kind::Harmonic } else { Kind::Continuum });
    let from_response = stand.response.get_or_insert(own).to_ron();
    let kind = asked(arguments.to)?.remove(0);
    let found = Translation::of(&stand, &kind, patch_side).map_err(failure)?;
    let name = stand.label();
    if arguments.json {
        let Translation { from, to, response, r_squared, notes } = found;
        let (from, to, response) = (Numbers::from(&from), Numbers::from(&to), response.to_ron());
        return console.answer(&json(&Translated { stand: name, from_response, from, to, r_squared, response, notes })?);
    }
    console.answer(&text(&name, &from_response, &found))
}

/// The stand and the side of its scene's patches, m.
fn given(arguments: &arguments::Fit) -> Result<(Stand, f32), Failure> {
    let Some(scene) = &arguments.scene else {
        let stand = Stand { species: arguments.species.into(), ..Stand::default() };
        return Ok((stand, Field::default().patch_side));
    };
    let Opened { scene, name, .. } = open(scene)?;
    let Scene { stands, field, .. } = scene;
    let labels: Vec<String> = stands.iter().map(Stand::label).collect();
    let wanted = |stand: &Stand| arguments.stand.as_ref().is_none_or(|wanted| *wanted == stand.label());
    match stands.into_iter().find(wanted) {
        Some(stand) => Ok((stand, field.patch_side)),
        None if labels.is_empty() => Err(Failure::input(format!("nothing grows in {name}"), "choose a scene with a stand, or --species")),
        None => Err(Failure::input(
            format!("no stand of {name} is called `{}`", arguments.stand.as_deref().unwrap_or_default()),
            format!("its stands: {}", labels.join(", ")),
        )),
    }
}

fn failure(error: ExperimentError) -> Failure {
    let message = match error {
        ExperimentError::Stand(error) => error.message,
        error => error.to_string(),
    };
    Failure::input(message, "choose another response or species; sward fit --help lists them")
}

fn text(name: &str, from: &str, found: &Translation) -> String {
    let swing = |swing: &Swing| {
        let swings_at = if swing.damping_ratio < 1.0 { format!("swings at {:.3} Hz", swing.swings_at()) } else { "creeps back".to_owned() };
        format!("{swings_at}, undamped {:.3} Hz, damping ratio {:.3}", swing.frequency, swing.damping_ratio)
    };
    let mut text = format!("{name}, pulled by 0.2 rad and let go:\n");
    let response = found.response.to_ron();
    let names = [from, &response].map(|response| response.split('(').next().unwrap_or_default());
    let width = names.iter().map(|name| name.len()).fold(0, usize::max);
    // Writing to a string cannot fail.
    for (name, one) in names.iter().zip([&found.from, &found.to]) {
        let _ = writeln!(text, "{name:width$}  {}", swing(one));
    }
    let _ = writeln!(
        text,
        "The second explains {:.1} % of the first one's motion (R² {:.4}).\n\nFor a stand:\nresponse: {response},",
        100.0 * found.r_squared,
        found.r_squared
    );
    for note in &found.notes {
        let _ = writeln!(text, "// {note}");
    }
    text
}
