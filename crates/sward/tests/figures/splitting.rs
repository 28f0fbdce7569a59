//! Concave bodies in convex pieces, and what grass meets of them.

use glam::{DMat4, DVec3};
use serde_json::json;
use sward::figure::{Figure, Part};

use crate::Test;
use crate::glb::{Glb, block, table};

pub(crate) const TESTS: &[Test] = &[
    ("a_table_stands_on_legs", a_table_stands_on_legs),
    ("one_piece_is_the_hull", one_piece_is_the_hull),
    ("parts_cover_the_surface", parts_cover_the_surface),
    ("the_same_file_is_cut_alike", the_same_file_is_cut_alike),
    ("an_underside_lies_below_its_part", an_underside_lies_below_its_part),
    ("flat_and_tiny_meshes_are_parts_too", flat_and_tiny_meshes_are_parts_too),
    ("colours_come_down_to_corners", colours_come_down_to_corners),
];

pub(crate) fn read(glb: &Glb, pieces: u32) -> Figure {
    Figure::read(&glb.bytes(), &|name| Err(format!("{name} is missing")), pieces).unwrap_or_else(|error| panic!("{error}"))
}

/// How far a point is outside the hull of a part, file units; negative inside.
pub(crate) fn outside(part: &Part, point: DVec3) -> f64 {
    let away = part.faces.iter().map(|face| {
        let [a, b, c] = face.map(|index| part.points[index as usize]);
        (b - a).cross(c - a).normalize_or_zero().dot(point - a)
    });
    away.fold(f64::MIN, f64::max)
}

/// Lowest underside over a ground position; `None` where nothing is.
pub(crate) fn under(parts: &[Part], at: [f64; 2]) -> Option<f64> {
    let above = |part: &Part| {
        let posed = part.posed(&DMat4::IDENTITY)?;
        let flat: Vec<DVec3> = part.points.iter().map(|point| DVec3::new(point.x, 0.0, point.z)).collect();
        let covers = is_over(&flat, at);
        covers.then(|| posed.under[1] + posed.gradient[0] * (at[0] - posed.under[0]) + posed.gradient[1] * (at[1] - posed.under[2]))
    };
    parts.iter().filter_map(above).min_by(f64::total_cmp)
}

/// Whether some triangle of the points covers a place.
fn is_over(points: &[DVec3], at: [f64; 2]) -> bool {
    let side = |a: DVec3, b: DVec3| (b.x - a.x) * (at[1] - a.z) - (b.z - a.z) * (at[0] - a.x);
    // Outside a convex outline some line through two points has it alone on one side.
    !points.iter().any(|a| {
        points.iter().any(|b| {
            let apart = (b.x - a.x).hypot(b.z - a.z) > 1e-9;
            let ahead = |c: &DVec3| (b.x - a.x) * (c.z - a.z) - (b.z - a.z) * (c.x - a.x);
            apart && side(*a, *b) < -1e-9 && points.iter().all(|c| ahead(c) >= -1e-9)
        })
    })
}

fn a_table_stands_on_legs() {
    let figure = read(&table(), 8);
    assert!((5..=8).contains(&figure.parts.len()), "{} parts", figure.parts.len());
    for at in [[0.0, 0.0], [0.5, 1.0], [0.0, -1.3], [-0.6, 0.3]] {
        let height = under(&figure.parts, at).expect("the top is over it");
        assert!(height > 0.6, "{height} m under the top at {at:?}");
    }
    for (x, z) in [(-0.9, -1.4), (0.9, -1.4), (-0.9, 1.4), (0.9, 1.4)] {
        // A leg's part reaches a little into the top, so its plane may rise outwards: below the leg's foot it is at most as much too low.
        let foot = under(&figure.parts, [x, z]);
        assert!(foot.is_some_and(|height| (-0.15..0.01).contains(&height)), "no leg at {x}, {z}: {foot:?}");
    }
    assert_eq!(under(&figure.parts, [1.3, 0.0]), None);
}

fn one_piece_is_the_hull() {
    let figure = read(&table(), 1);
    assert_eq!(figure.parts.len(), 1);
    // Control of the test above: the hull of a table stands on its whole area.
    assert!(under(&figure.parts, [0.0, 0.0]).is_some_and(|height| height.abs() < 0.01));
}

fn parts_cover_the_surface() {
    for pieces in [2, 5, 16] {
        let figure = read(&table(), pieces);
        let mut worst: f64 = 0.0;
        for triangle in &figure.triangles {
            let [a, b, c] = triangle.map(|index| DVec3::from_array(figure.vertices[index as usize].position.map(f64::from)));
            for (s, t) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (0.3, 0.3), (0.5, 0.5), (0.1, 0.7)] {
                let point = a + (b - a) * s + (c - a) * t;
                worst = worst.max(figure.parts.iter().map(|part| outside(part, point)).fold(f64::MAX, f64::min));
            }
        }
        // A voxel is 9 cm; hulls are taken in 98 directions.
        assert!(worst < 0.03, "{pieces} pieces leave the surface by {worst} m");
        let lost = figure.parts[1..].iter().map(|part| outside(part, figure.parts[0].points[0])).fold(f64::MAX, f64::min);
        assert!(lost > 0.03 || pieces == 2, "control: without its part a corner is outside");
    }
}

