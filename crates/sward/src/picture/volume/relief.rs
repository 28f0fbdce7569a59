//! The ground under the volume, and the hills around it.

use super::room::Room;
use crate::response::each::each;
use crate::terrain::Terrain;

/// Hills are looked for from here, in voxels, …
const NEAREST: f64 = 1.0;
/// … in steps that grow by this factor, …
const GROWTH: f64 = 1.22;
/// … up to here, m.
const FARTHEST: f64 = 600.0;

/// Heights of the ground at the columns' middles, m above the first one's; and, for each column, the tangent of the skyline's height in `round`
/// directions over the ground, from +x towards +z. No skyline on level ground.
pub(super) fn relief(terrain: &Terrain, room: &Room, round: u32) -> (Vec<f32>, Vec<f32>) {
    let [columns, rows, _] = room.size;
    if terrain.is_flat() {
        return (vec![0.0; room.columns()], Vec::new());
    }
    let first = {
        let [x, z] = room.middle(0, 0);
        terrain.height_at(x, z)
    };
    let ways: Vec<[f64; 2]> = (0..round)
        .map(|way| {
            let turn = (f64::from(way) + 0.5) / f64::from(round) * std::f64::consts::TAU;
            let (sine, cosine) = crate::math::sin_cos_f64(turn);
            [cosine, sine]
        })
        .collect();
    let lines = each((0..rows).collect(), |row| {
        let (mut heights, mut skyline) = (Vec::new(), Vec::new());
        for column in 0..columns {
            let [x, z] = room.middle(column, row);
            let own = terrain.height_at(x, z);
            heights.push((own - first) as f32);
            for [along_x, along_z] in &ways {
                let (mut distance, mut steepest) = (NEAREST * room.voxel[0].max(room.voxel[1]), f64::NEG_INFINITY);
                while distance < FARTHEST {
                    let height = terrain.height_at(x + along_x * distance, z + along_z * distance);
                    steepest = steepest.max((height - own) / distance);
                    distance *= GROWTH;
                }
                skyline.push(steepest as f32);
            }
        }
        (heights, skyline)
    });
    let (mut heights, mut skyline) = (Vec::new(), Vec::new());
    for (own, line) in lines {
        heights.extend(own);
        skyline.extend(line);
    }
    (heights, skyline)
}
