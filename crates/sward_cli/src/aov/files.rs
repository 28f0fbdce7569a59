//! The files of outputs: NumPy arrays and OpenEXR.

use std::fs::File;
use std::io::{BufWriter, Error, Result};

use exr::prelude::{AnyChannel, AnyChannels, Compression, Encoding, FlatSamples, Image, Layer, LayerAttributes, WritableImage};
use npyz::{AutoSerialize, WriterBuilder};
use sward::picture::aov::Aov;

use super::Output;

/// One output as an array of (rows, columns), or (rows, columns, 2) for vectors.
pub(super) fn write_npy(writer: &mut BufWriter<File>, aov: &Aov, wanted: Output) -> Result<()> {
    match wanted {
        Output::Depth => save(writer, aov, &[], aov.depth.iter().copied()),
        Output::Motion => save(writer, aov, &[2], aov.motion.iter().flatten().copied()),
        Output::Plant => save(writer, aov, &[], aov.plant.iter().copied()),
    }
}

fn save<T: AutoSerialize>(writer: &mut BufWriter<File>, aov: &Aov, each: &[u64], data: impl Iterator<Item = T>) -> Result<()> {
    let shape = [&[u64::from(aov.height), u64::from(aov.width)], each].concat();
    let mut writer = npyz::WriteOptions::new().default_dtype().shape(&shape).writer(writer).begin_nd()?;
    writer.extend(data)?;
    writer.finish()
}

/// All outputs as channels of one layer, without loss.
pub(super) fn write_exr(writer: &mut BufWriter<File>, aov: &Aov, wanted: &[Output]) -> Result<()> {
    let samples = |output: Output, axis: usize| match output {
        Output::Depth => FlatSamples::F32(aov.depth.clone()),
        Output::Motion => FlatSamples::F32(aov.motion.iter().map(|motion| motion[axis]).collect()),
        Output::Plant => FlatSamples::U32(aov.plant.clone()),
    };
    let named = wanted.iter().flat_map(|output| output.channels().iter().enumerate().map(move |(axis, name)| (*output, axis, *name)));
    let channels = named.map(|(output, axis, name)| AnyChannel::new(name, samples(output, axis))).collect();
    let encoding = Encoding { compression: Compression::ZIP16, ..Encoding::default() };
    let size = (aov.width as usize, aov.height as usize);
    let layer = Layer::new(size, LayerAttributes::default(), encoding, AnyChannels::sort(channels));
    Image::from_layer(layer).write().non_parallel().to_buffered(writer).map_err(Error::other)
}
