//! The ground's grid: rings of squares around the camera, each twice as coarse as the one inside it.
//!
//! Vertices stand on multiples of their ring's spacing, so they do not slide over the terrain as the camera moves. Towards a
//! ring's outer rim every second vertex moves onto the next, coarser grid; there is no crack.

/// Squares along a ring's side.
const CELLS: i32 = 64;
/// Rings; the outermost reaches `0.5 · SPACING · CELLS · 2^(RINGS−1)` = 4096 m.
const RINGS: i32 = 9;
/// Side of the finest squares, metres.
const SPACING: f32 = 0.5;

/// Vertices (x, z relative to the frame origin, spacing) and triangles.
#[derive(Clone, Debug, Default)]
pub struct Grid {
    /// Position and spacing, metres.
    pub vertices: Vec<[f32; 3]>,
    /// Three per triangle.
    pub indices: Vec<u32>,
}

/// Builds the grid for a camera at `camera` (x, z relative to the frame origin).
///
/// `phase` is the frame origin modulo a multiple of the coarsest spacing: the grid is anchored to the ground, not to the frame.
pub fn build(camera: [f32; 2], phase: [f32; 2]) -> Grid {
    let mut grid = Grid::default();
    let mut hole = None;
    for ring in 0..RINGS {
        let spacing = SPACING * (1 << ring) as f32;
        // The rim must lie on the next grid, so the centre moves in steps of two squares.
        let snap = |axis: usize| {
            let step = 2.0 * spacing;
            ((camera[axis] + phase[axis]) / step).round() * step - phase[axis]
        };
        let centre = [snap(0), snap(1)];
        add_ring(&mut grid, centre, spacing, hole);
        hole = Some((centre, 0.5 * CELLS as f32 * spacing));
    }
    grid
}

fn add_ring(grid: &mut Grid, centre: [f32; 2], spacing: f32, hole: Option<([f32; 2], f32)>) {
    let first = grid.vertices.len() as u32;
    let half = CELLS / 2;
    for row in -half..=half {
        for column in -half..=half {
            let out = row.abs().max(column.abs()) as f32 / half as f32;
            let morph = ((out - 0.70) / 0.26).clamp(0.0, 1.0);
            let shift = |index: i32| index as f32 - if index % 2 == 0 { 0.0 } else { morph * index.signum() as f32 };
            grid.vertices.push([centre[0] + shift(column) * spacing, centre[1] + shift(row) * spacing, spacing]);
        }
    }
    let side = CELLS as u32 + 1;
    for row in 0..CELLS as u32 {
        for column in 0..CELLS as u32 {
            let middle = |index: u32, axis: usize| centre[axis] + (index as f32 + 0.5 - half as f32) * spacing;
            let covered = hole
                .is_some_and(|(inner, reach)| (middle(column, 0) - inner[0]).abs() < reach && (middle(row, 1) - inner[1]).abs() < reach);
            if !covered {
                let at = first + row * side + column;
                grid.indices.extend([at, at + side, at + 1, at + 1, at + side, at + side + 1]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every ring's outer rim vertex must also be a vertex of the next ring.
    #[test]
    fn rims_have_no_cracks() {
        for camera in [[0.3, 9.1], [31.9, 17.2], [-5.0, 3.3]] {
            let grid = build(camera, [96.0, 544.0]);
            let per_ring = ((CELLS + 1) * (CELLS + 1)) as usize;
            for ring in 0..RINGS as usize - 1 {
                let next: std::collections::HashSet<[i64; 2]> = grid.vertices[(ring + 1) * per_ring..(ring + 2) * per_ring]
                    .iter()
                    .map(|v| [(v[0] * 1024.0) as i64, (v[1] * 1024.0) as i64])
                    .collect();
                for (index, v) in grid.vertices[ring * per_ring..(ring + 1) * per_ring].iter().enumerate() {
                    let (row, column) = (index as i32 / (CELLS + 1), index as i32 % (CELLS + 1));
                    if row == 0 || column == 0 || row == CELLS || column == CELLS {
                        assert!(next.contains(&[(v[0] * 1024.0) as i64, (v[1] * 1024.0) as i64]), "ring {ring}: {v:?}");
                    }
                }
            }
        }
    }
}
