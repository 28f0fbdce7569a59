//! `sward fit`: frequency and damping ratio of plants that were pulled and let go, and one response from another.

mod read;
mod translate;

use std::fmt::Write;
use std::path::Path;

use serde::Serialize;
use sward::fit::{NotOneMode, Swing, response_of, swing};
use sward::response::oscillator::least_height;
use sward::scene::{
    ChainOverrides, ContinuumOverrides, HarmonicOverrides, OscillatorOverrides, Response, Scene, Species, SpringsOverrides, Stand,
};

use crate::arguments::{self, Kind};
use crate::console::Console;
use crate::failure::Failure;

/// Lower plants are told of only from here on, m.
const TALL: f64 = 0.02;

/// Fits a recording, or a response.
pub(crate) fn run(arguments: &arguments::Fit, console: &Console) -> Result<(), Failure> {
    match &arguments.recording_file {
        Some(path) => measured(path, arguments, console),
        None => translate::run(arguments, console),
    }
}

/// A response of this kind, as the species has it.
fn plain(kind: Kind) -> Response {
    match kind {
        Kind::Continuum => Response::Continuum(ContinuumOverrides::default()),
        Kind::Oscillator => Response::Oscillator(OscillatorOverrides::default()),
        Kind::Springs => Response::Springs(SpringsOverrides::default()),
        Kind::Chain => Response::Chain(ChainOverrides::default()),
        Kind::VirtualInertia => Response::VirtualInertia(ChainOverrides::default()),
        Kind::Harmonic => Response::Harmonic(HarmonicOverrides::default()),
    }
}

/// A recording as JSON.
#[derive(Serialize)]
struct Line<'a> {
    recording: &'a str,
    single_mode: bool,
    #[serde(flatten)]
    swing: Option<Numbers>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    responses: Vec<String>,
}

/// A swing as JSON.
#[derive(Serialize)]
pub(super) struct Numbers {
    swings_at_hz: f64,
    frequency_hz: f64,
    damping_ratio: f64,
    r_squared: f64,
    from_s: f64,
    to_s: f64,
    swings: f64,
    amplitude: f64,
    drift_per_s: f64,
}

impl From<&Swing> for Numbers {
    fn from(swing: &Swing) -> Self {
        Self {
            swings_at_hz: swing.swings_at(),
            frequency_hz: swing.frequency,
            damping_ratio: swing.damping_ratio,
            r_squared: swing.r_squared,
            from_s: swing.window[0],
            to_s: swing.window[1],
            swings: swing.swings(),
            amplitude: swing.amplitude,
            drift_per_s: swing.drift,
        }
    }
}

/// A response that swings as measured, in the words of a scene; or why no scene can have it.
fn written(kind: &Response, swing: &Swing) -> Result<String, String> {
    let response = response_of(kind, swing);
    let species = if matches!(response, Response::Harmonic(_)) { Species::Tree } else { Species::Reed };
    let stand = Stand { species, response: Some(response.clone()), ..Stand::default() };
    match (Scene { stands: vec![stand], ..Scene::default() }).validate() {
        Ok(()) => Ok(format!("response: {}", response.to_ron())),
        Err(error) => Err(error.message),
    }
}

/// The responses that are printed for each recording.
fn asked(to: Option<Kind>) -> Result<Vec<Response>, Failure> {
    match to {
        Some(Kind::Springs) => {
            Err(Failure::input("plants with response `Springs` do not swing", "type another response after --to, like harmonic"))
        }
        Some(kind) => Ok(vec![plain(kind)]),
        None => Ok(vec![plain(Kind::Oscillator), plain(Kind::Harmonic)]),
    }
}

fn measured(path: &Path, arguments: &arguments::Fit, console: &Console) -> Result<(), Failure> {
    let kinds = asked(arguments.to)?;
    let recordings = read::recordings(path, arguments.recording.as_deref())?;
    let found: Vec<(&str, Result<Swing, NotOneMode>)> =
        recordings.iter().map(|named| (named.name.as_str(), swing(&named.recording))).collect();
    if arguments.json {
        let lines: Vec<Line> = found.iter().map(|(name, found)| line(name, found, &kinds)).collect();
        return console.answer(&json(&lines)?);
    }
    console.answer(&table(&found, &kinds))
}

fn json(value: &impl Serialize) -> Result<String, Failure> {
    serde_json::to_string_pretty(value).map_err(|error| Failure::failed(error.to_string()))
}

fn line<'a>(name: &'a str, found: &Result<Swing, NotOneMode>, kinds: &[Response]) -> Line<'a> {
    let swing = found.as_ref().ok();
    Line {
        recording: name,
        single_mode: swing.is_some(),
        swing: swing.map(Numbers::from),
        reason: found.as_ref().err().map(ToString::to_string),
        responses: swing.map_or_else(Vec::new, |swing| kinds.iter().filter_map(|kind| written(kind, swing).ok()).collect()),
    }
}

/// The table, then what to paste.
fn table(found: &[(&str, Result<Swing, NotOneMode>)], kinds: &[Response]) -> String {
    let width = found.iter().map(|(name, _)| name.chars().count()).fold(9, usize::max);
    let mut text = format!(
        "{:width$} {:>10} {:>12} {:>9} {:>8} {:>21} {:>7}\n",
        "recording", "swings, Hz", "undamped, Hz", "damping", "R²", "window, s", "swings"
    );
    let mut paste = String::new();
    // Writing to a string cannot fail.
    for (name, found) in found {
        match found {
            Err(why) => {
                let _ = writeln!(text, "{name:width$} not a single mode: {why}");
            }
            Ok(swing) => {
                let window = format!("{:.2} to {:.2}", swing.window[0], swing.window[1]);
                let _ = writeln!(
                    text,
                    "{name:width$} {:>10.4} {:>12.4} {:>9.4} {:>8.4} {window:>21} {:>7.1}",
                    swing.swings_at(),
                    swing.frequency,
                    swing.damping_ratio,
                    swing.r_squared,
                    swing.swings()
                );
                for kind in kinds {
                    let _ = match written(kind, swing) {
                        Ok(response) => writeln!(paste, "{response}, // {name}"),
                        Err(why) => writeln!(paste, "// {name}: {why}"),
                    };
                }
            }
        }
    }
    if !paste.is_empty() {
        text += &format!("\nFor a stand:\n{paste}{}", lowest(found, kinds));
    }
    text
}

/// What to add for low plants where an oscillator swings slowly.
fn lowest(found: &[(&str, Result<Swing, NotOneMode>)], kinds: &[Response]) -> String {
    let slowest = found.iter().filter_map(|(_, found)| found.as_ref().ok()).map(|swing| swing.frequency).fold(f64::INFINITY, f64::min);
    let height = least_height(slowest, f64::from(Species::Reed.oscillator().spread_stiffness));
    let oscillator = kinds.iter().any(|kind| matches!(kind, Response::Oscillator(_)));
    if !oscillator || height.is_nan() || height < TALL {
        return String::new();
    }
    format!(
        "As oscillators the weakest of plants lower than {height:.2} m would fall over at {slowest:.3} Hz: add spread_stiffness: 0 for these.\n"
    )
}
