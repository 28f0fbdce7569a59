//! Shapes of interactors. In a body's own frame +y is up and +z is forward; the lowest point touches y = 0.

use super::parameters::{choices, parameters};

choices! {
    /// The shape of a body.
    pub enum Shape {
        /// A box.
        Box(BoxShape),
        /// An upright prism over a convex polygon.
        Polygon(Polygon),
        /// A ball.
        Sphere(Sphere),
        /// A ball stretched along its axes.
        Ellipsoid(Ellipsoid),
        /// A pickup truck, 4.8 m long and 2 m wide.
        Truck,
        /// Several shapes that move as one, for concave bodies.
        Compound(Compound),
        /// A body from a glTF file, cut into convex pieces; clips move it.
        Mesh(MeshShape),
    }
}

parameters! {
    /// A box, seen from above centred on the body's position.
    pub struct BoxShape {
        /// Width (x), height (y) and length (z, forward).
        size: [f32; 3] = [1.0, 1.0, 1.0], "m" in 0.01..=30.0;
    }
}

parameters! {
    /// An upright prism over a convex polygon.
    pub struct Polygon {
        /// Corners (x, z) in order, either way round: 3 to 16 of them, convex.
        points: Vec<[f32; 2]> = vec![[-0.5, -0.5], [0.5, -0.5], [0.0, 0.5]], "m" in -30.0..=30.0, required;
        /// Height of the prism.
        height: f32 = 1.0, "m" in 0.01..=30.0;
    }
}

parameters! {
    /// A ball.
    pub struct Sphere {
        /// Radius.
        radius: f32 = 0.5, "m" in 0.01..=30.0;
    }
}

parameters! {
    /// An ellipsoid.
    pub struct Ellipsoid {
        /// Half axes along x, y and z.
        radii: [f32; 3] = [0.5, 0.5, 0.5], "m" in 0.01..=30.0;
    }
}

parameters! {
    /// A body from a glTF 2.0 file. Its origin is the body's position; glTF's +y is up and its forward +z, as here.
    pub struct MeshShape {
        /// Path of the `.glb`, or of a `.gltf` with its buffers and pictures embedded or beside it, relative to the scene file's folder or to
        /// the folder above that. At most 1000000 triangles, 4096 nodes, 512 joints and nodes with a mesh.
        file: String = String::new(), "", required;
        /// Factor on all three dimensions. A glTF unit is a metre; a file in centimetres needs 0.01. The body must come out 0.01 to 200 m long.
        scale: f64 = 1.0, "" in 0.00001..=10000.0;
        /// Turn about the vertical that brings the file's front to +z: 3.1416 where it faces -z, -1.5708 where it faces +x.
        yaw: f32 = 0.0, "rad" in -100.0..=100.0;
        /// Whether the lowest point of the body, over the whole clip if it plays one, stands at the height of the path; otherwise the file's origin does.
        grounded: bool = true, "";
        /// Shift in the body's own frame after that: to its left, up, ahead.
        offset: [f32; 3] = [0.0, 0.0, 0.0], "m" in -100.0..=100.0;
        /// Most convex pieces that each rigid part of the file (a node with a mesh) is cut into: 1 is its convex hull. A joint of a skin is always one
        /// piece. Every piece is tested against the plants near it in every step.
        pieces: u32 = 8, "" in 1..=64;
        /// Animation that the file's nodes follow, by name; without it they stay as exported.
        clip: Option<String> = None, "";
        /// Speed of the clip: 2 is twice as fast, 0 stands still in its first pose, negative plays backwards. A walk looks right where its steps are as long as
        /// the path's speed asks for.
        clip_speed: f32 = 1.0, "" in -100.0..=100.0;
        /// Where in the clip the body is when it appears.
        clip_start: f32 = 0.0, "s" in 0.0..=1000000.0;
        /// Whether the clip plays over and over, or once and holds its last pose.
        repeat: bool = true, "";
    }
}

parameters! {
    /// Shapes that move as one.
    pub struct Compound {
        /// The shapes, 1 to 32 of them.
        parts: Vec<Part> = vec![Part::default()], "", required;
    }
}

parameters! {
    /// One shape of a compound.
    pub struct Part {
        /// The shape; neither a truck, nor a mesh, nor another compound.
        shape: Shape = Shape::Box(BoxShape::default()), "", required;
        /// Position of the shape's foot in the body's frame.
        offset: [f32; 3] = [0.0, 0.0, 0.0], "m" in -30.0..=30.0;
        /// Turn about the vertical; positive turns +z towards +x.
        yaw: f32 = 0.0, "rad" in -100.0..=100.0;
    }
}
