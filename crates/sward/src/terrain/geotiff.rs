//! A terrain from a TIFF: one channel of heights, and the size of a pixel from its GeoTIFF tags or from a TOML file beside it.
//!
//! OGC GeoTIFF 1.1, §7. Degrees become metres at the latitude of the grid's middle; projected coordinates are taken as they are.

use std::io::Cursor;

use tiff::ColorType;
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::Tag;

use super::error::check;
use super::load::{Sidecar, placed};
use super::{MAX_SAMPLES, MAX_SIDE, Terrain, TerrainError};
use crate::math;

/// No compression that is read here makes data smaller than this share of itself.
const TIGHTEST: u64 = 2000;
/// A foot and a US survey foot, m.
const FEET: [f64; 2] = [0.3048, 0.3048006096];
/// Farther from 0 no height may be, m.
const HIGHEST: f64 = 1e6;

/// Whether bytes begin like a TIFF.
pub fn is_tiff(bytes: &[u8]) -> bool {
    [&b"II*\0"[..], b"MM\0*", b"II+\0", b"MM\0+"].iter().any(|magic| bytes.starts_with(magic))
}

fn bad(what: impl Into<String>) -> TerrainError {
    TerrainError::Tiff(what.into())
}

fn unreadable(error: tiff::TiffError) -> TerrainError {
    bad(format!("is not a readable TIFF: {error}; copy or export it again (gdal_translate -of GTiff)"))
}

/// What the tags say about places and heights.
struct Georeference {
    /// m between samples along x and z.
    spacing: [f64; 2],
    /// Rows go from south to north.
    upside_down: bool,
    /// m per unit of height.
    unit: f64,
}

type Reader<'a> = Decoder<Cursor<&'a [u8]>>;

impl Terrain {
    /// A terrain from the bytes of a TIFF with one channel: int8 to int32, uint8 to uint32, float32 or float64; uncompressed, deflate, LZW
    /// or PackBits, in strips or tiles. Row 0 is the north edge (lowest z), column 0 the west edge (lowest x).
    ///
    /// The size of a pixel comes from ModelPixelScale or ModelTransformation. In a geographic CRS (like EPSG:4326) degrees become metres at
    /// the middle latitude; in a projected one they are metres (or feet, if it says so) as they are: in web mercator (EPSG:3857) the ground is
    /// stretched by 1 / cos latitude, which `scale` may undo. Without those tags `sidecar`, the text of a TOML file, gives
    /// `metres_per_pixel_x` and `metres_per_pixel_y`. Samples without data (GDAL's tag, or NaN) take the height of the nearest one that has;
    /// [`Terrain::filled`] counts them. All three axes are multiplied by `scale` (1e-4..=1e4); the middle of the grid comes to lie at
    /// `offset` (x, z) \[m\].
    ///
    /// Errors say what is wrong with the file, and what to do.
    pub fn from_tiff(bytes: &[u8], sidecar: Option<&str>, scale: f64, offset: [f64; 2]) -> Result<Self, TerrainError> {
        check("scale", scale, "0.0001 to 10000", (1e-4..=1e4).contains(&scale))?;
        let mut reader = Decoder::new(Cursor::new(bytes)).map_err(unreadable)?.with_limits(Limits::default());
        let size = dimensions(&mut reader, bytes.len())?;
        let place = match georeference(&mut reader, size)? {
            Some(place) => place,
            None => {
                let text = sidecar.ok_or_else(|| {
                    bad("has no ModelPixelScale, so its size is unknown; write a GeoTIFF, or put a file of the same name ending in .toml beside it, with lines like `metres_per_pixel_x = 30` and `metres_per_pixel_y = 30`")
                })?;
                Georeference { spacing: Sidecar::spacing_of(text)?, upside_down: false, unit: 1.0 }
            }
        };
        let missing = missing_value(&mut reader);
        let mut heights = samples(reader.read_image().map_err(unreadable)?)?;
        let expected = u64::from(size[0]) * u64::from(size[1]);
        if heights.len() as u64 != expected {
            return Err(TerrainError::Size { what: "heights", found: heights.len() as u64, expected });
        }
        let known = |height: &f64| height.is_finite() && missing.is_none_or(|missing| *height != missing);
        let filled = fill(&mut heights, size[0] as usize, known)?;
        if let Some(height) = heights.iter().find(|height| !(-HIGHEST..=HIGHEST).contains(&(**height * place.unit))) {
            return Err(bad(format!(
                "holds a height of {height}, allowed are -1000000 to 1000000 m; if it means `no data`, say so (gdal_translate -a_nodata {height})"
            )));
        }
        if place.upside_down {
            heights = heights.chunks_exact(size[0] as usize).rev().flatten().copied().collect();
        }
        let metres = place.unit * scale;
        let heights = heights.iter().map(|height| (height * metres) as f32).collect();
        let mut terrain = placed(heights, size, place.spacing, scale, offset)?;
        terrain.filled = filled;
        Ok(terrain)
    }
}

