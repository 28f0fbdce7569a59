//! Numbers out of buffers: bounds are checked before anything is allocated.

use super::container::Opened;
use super::error::{FigureError, data};
use super::json::{Accessor, at};

/// Where an accessor's elements lie.
struct Layout<'a> {
    bytes: &'a [u8],
    count: usize,
    stride: usize,
    component: Component,
    normalized: bool,
}

#[derive(Clone, Copy, PartialEq)]
enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    fn of(code: u32) -> Option<Self> {
        Some(match code {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => return None,
        })
    }

    fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    /// The component at the start of `bytes`, at least `size` long.
    fn read(self, bytes: &[u8], normalized: bool) -> f32 {
        let (value, full) = match self {
            Self::I8 => (f32::from(bytes[0] as i8), 127.0),
            Self::U8 => (f32::from(bytes[0]), 255.0),
            Self::I16 => (f32::from(i16::from_le_bytes([bytes[0], bytes[1]])), 32767.0),
            Self::U16 => (f32::from(u16::from_le_bytes([bytes[0], bytes[1]])), 65535.0),
            Self::U32 => (u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]) as f32, 4294967295.0),
            Self::F32 => (f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]), 1.0),
        };
        if !normalized || self == Self::F32 {
            return value;
        }
        let share = value / full;
        if share < -1.0 { -1.0 } else { share }
    }
}

fn width(shape: &str) -> Option<usize> {
    Some(match shape {
        "SCALAR" => 1,
        "VEC2" => 2,
        "VEC3" => 3,
        "VEC4" | "MAT2" => 4,
        "MAT4" => 16,
        _ => return None,
    })
}

