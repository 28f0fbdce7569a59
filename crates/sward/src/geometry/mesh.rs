//! Triangle meshes of bodies, made by code.
//!
//! Right-handed, +Y up, metres; counter-clockwise triangles face outwards. Forward is +z.

use glam::{Vec2, Vec3};

use crate::interaction::distance_map::{Cube, DistanceMap};

/// What a surface looks like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Linear RGB albedo (metals: reflectance).
    pub colour: [f32; 3],
    /// 1 where a body's own colour replaces `colour`, else 0.
    pub paint: f32,
    /// 0 mirror .. 1 chalk.
    pub roughness: f32,
    /// Mirror share seen straight on: 0.04 plastic and lacquer, up to 0.9 chrome.
    pub gloss: f32,
}

/// One corner of a triangle.
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Vertex {
    /// Metres, body frame.
    pub position: [f32; 3],
    /// Unit, outwards.
    pub normal: [f32; 3],
    /// Linear RGB, and the paint share.
    pub colour: [f32; 4],
    /// Roughness and gloss, see [`Material`].
    pub surface: [f32; 2],
}

/// Vertices and triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Corners; shared only between triangles of one smooth surface.
    pub vertices: Vec<Vertex>,
    /// Three per triangle.
    pub indices: Vec<u32>,
}

/// Lacquer in the body's own colour.
pub const PAINT: Material = Material { colour: [0.6, 0.6, 0.6], paint: 1.0, roughness: 0.28, gloss: 0.05 };

impl Mesh {
    /// An axis-aligned box of full edge lengths `size` that stands on the ground, its edges broken by `chamfer`.
    pub fn cuboid(size: Vec3, chamfer: f32, material: Material) -> Self {
        let mut mesh = Self::default();
        let half = 0.5 * size;
        mesh.chamfered(Vec3::new(-half.x, 0.0, -half.z), Vec3::new(half.x, size.y, half.z), chamfer, material);
        mesh
    }

    /// An ellipsoid of the given radii about its centre, `rings` × 2·`rings` smooth facets.
    pub fn ellipsoid(radii: Vec3, rings: u32, material: Material) -> Self {
        let rings = rings.clamp(3, 256);
        let mut mesh = Self::default();
        for ring in 0..=rings {
            let (sine, cosine) = (std::f32::consts::PI * ring as f32 / rings as f32).sin_cos();
            for step in 0..=2 * rings {
                let (s, c) = (std::f32::consts::PI * step as f32 / rings as f32).sin_cos();
                let unit = Vec3::new(sine * s, cosine, sine * c);
                mesh.push(unit * radii, (unit / radii.max(Vec3::splat(1e-6))).normalize_or(Vec3::Y), material);
            }
        }
        let row = 2 * rings + 1;
        for at in (0..rings).flat_map(|ring| (0..2 * rings).map(move |step| ring * row + step)) {
            mesh.indices.extend([at, at + row, at + 1, at + 1, at + row, at + row + 1]);
        }
        mesh
    }

    /// A convex ground polygon of points (x, z), raised to `height`. Either turning sense will do.
    pub fn prism(points: &[Vec2], height: f32, material: Material) -> Self {
        let mut mesh = Self::default();
        let lift = |p: Vec2, y: f32| Vec3::new(p.x, y, p.y);
        let mut ring = points.to_vec();
        if signed_area(&ring) > 0.0 {
            ring.reverse();
        }
        for (at, &a) in ring.iter().enumerate() {
            let b = ring[(at + 1) % ring.len()];
            mesh.polygon(&[lift(a, 0.0), lift(b, 0.0), lift(b, height), lift(a, height)], material);
        }
        mesh.polygon(&ring.iter().map(|&p| lift(p, height)).collect::<Vec<_>>(), material);
        mesh.polygon(&ring.iter().rev().map(|&p| lift(p, 0.0)).collect::<Vec<_>>(), material);
        mesh
    }

    /// Appends a convex, flat polygon given counter-clockwise as seen from outside.
    pub fn polygon(&mut self, corners: &[Vec3], material: Material) {
        let mut normal = Vec3::ZERO;
        for (at, &a) in corners.iter().enumerate() {
            normal += a.cross(corners[(at + 1) % corners.len()]);
        }
        let normal = normal.normalize_or(Vec3::Y);
        let first = self.vertices.len() as u32;
        for &corner in corners {
            self.push(corner, normal, material);
        }
        for at in 2..corners.len() as u32 {
            self.indices.extend([first, first + at - 1, first + at]);
        }
    }

    /// Appends a box between two corners with broken edges.
    pub fn chamfered(&mut self, low: Vec3, high: Vec3, chamfer: f32, material: Material) {
        let c = chamfer.min(0.24 * (high - low).min_element()).max(0.0);
        let corner = |z: f32, y: f32| Vec2::new(z, y);
        // Bevels of a few millimetres are never seen; sharp edges save four fifths of the triangles.
        if c < 0.0125 {
            let square = [corner(low.z, low.y), corner(high.z, low.y), corner(high.z, high.y), corner(low.z, high.y)];
            return self.extrude(&square, [low.x, high.x], 0.0, material, |_| 1.0);
        }
        let profile = [
            corner(low.z + c, low.y),
            corner(high.z - c, low.y),
            corner(high.z, low.y + c),
            corner(high.z, high.y - c),
            corner(high.z - c, high.y),
            corner(low.z + c, high.y),
            corner(low.z, high.y - c),
            corner(low.z, low.y + c),
        ];
        self.extrude(&profile, [low.x, high.x], c, material, |_| 1.0);
    }