/// Columns and rows: compared with what is allowed, and with what the file can hold, before anything large is allocated.
fn dimensions(reader: &mut Reader<'_>, bytes: usize) -> Result<[u32; 2], TerrainError> {
    let (columns, rows) = reader.dimensions().map_err(unreadable)?;
    let samples = u64::from(columns) * u64::from(rows);
    if columns == 0 || rows == 0 || columns > MAX_SIDE || rows > MAX_SIDE || samples > u64::from(MAX_SAMPLES) {
        return Err(bad(format!(
            "has {columns} x {rows} samples, at most 16384 a side and 33554432 in all are read; make it smaller (gdal_translate -outsize 25% 25%)"
        )));
    }
    let bits = match reader.colortype().map_err(unreadable)? {
        ColorType::Gray(bits) => u64::from(bits),
        other => return Err(bad(format!("is {other:?}, needed is one channel of heights (gdal_translate -b 1)"))),
    };
    if samples * bits / 8 > TIGHTEST * bytes as u64 {
        return Err(bad(format!("announces {columns} x {rows} samples, which its {bytes} bytes cannot hold; copy or export it again")));
    }
    Ok([columns, rows])
}

fn numbers(reader: &mut Reader<'_>, tag: Tag) -> Option<Vec<f64>> {
    reader.find_tag(tag).ok().flatten().and_then(|value| value.into_f64_vec().ok())
}

/// A GeoTIFF key that holds a short number (§7.1.2).
fn key(reader: &mut Reader<'_>, wanted: u64) -> Option<u64> {
    let directory = reader.find_tag_unsigned_vec::<u64>(Tag::GeoKeyDirectoryTag).ok().flatten()?;
    let mut keys = directory.get(4..)?.chunks_exact(4);
    keys.find(|entry| entry[0] == wanted && entry[1] == 0).map(|entry| entry[3])
}

fn feet(unit: Option<u64>) -> f64 {
    match unit {
        Some(9002) => FEET[0],
        Some(9003) => FEET[1],
        _ => 1.0,
    }
}

/// `None` without a pixel size in the tags.
fn georeference(reader: &mut Reader<'_>, size: [u32; 2]) -> Result<Option<Georeference>, TerrainError> {
    let (steps, north, row) = if let Some(scale) = numbers(reader, Tag::ModelPixelScaleTag).filter(|scale| scale.len() >= 2) {
        let tie = numbers(reader, Tag::ModelTiepointTag).filter(|tie| tie.len() >= 6);
        ([scale[0], -scale[1]], tie.as_ref().map(|tie| tie[4]), tie.map_or(0.0, |tie| tie[1]))
    } else if let Some(m) = numbers(reader, Tag::ModelTransformationTag).filter(|matrix| matrix.len() == 16) {
        if m[1] != 0.0 || m[4] != 0.0 {
            return Err(bad("lies askew on the map (ModelTransformation turns it); straighten it (gdalwarp)"));
        }
        ([m[0], m[5]], Some(m[7]), 0.0)
    } else {
        return Ok(None);
    };
    // GTModelTypeGeoKey: 1 projected, 2 geographic, 3 geocentric.
    let (model, unit) = (key(reader, 1024), feet(key(reader, 4099)));
    let mut spacing = steps.map(|step| if step < 0.0 { -step } else { step });
    match model {
        Some(2) => {
            if key(reader, 2054).is_some_and(|unit| unit != 9102) {
                return Err(bad("counts angles in something else than degrees; project it (gdalwarp -t_srs EPSG:4326)"));
            }
            let middle = north.map(|north| north + steps[1] * (0.5 * f64::from(size[1]) - row));
            let latitude = middle.filter(|latitude| (-89.0..=89.0).contains(latitude)).ok_or_else(|| {
                bad("is in degrees, but its ModelTiepoint does not say at which latitude between -89 and 89; project it (gdalwarp)")
            })?;
            let [east, north] = metres_per_degree(latitude);
            spacing = [spacing[0] * east, spacing[1] * north];
        }
        Some(3) => return Err(bad("is geocentric; project it (gdalwarp -t_srs EPSG:4326)")),
        _ => spacing = spacing.map(|step| step * feet(key(reader, 3076))),
    }
    for (name, step) in [("pixel width", spacing[0]), ("pixel height", spacing[1])] {
        check(name, step, "0.001 to 1000000 m", (1e-3..=1e6).contains(&step))?;
    }
    Ok(Some(Georeference { spacing, upside_down: steps[1] > 0.0, unit }))
}

