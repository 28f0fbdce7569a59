//! How long each stage took, picture by picture.

use std::collections::VecDeque;

use sward::response::Stage;
use web_time::Instant;

/// Pictures that are remembered.
pub const PICTURES: usize = 300;

/// The stage in which the driver takes the picture, and may wait for the device.
pub const SUBMITTED: &str = "record and submit picture";

/// One stage's milliseconds.
#[derive(Debug)]
pub struct Row {
    /// What menus say.
    pub name: &'static str,
    /// Whether the device worked, not the processor.
    pub on_device: bool,
    /// Of each picture, the last one last.
    pub past: VecDeque<f32>,
    now: f64,
}

impl Row {
    /// Mean of what is remembered, ms.
    pub fn mean(&self) -> f32 {
        self.past.iter().sum::<f32>() / self.past.len().max(1) as f32
    }
}

/// Milliseconds of all stages.
#[derive(Debug, Default)]
pub struct Times {
    rows: Vec<Row>,
    pictures: u64,
    /// Whether the device is asked, too: that makes the window wait for it now and then.
    pub with_device: bool,
}

/// What a stage is called in plots.
pub fn name(stage: Stage) -> &'static str {
    match stage {
        Stage::Rest => "rest",
        Stage::Contact => "contact",
        Stage::Wave => "wave",
        Stage::Lags => "upper segments",
        Stage::Virtual => "virtual blades",
        Stage::Blades => "blades",
        Stage::Layers => "meshes",
        Stage::Air => "air",
    }
}

impl Times {
    /// Adds to this picture's milliseconds of a stage.
    pub fn add(&mut self, name: &'static str, on_device: bool, milliseconds: f64) {
        let at = self.rows.iter().position(|row| row.name == name && row.on_device == on_device).unwrap_or_else(|| {
            self.rows.push(Row { name, on_device, past: VecDeque::new(), now: 0.0 });
            self.rows.len() - 1
        });
        self.rows[at].now += milliseconds;
    }

    /// Adds what has passed since `before`, which is now from then on.
    pub fn lap(&mut self, name: &'static str, before: &mut Instant) {
        let now = Instant::now();
        self.add(name, false, (now - *before).as_secs_f64() * 1e3);
        *before = now;
    }

    /// Ends a picture.
    pub fn end(&mut self) {
        self.pictures += 1;
        for row in &mut self.rows {
            // The device's clock is asked now and then only: between, what it said last holds.
            let silent = row.on_device && row.now == 0.0;
            let value = if silent { row.past.back().copied().unwrap_or(0.0) } else { row.now as f32 };
            row.past.push_back(value);
            if row.past.len() > PICTURES {
                row.past.pop_front();
            }
            row.now = 0.0;
        }
        self.rows.retain(|row| row.past.iter().any(|value| *value > 0.0));
    }

    /// All stages that took any time lately.
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// What of this picture went into the driver, ms.
    pub fn waited(&self) -> f64 {
        self.rows.iter().filter(|row| row.name == SUBMITTED).map(|row| row.now).sum()
    }

    /// Whether the device is to be asked.
    pub fn asks(&self) -> bool {
        self.with_device
    }

    /// Pictures so far.
    pub fn pictures(&self) -> u64 {
        self.pictures
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stages_are_summed_picture_by_picture_and_forgotten() {
        let mut times = Times::default();
        times.add("wave", false, 1.0);
        times.add("wave", false, 2.0);
        times.add("shadows", true, 5.0);
        times.end();
        times.end();
        let of = |name: &str| times.rows().iter().find(|row| row.name == name).map(|row| row.past.iter().copied().collect::<Vec<_>>());
        assert_eq!(of("wave"), Some(vec![3.0, 0.0]));
        assert_eq!(of("shadows"), Some(vec![5.0, 5.0]), "the device is not asked every time");
        (0..PICTURES).for_each(|_| times.end());
        assert!(times.rows().iter().all(|row| row.name != "wave"), "a stage that is over is not shown for ever");
    }
}
