//! The velocity on the plane as a camera sees it.
//!
//! Chen & Johan 2015, §3.4; methods §5. Differs from the paper: its eq. 2 is not a rotation and changes |V|; here world and view are rotations of one
//! another, so no view of the plane makes motion more or less.

/// Unit axes of a plane or a camera: right, up, forward; right-handed looking along forward.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axes {
    /// To the right.
    pub right: [f32; 3],
    /// Upwards.
    pub up: [f32; 3],
    /// Away from the viewer.
    pub forward: [f32; 3],
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// A velocity on the plane \[m/s along its right and up\] along a camera's right, up and forward, m/s.
pub fn seen(velocity: [f32; 2], plane: &Axes, camera: &Axes) -> [f32; 3] {
    let world = [0, 1, 2].map(|axis: usize| velocity[0] * plane.right[axis] + velocity[1] * plane.up[axis]);
    [camera.right, camera.up, camera.forward].map(|axis| dot(world, axis))
}