    /// Appends a side profile of points (z, y), counter-clockwise with z to the right, extruded from x\[0\] to x\[1\].
    ///
    /// The ends are inset by `chamfer`; `narrow(y)` scales x by height (a cabin leans inwards). The profile may be concave.
    pub fn extrude(&mut self, profile: &[Vec2], x: [f32; 2], chamfer: f32, material: Material, narrow: impl Fn(f32) -> f32) {
        let inner = inset(profile, chamfer);
        let place = |p: Vec2, x: f32| Vec3::new(x * narrow(p.y), p.y, p.x);
        let [left, right] = x;
        for at in 0..profile.len() {
            let next = (at + 1) % profile.len();
            let (a, b) = (profile[at], profile[next]);
            self.polygon(
                &[place(a, left + chamfer), place(a, right - chamfer), place(b, right - chamfer), place(b, left + chamfer)],
                material,
            );
            if chamfer > 0.0 {
                let (c, d) = (inner[at], inner[next]);
                for (rim, end, corners) in [(right - chamfer, right, [b, a, c, d]), (left + chamfer, left, [a, b, d, c])] {
                    let [e, f, g, h] = corners;
                    let bevel = [place(e, rim), place(f, rim), place(g, end), place(h, end)];
                    self.polygon(&bevel, material);
                }
            }
        }
        for [a, b, c] in triangulate(&inner) {
            self.polygon(&[place(a, right), place(c, right), place(b, right)], material);
            self.polygon(&[place(a, left), place(b, left), place(c, left)], material);
        }
    }

    /// Appends a wheel-like body: profile points (x, radius) turned about the x axis through `centre`.
    pub fn lathe(&mut self, profile: &[Vec2], centre: Vec3, steps: u32, material: Material) {
        for pair in profile.windows(2) {
            let (a, b) = (pair[0], pair[1]);
            let along = (b - a).normalize_or(Vec2::X);
            let first = self.vertices.len() as u32;
            for step in 0..=steps {
                let (s, c) = (std::f32::consts::TAU * step as f32 / steps as f32).sin_cos();
                let out = Vec3::new(0.0, c, s);
                let normal = out * along.x - Vec3::X * along.y;
                self.push(centre + Vec3::X * a.x + out * a.y, normal, material);
                self.push(centre + Vec3::X * b.x + out * b.y, normal, material);
            }
            for step in 0..steps {
                let at = first + 2 * step;
                self.indices.extend([at, at + 2, at + 1, at + 1, at + 2, at + 3]);
            }
        }
    }

    /// Its depth cube map, `size` texels along a side.
    pub fn distance_map(&self, size: u32) -> DistanceMap {
        let points: Vec<[f32; 3]> = self.vertices.iter().map(|vertex| vertex.position).collect();
        DistanceMap::new(Cube::around(&points, size), size, &points, self.indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]))
    }

    /// Appends another mesh.
    pub fn append(&mut self, other: &Self) {
        let first = self.vertices.len() as u32;
        self.vertices.extend_from_slice(&other.vertices);
        self.indices.extend(other.indices.iter().map(|index| index + first));
    }

    fn push(&mut self, position: Vec3, normal: Vec3, material: Material) {
        let [r, g, b] = material.colour;
        self.vertices.push(Vertex {
            position: position.to_array(),
            normal: normal.to_array(),
            colour: [r, g, b, material.paint],
            surface: [material.roughness, material.gloss],
        });
    }
}

/// Twice the area; positive when the points turn counter-clockwise.
fn signed_area(points: &[Vec2]) -> f32 {
    (0..points.len()).map(|at| points[at].perp_dot(points[(at + 1) % points.len()])).sum()
}

/// Moves every edge of a counter-clockwise polygon inwards by `distance`.
fn inset(points: &[Vec2], distance: f32) -> Vec<Vec2> {
    let count = points.len();
    (0..count)
        .map(|at| {
            let before = (points[at] - points[(at + count - 1) % count]).normalize_or(Vec2::X).perp();
            let after = (points[(at + 1) % count] - points[at]).normalize_or(Vec2::X).perp();
            let middle = before + after;
            points[at] + middle * (distance * 2.0 / middle.length_squared().max(0.5))
        })
        .collect()
}

/// Cuts a simple counter-clockwise polygon into triangles by clipping ears.
fn triangulate(points: &[Vec2]) -> Vec<[Vec2; 3]> {
    let mut ring = points.to_vec();
    let mut triangles = Vec::new();
    while ring.len() > 3 {
        let count = ring.len();
        let ear = (0..count).find(|&at| {
            let (a, b, c) = (ring[(at + count - 1) % count], ring[at], ring[(at + 1) % count]);
            (b - a).perp_dot(c - b) > 0.0 && !ring.iter().any(|&p| p != a && p != b && p != c && inside(p, a, b, c))
        });
        // A self-crossing ring has no ear; cutting any corner still ends.
        let at = ear.unwrap_or(0);
        triangles.push([ring[(at + count - 1) % count], ring[at], ring[(at + 1) % count]]);
        ring.remove(at);
    }
    if let [a, b, c] = ring[..] {
        triangles.push([a, b, c]);
    }
    triangles
}

fn inside(p: Vec2, a: Vec2, b: Vec2, c: Vec2) -> bool {
    (b - a).perp_dot(p - a) >= 0.0 && (c - b).perp_dot(p - b) >= 0.0 && (a - c).perp_dot(p - c) >= 0.0
}