impl Opened<'_> {
    /// The bytes of a buffer view.
    pub(crate) fn view(&self, index: usize, place: &str) -> Result<(&[u8], Option<u64>), FigureError> {
        let view = at(&self.root.buffer_views, index, "bufferViews", place)?;
        let inner = format!("bufferViews[{index}]");
        let buffer = at(&self.buffers, view.buffer, "buffers", &inner)?;
        let end = view.byte_offset.checked_add(view.byte_length).filter(|end| *end <= buffer.len() as u64);
        let end = end.ok_or_else(|| data(&inner, format!("reaches beyond the {} bytes of its buffer", buffer.len())))?;
        Ok((&buffer[view.byte_offset as usize..end as usize], view.byte_stride))
    }

    fn layout(&self, accessor: &Accessor, place: &str, widths: &[usize], most: u64) -> Result<Layout<'_>, FigureError> {
        let wrong = |what: String| data(place, what);
        let component = Component::of(accessor.component_type)
            .ok_or_else(|| wrong(format!("has component type {}, known are 5120 to 5126", accessor.component_type)))?;
        let width = width(&accessor.shape).filter(|width| widths.contains(width));
        let width = width.ok_or_else(|| wrong(format!("is of type `{}`, which does not fit its use", accessor.shape)))?;
        within(accessor.count, most, place)?;
        let view = accessor.buffer_view.ok_or_else(|| wrong("has no bufferView, so no data".to_owned()))?;
        let (bytes, stride) = self.view(view, place)?;
        let element = (width * component.size()) as u64;
        let stride = stride.unwrap_or(element);
        let needed = match accessor.count {
            0 => Some(0),
            count => stride.checked_mul(count - 1).and_then(|n| n.checked_add(element)),
        };
        let end = needed.and_then(|n| n.checked_add(accessor.byte_offset)).filter(|end| *end <= bytes.len() as u64);
        if end.is_none() || stride < element {
            return Err(wrong(format!("has {} elements, which reach beyond its bufferView of {} bytes", accessor.count, bytes.len())));
        }
        let bytes = &bytes[accessor.byte_offset as usize..];
        Ok(Layout { bytes, count: accessor.count as usize, stride: stride as usize, component, normalized: accessor.normalized })
    }

    /// Elements of `N` numbers; shorter ones (of the widths given) are filled up with `fill`. All finite.
    pub(crate) fn vectors<const N: usize>(
        &self,
        index: usize,
        widths: &[usize],
        fill: f32,
        most: u64,
        user: &str,
    ) -> Result<Vec<[f32; N]>, FigureError> {
        let read = |layout: &Layout<'_>, width: usize, place: &str| {
            let mut elements = Vec::with_capacity(layout.count);
            for element in 0..layout.count {
                let mut vector = [fill; N];
                for (k, value) in vector.iter_mut().enumerate().take(width) {
                    *value = layout.component.read(layout.at(element, k), layout.normalized);
                    if !value.is_finite() {
                        return Err(data(
                            format!("{place} ({user})"),
                            format!("has {value} in element {element}; a finite number is needed"),
                        ));
                    }
                }
                elements.push(vector);
            }
            Ok(elements)
        };
        self.elements(index, widths, most, user, [0.0; N], read)
    }

    /// Whole numbers: indices of vertices or joints.
    pub(crate) fn integers<const N: usize>(&self, index: usize, most: u64, user: &str) -> Result<Vec<[u32; N]>, FigureError> {
        self.elements(index, &[N], most, user, [0; N], |layout, _, place| layout.integers(place))
    }

    /// The elements of an accessor as `read` makes them; those of a sparse one are `zero`, or what its view holds, where none is given.
    fn elements<T: Copy>(
        &self,
        index: usize,
        widths: &[usize],
        most: u64,
        user: &str,
        zero: T,
        read: impl Fn(&Layout<'_>, usize, &str) -> Result<Vec<T>, FigureError>,
    ) -> Result<Vec<T>, FigureError> {
        let accessor = at(&self.root.accessors, index, "accessors", user)?;
        let place = format!("accessors[{index}]");
        let width = width(&accessor.shape).unwrap_or(0);
        let replaced = accessor.replaced();
        let mut elements = if accessor.buffer_view.is_none() && replaced.is_some() {
            within(accessor.count, most, &place)?;
            vec![zero; accessor.count as usize]
        } else {
            read(&self.layout(accessor, &place, widths, most)?, width, &place)?
        };
        if let Some([indices, values]) = replaced {
            let (which, what) = (format!("{place}.sparse.indices"), format!("{place}.sparse.values"));
            let indices = self.layout(&indices, &which, &[1], most)?.integers::<1>(&which)?;
            let values = read(&self.layout(&values, &what, widths, most)?, width, &what)?;
            for ([index], value) in indices.into_iter().zip(values) {
                let count = elements.len();
                let wrong = || data(&which, format!("has an index {index}, but the accessor has {count} elements"));
                *elements.get_mut(index as usize).ok_or_else(wrong)? = value;
            }
        }
        Ok(elements)
    }
}

fn within(count: u64, most: u64, place: &str) -> Result<(), FigureError> {
    if count <= most { Ok(()) } else { Err(data(place, format!("has {count} elements, at most {most} are read"))) }
}

impl<'a> Layout<'a> {
    /// The bytes from component `k` of an element on.
    fn at(&self, element: usize, k: usize) -> &'a [u8] {
        &self.bytes[element * self.stride + k * self.component.size()..]
    }

    fn integers<const N: usize>(&self, place: &str) -> Result<Vec<[u32; N]>, FigureError> {
        let read = |bytes: &[u8]| match self.component {
            Component::U8 => Some(u32::from(bytes[0])),
            Component::U16 => Some(u32::from(u16::from_le_bytes([bytes[0], bytes[1]]))),
            Component::U32 => Some(u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]])),
            _ => None,
        };
        let mut elements = Vec::with_capacity(self.count);
        for element in 0..self.count {
            let mut vector = [0; N];
            for (k, value) in vector.iter_mut().enumerate() {
                *value = read(self.at(element, k)).ok_or_else(|| data(place, "holds signed or real numbers where indices are needed"))?;
            }
            elements.push(vector);
        }
        Ok(elements)
    }
}
