//! `sward bench --recovery`: how long bent grass takes to stand up, by the laws of others and by ours, at 30 to 1000 frames a second.

mod laws;
mod ours;

use std::fmt::Write;

use serde::Serialize;

use super::{quoted, write_figures};
use crate::arguments;
use crate::console::Console;
use crate::failure::Failure;
use crate::output;
use crate::progress::Progress;
use laws::Law;
use ours::Ours;

/// Frames a second.
const RATES: [u32; 7] = [30, 60, 90, 144, 240, 500, 1000];

/// How one law recovers.
#[derive(Debug, Serialize)]
struct Row {
    law: &'static str,
    ours: bool,
    /// How long it is meant to take, s.
    meant_s: f64,
    /// How long it takes at each rate, s; none where it never ends.
    seconds: Vec<Option<f64>>,
    /// How far off that is, as a share of what is meant.
    errors: Vec<Option<f64>>,
    /// The largest of them, either way; none where it never ends.
    worst: Option<f64>,
}

/// All laws.
#[derive(Debug, Serialize)]
struct Report {
    sward: &'static str,
    frames_per_second: [u32; RATES.len()],
    laws: Vec<Row>,
}

impl Row {
    fn new(law: &'static str, ours: bool, meant_s: f64, seconds: Vec<f64>) -> Self {
        let ended: Vec<Option<f64>> = seconds.into_iter().map(|seconds| seconds.is_finite().then_some(seconds)).collect();
        let errors: Vec<Option<f64>> = ended.iter().map(|seconds| seconds.map(|seconds| seconds / meant_s - 1.0)).collect();
        let worst =
            errors.iter().try_fold(0.0_f64, |worst, error| error.map(|error| if error.abs() > worst.abs() { error } else { worst }));
        Self { law, ours, meant_s, seconds: ended, errors, worst }
    }
}

/// Measures all laws.
fn measured(progress: &mut Progress) -> Result<Report, Failure> {
    let mut rows: Vec<Row> = Law::ALL
        .iter()
        .map(|law| Row::new(law.name(), false, laws::MEANT, RATES.map(|rate| law.recovery(f64::from(rate))).into()))
        .collect();
    for ours in Ours::ALL {
        let mut seconds = Vec::new();
        for rate in RATES {
            seconds.push(ours.recovery(rate)?);
            progress.advance();
        }
        rows.push(Row::new(ours.name(), true, ours::meant(), seconds));
    }
    Ok(Report { sward: env!("CARGO_PKG_VERSION"), frames_per_second: RATES, laws: rows })
}

/// Measures all laws and prints a table.
pub(crate) fn run(arguments: &arguments::Bench, console: &Console) -> Result<(), Failure> {
    if let Some(folder) = &arguments.output {
        output::folder(folder, false)?;
        output::make_folder(folder)?;
    }
    let mut progress = Progress::new((Ours::ALL.len() * RATES.len()) as u64, "rates", console);
    let report = measured(&mut progress)?;
    drop(progress);
    console.answer(&report.table())?;
    arguments.output.as_ref().map_or(Ok(()), |folder| write_figures(folder, "recovery", &report, &report.csv()))
}

impl Report {
    /// For a reader.
    fn table(&self) -> String {
        let mut text = format!(
            "Seconds until bent grass stands again, by frames a second: until nothing is left of a linear law, {} % of others.\n\
             *meant*: what the law takes in very short frames, or as tuned; of ours, what {} say.\n\n",
            100.0 * laws::LEFT,
            "frequency and damping ratio"
        );
        // Writing to a string cannot fail.
        let _ = write!(text, "{:36} {:>6}", "law", "meant");
        for rate in self.frames_per_second {
            let _ = write!(text, " {rate:>6}");
        }
        let _ = writeln!(text, " {:>8}", "worst");
        for (at, row) in self.laws.iter().enumerate() {
            if row.ours && !self.laws[at.saturating_sub(1)].ours {
                let _ = writeln!(text, "ours");
            }
            let _ = write!(text, "{:36} {:6.3}", row.law, row.meant_s);
            for seconds in &row.seconds {
                let _ = write!(text, " {:>6}", told(*seconds, |seconds| format!("{seconds:.3}")));
            }
            let _ = writeln!(text, " {:>8}", told(row.worst, |worst| format!("{:+.1} %", 100.0 * worst)));
        }
        text
    }

    /// For a spreadsheet.
    fn csv(&self) -> String {
        let mut text = String::from("law,ours,meant_s,frames_per_second,seconds,error\n");
        for row in &self.laws {
            for ((rate, seconds), error) in self.frames_per_second.iter().zip(&row.seconds).zip(&row.errors) {
                let number = |value: &Option<f64>| value.map_or_else(String::new, |value| format!("{value:.6}"));
                let (law, seconds, error) = (quoted(row.law), number(seconds), number(error));
                let _ = writeln!(text, "{law},{},{:.6},{rate},{seconds},{error}", row.ours, row.meant_s);
            }
        }
        text
    }
}

fn told(value: Option<f64>, number: impl Fn(f64) -> String) -> String {
    value.map_or_else(|| "never".to_owned(), number)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report() -> Report {
        measured(&mut Progress::new(0, "rates", &Console { quiet: true })).expect("measured")
    }

    /// Figures in README and docs/cli.md.
    #[test]
    fn ours_recover_in_one_time_at_every_rate_and_those_of_others_do_not() {
        let report = report();
        let worst = |name: &str| report.laws.iter().find(|row| row.law == name).expect("listed").worst.expect("it ends").abs();
        for ours in Ours::ALL {
            println!("{}: {:.4}", ours.name(), worst(ours.name()));
        }
        assert!(worst(Ours::FixedSteps.name()) < 0.01);
        assert!(worst(Ours::StepAFrame.name()) < 0.02);
        assert!(worst(Ours::FunctionOfTime.name()) < 0.001);
        // Controls: the same measure finds the others out, and finds the one that is exact to be so.
        let off = [(Law::LinearIn10Bits, 0.35), (Law::ShareOfGap, 0.9), (Law::RateTimesFrame, 0.04), (Law::Spring, 0.04)];
        for (law, least) in off {
            assert!(worst(law.name()) > least, "{law:?}: {}", worst(law.name()));
        }
        assert!(worst(Law::Exponential.name()) < 0.001);
    }

    #[test]
    fn tables_name_every_law_and_say_what_never_ends() {
        let row = |seconds: Vec<f64>| Row::new("a law", false, 1.0, seconds);
        let laws = vec![row(vec![1.5; RATES.len()]), row(vec![1.0, f64::INFINITY, 1.0, 1.0, 1.0, 1.0, 1.0])];
        let report = Report { sward: "", frames_per_second: RATES, laws };
        let table = report.table();
        assert!(table.contains("+50.0 %") && table.matches("never").count() == 2, "{table}");
        let csv = report.csv();
        assert_eq!(csv.lines().count(), 1 + 2 * RATES.len());
        assert!(csv.contains("\"a law\",false,1.000000,30,1.500000,0.500000\n") && csv.contains(",60,,\n"), "{csv}");
    }
}
