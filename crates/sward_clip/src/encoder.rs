//! AV1, by the encoder rav1e.
//!
//! The number of tiles follows from the size alone and no rate is held, so the bytes depend neither on the machine nor on its speed.

use std::sync::Arc;

use rav1e::prelude::*;

use crate::colour::Planes;
use crate::error::ClipError;
use crate::units::{self, SEQUENCE_HEADER};

/// Of rav1e's presets from 0 to 10: the fastest. On meadows 9 and 8 gain 0.05 dB for two and three times the time.
const SPEED: u8 = 10;
/// 0 to 255, where 0 loses nothing.
const QUANTIZER: usize = 60;
/// Seconds between frames that need no others: a player jumps to these.
const KEY_EVERY: u64 = 2;
/// Pixels of a tile, roughly. Tiles are encoded at the same time.
const TILE: usize = 1 << 17;

/// A frame as the file holds it.
pub(crate) struct Sample {
    /// Its bytes.
    pub(crate) bytes: Vec<u8>,
    /// Whether it can be shown without others.
    pub(crate) key: bool,
}

/// An encoder at work. Frames go in one after another, samples come out later, in the same order.
pub(crate) struct Encoder {
    context: Context<u8>,
    /// Of the first sample: what all frames have in common.
    sequence_header: Vec<u8>,
}

impl Encoder {
    /// For frames of `width` by `height` pixels, `rate` a second.
    ///
    /// # Errors
    /// The encoder does not take these numbers.
    pub(crate) fn new([width, height]: [u32; 2], rate: u32) -> Result<Self, ClipError> {
        let (width, height) = (width as usize, height as usize);
        let mut speed_settings = SpeedSettings::from_preset(SPEED);
        // One camera, one take.
        speed_settings.scene_detection_mode = SceneDetectionSpeed::None;
        let mut settings = EncoderConfig {
            width,
            height,
            time_base: Rational::new(1, rate.into()),
            pixel_range: PixelRange::Limited,
            color_description: Some(ColorDescription {
                color_primaries: ColorPrimaries::BT709,
                transfer_characteristics: TransferCharacteristics::SRGB,
                matrix_coefficients: MatrixCoefficients::BT709,
            }),
            quantizer: QUANTIZER,
            tiles: (width * height / TILE).max(1),
            speed_settings,
            ..EncoderConfig::default()
        };
        settings.set_key_frame_interval(0, KEY_EVERY * u64::from(rate));
        let context = Config::new().with_encoder_config(settings).new_context().map_err(|error| refused(&error))?;
        Ok(Self { context, sequence_header: Vec::new() })
    }

    /// Takes a frame and gives the samples that are ready.
    ///
    /// # Errors
    /// The encoder fails.
    pub(crate) fn push(&mut self, planes: &Planes) -> Result<Vec<Sample>, ClipError> {
        let mut frame = self.context.new_frame();
        let half = planes.width / 2;
        for (plane, (samples, width)) in
            frame.planes.iter_mut().zip([(&planes.luma, planes.width), (&planes.blue, half), (&planes.red, half)])
        {
            plane.copy_from_raw_u8(samples, width, 1);
        }
        self.context.send_frame(Arc::new(frame)).map_err(|error| refused(&error))?;
        self.ready()
    }

    /// No more frames come: gives the rest of the samples.
    ///
    /// # Errors
    /// The encoder fails.
    pub(crate) fn finish(&mut self) -> Result<Vec<Sample>, ClipError> {
        self.context.send_frame(None).map_err(|error| refused(&error))?;
        self.ready()
    }

    fn ready(&mut self) -> Result<Vec<Sample>, ClipError> {
        let mut samples = Vec::new();
        loop {
            match self.context.receive_packet() {
                Ok(packet) => samples.push(self.sample(&packet)?),
                Err(EncoderStatus::Encoded) => {}
                Err(EncoderStatus::NeedMoreData | EncoderStatus::LimitReached) => return Ok(samples),
                Err(error) => return Err(refused(&error)),
            }
        }
    }

    fn sample(&mut self, packet: &Packet<u8>) -> Result<Sample, ClipError> {
        let broken = || ClipError::Encoder("the encoder's data are not AV1".to_owned());
        if self.sequence_header.is_empty() {
            let all = units::units(&packet.data).ok_or_else(broken)?;
            let header = all.iter().find(|unit| unit.kind == SEQUENCE_HEADER).ok_or_else(broken)?;
            self.sequence_header = header.bytes.to_vec();
        }
        Ok(Sample { bytes: units::without_delimiter(&packet.data).ok_or_else(broken)?, key: packet.frame_type == FrameType::KEY })
    }

    /// The settings as `av1C` begins with them, and the unit of the sequence header; the latter is there from the first sample on.
    pub(crate) fn headers(&self) -> (Vec<u8>, &[u8]) {
        (self.context.container_sequence_header(), &self.sequence_header)
    }
}

fn refused(error: &dyn std::fmt::Display) -> ClipError {
    ClipError::Encoder(error.to_string())
}