fn the_same_file_is_cut_alike() {
    let cut = |glb: &Glb| read(glb, 8).parts;
    assert_eq!(cut(&table()), cut(&table()));
    let mut fingerprint = 0xcbf2_9ce4_8422_2325_u64;
    for number in cut(&table()).iter().flat_map(|part| part.points.iter().flat_map(|point| point.to_array())) {
        fingerprint = (fingerprint ^ number.to_bits()).wrapping_mul(0x0100_0000_01b3);
    }
    let (file, found) = (concat!(env!("CARGO_MANIFEST_DIR"), "/tests/figures/table.hash"), format!("{fingerprint:016x}"));
    if std::env::var_os("SWARD_ACCEPT").is_some() {
        std::fs::write(file, format!("{found}\n")).unwrap_or_else(|error| panic!("{file}: {error}"));
    }
    let expected = std::fs::read_to_string(file).unwrap_or_else(|error| panic!("{file}: {error}"));
    assert_eq!(found, expected.trim(), "pieces must not differ between machines");
    let mut other = table();
    other.binary[8] ^= 0x10;
    assert_ne!(cut(&other), cut(&table()), "control: another table");
}

fn an_underside_lies_below_its_part() {
    // A wedge: its underside rises along +z by 0.5 m a metre.
    let mut glb = Glb::new();
    let (mut positions, triangles) = block([-1.0, 0.0, 0.0], [1.0, 1.0, 1.0]);
    positions.iter_mut().filter(|p| p[1] == 0.0 && p[2] == 1.0).for_each(|p| p[1] = 0.5);
    let mesh = glb.mesh(&positions, &triangles, json!({}));
    glb.top(json!({"mesh": mesh}));
    let figure = read(&glb, 1);
    let posed = figure.parts[0].posed(&DMat4::IDENTITY).expect("in bounds");
    assert!((posed.gradient[0]).abs() < 1e-9 && (posed.gradient[1] - 0.5).abs() < 1e-9, "{posed:?}");
    assert!((posed.under[1] - 0.25).abs() < 1e-9 && posed.lowest == 0.0, "{posed:?}");
    let turned = DMat4::from_rotation_x(0.4) * DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.0));
    for matrix in [DMat4::IDENTITY, turned, DMat4::from_rotation_z(1.9), DMat4::from_rotation_x(2.4)] {
        let posed = figure.parts[0].posed(&matrix).expect("in bounds");
        let above = figure.parts[0].points.iter().map(|point| {
            let p = matrix.transform_point3(*point);
            p.y - posed.under[1] - posed.gradient[0] * (p.x - posed.under[0]) - posed.gradient[1] * (p.z - posed.under[2])
        });
        let least = above.fold(f64::MAX, f64::min);
        assert!(least.abs() < 1e-9, "the plane of {matrix} touches, but cuts nothing: {least}");
        assert!(posed.gradient[0].hypot(posed.gradient[1]) <= 1.0 + 1e-12);
    }
    assert_eq!(figure.parts[0].posed(&DMat4::from_scale(DVec3::splat(1e6))), None);
}

fn flat_and_tiny_meshes_are_parts_too() {
    for positions in [
        vec![[0.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 1.0]],
        vec![[0.0; 3]; 3],
        vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]],
        vec![[0.0, 0.0, 0.0], [1e-30, 0.0, 0.0], [0.0, 1e-30, 0.0]],
    ] {
        let mut glb = Glb::new();
        let mesh = glb.mesh(&positions, &[[0, 1, 2]], json!({}));
        glb.top(json!({"mesh": mesh}));
        let figure = read(&glb, 8);
        let posed = figure.parts[0].posed(&DMat4::IDENTITY).expect("in bounds");
        assert_eq!(posed.lowest, f64::from(positions[0][1]));
        assert_eq!((posed.under[1], posed.gradient), (posed.lowest, [0.0; 2]));
    }
}

fn colours_come_down_to_corners() {
    let mut picture = image::RgbImage::new(2, 1);
    picture.put_pixel(0, 0, image::Rgb([255, 0, 0]));
    picture.put_pixel(1, 0, image::Rgb([0, 188, 0]));
    let mut png = std::io::Cursor::new(Vec::new());
    picture.write_to(&mut png, image::ImageFormat::Png).expect("in memory");
    let mut glb = Glb::new();
    let view = glb.view(&png.into_inner());
    glb.push("images", json!({"bufferView": view, "mimeType": "image/png"}));
    glb.push("textures", json!({"source": 0}));
    glb.push(
        "materials",
        json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "baseColorFactor": [1, 0.5, 1, 1], "metallicFactor": 0}}),
    );
    let uvs = glb.floats(&[0.1, 0.5, 0.9, 0.5, 1.9, 0.5], "VEC2");
    let mesh = glb.mesh(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]], &[[0, 1, 2]], json!({"TEXCOORD_0": uvs}));
    glb.json["meshes"][mesh]["primitives"][0]["material"] = json!(0);
    glb.top(json!({"mesh": mesh}));
    let colours: Vec<[f32; 4]> = read(&glb, 1).vertices.iter().map(|vertex| vertex.colour).collect();
    let green = 0.5 * ((188.0_f32 / 255.0 + 0.055) / 1.055).powf(2.4);
    for (found, expected) in colours.iter().zip([[1.0, 0.0, 0.0, 0.0], [0.0, green, 0.0, 0.0], [0.0, green, 0.0, 0.0]]) {
        assert!(found.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-3), "{colours:?}");
    }
    glb.json["materials"] = json!([]);
    glb.json["meshes"][mesh]["primitives"][0]["material"] = json!(null);
    assert_eq!(read(&glb, 1).vertices[0].colour[3], 1.0, "without a material the body's paint shows");
}