/// Length of a degree of longitude and of latitude on the WGS 84 ellipsoid, m.
fn metres_per_degree(latitude: f64) -> [f64; 2] {
    let (sine, cosine) = math::sin_cos_f64(latitude * std::f64::consts::PI / 180.0);
    let (axis, eccentricity) = (6_378_137.0, 0.006_694_379_990_14);
    let bent = 1.0 - eccentricity * sine * sine;
    let degree = std::f64::consts::PI / 180.0;
    [degree * axis * cosine / bent.sqrt(), degree * axis * (1.0 - eccentricity) / (bent * bent.sqrt())]
}

/// The number that means `no data` (GDAL's tag 42113, as text).
fn missing_value(reader: &mut Reader<'_>) -> Option<f64> {
    let text = reader.find_tag(Tag::GdalNodata).ok().flatten()?.into_string().ok()?;
    text.trim_matches(|c: char| c.is_whitespace() || c == '\0').parse().ok()
}

fn samples(read: DecodingResult) -> Result<Vec<f64>, TerrainError> {
    Ok(match read {
        DecodingResult::U8(list) => list.into_iter().map(f64::from).collect(),
        DecodingResult::I8(list) => list.into_iter().map(f64::from).collect(),
        DecodingResult::U16(list) => list.into_iter().map(f64::from).collect(),
        DecodingResult::I16(list) => list.into_iter().map(f64::from).collect(),
        DecodingResult::U32(list) => list.into_iter().map(f64::from).collect(),
        DecodingResult::I32(list) => list.into_iter().map(f64::from).collect(),
        DecodingResult::F32(list) => list.into_iter().map(f64::from).collect(),
        DecodingResult::F64(list) => list,
        _ => return Err(bad("has samples of 64-bit whole or 16-bit real numbers; convert it (gdal_translate -ot Float32)")),
    })
}

/// Gives each sample without data the height of the nearest one with data, counted in steps to its four neighbours; returns how many.
fn fill(heights: &mut [f64], columns: usize, known: impl Fn(&f64) -> bool) -> Result<u32, TerrainError> {
    let mut done: Vec<bool> = heights.iter().map(known).collect();
    let missing = done.iter().filter(|done| !**done).count();
    if missing == heights.len() {
        return Err(bad("holds no data at all: every sample is marked as missing"));
    }
    let mut rim: Vec<usize> = if missing > 0 { (0..heights.len()).filter(|at| done[*at]).collect() } else { Vec::new() };
    while !rim.is_empty() {
        let mut next = Vec::new();
        for at in rim {
            let column = at % columns;
            let around = [
                (column > 0).then(|| at - 1),
                (column + 1 < columns).then(|| at + 1),
                at.checked_sub(columns),
                Some(at + columns).filter(|below| *below < heights.len()),
            ];
            for other in around.into_iter().flatten() {
                if !done[other] {
                    (heights[other], done[other]) = (heights[at], true);
                    next.push(other);
                }
            }
        }
        rim = next;
    }
    Ok(missing as u32)
}
