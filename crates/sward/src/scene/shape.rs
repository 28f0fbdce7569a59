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
    /// Shapes that move as one.
    pub struct Compound {
        /// The shapes, 1 to 32 of them.
        parts: Vec<Part> = vec![Part::default()], "", required;
    }
}

parameters! {
    /// One shape of a compound.
    pub struct Part {
        /// The shape; neither a truck nor another compound.
        shape: Shape = Shape::Box(BoxShape::default()), "", required;
        /// Position of the shape's foot in the body's frame.
        offset: [f32; 3] = [0.0, 0.0, 0.0], "m" in -30.0..=30.0;
        /// Turn about the vertical; positive turns +z towards +x.
        yaw: f32 = 0.0, "rad" in -100.0..=100.0;
    }
}
