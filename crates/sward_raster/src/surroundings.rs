//! Light as the scene's settings give it, or that of a picture of the surroundings and of the volume among the plants. Twin of `plain.wgsl`
//! and `surroundings.wgsl` of `sward_wgpu`.

use glam::{Vec2, Vec3, Vec4Swizzles};
use sward::picture::volume::{AmbientUniform, Lighting};
use sward::shading::blade::{self, BladeStyle};
use sward::shading::body;
use sward::shading::crown;
use sward::shading::environment;
use sward::shading::foliage::{self, Card};
use sward::shading::ground;
use sward::shading::look::{Style, Turf};
use sward::shading::sky::{air, backdrop};
use sward::shading::volume::{Faces, facing, lit};
use sward::shading::water::water;

use crate::sight::Sight;

/// A picture of the surroundings in a frame.
pub(crate) struct Surroundings<'a> {
    pub(crate) lighting: &'a Lighting,
    pub(crate) uniform: AmbientUniform,
}

impl Surroundings<'_> {
    fn faces(&self, place: Vec3, up: f32) -> Faces {
        self.uniform.faces(&self.lighting.volume, place, up)
    }

    fn seen(&self, direction: Vec3) -> Vec3 {
        self.lighting.environment.radiance_at(direction)
    }

    fn horizon(&self) -> [Vec3; 5] {
        self.uniform.horizon.map(|[r, g, b, _]| Vec3::new(r, g, b))
    }
}

impl Sight<'_> {
    /// What air adds between the eye and far away.
    pub(crate) fn air(&self, ray: Vec3) -> Vec3 {
        match &self.surroundings {
            Some(around) => environment::air(&around.horizon(), ray),
            None if self.frame.detail.w > 0.0 => water(ray, &self.light),
            None => air(ray, self.light.sun, self.haze()),
        }
    }

    /// What is seen behind everything.
    pub(crate) fn backdrop(&self, ray: Vec3) -> Vec3 {
        let Some(around) = &self.surroundings else {
            if self.frame.detail.w > 0.0 {
                return water(ray, &self.light);
            }
            return backdrop(ray, self.light.sun, self.haze(), self.frame.sun_colour.w, self.frame.phase.zw());
        };
        let [r, g, b, _] = around.uniform.disc;
        around.seen(ray) + environment::disc(ray, self.light.sun, Vec3::new(r, g, b), around.uniform.shape[3])
    }

    /// Radiance of a leaf at `place`, `above` m over its root.
    pub(crate) fn foliage(
        &self,
        style: &Style,
        card: &Card,
        texel: Vec3,
        view: Vec3,
        distance: f32,
        lit: f32,
        (place, above): (Vec3, f32),
    ) -> Vec3 {
        let Some(around) = &self.surroundings else {
            return foliage::foliage(style, card, texel, view, distance, &self.light, lit);
        };
        let leaf = foliage::surface(style, card, texel, view, distance, &self.light);
        let faces = around.faces(place, lit::rise(around.uniform.up(above), leaf.far, card.lying));
        lit::leaf(leaf.albedo, leaf.normal, view, &self.light, lit * leaf.reached, &faces, style.tip[3])
    }

    /// Radiance of a blade at `place`, `above` m over its root.
    pub(crate) fn blade(
        &self,
        style: &BladeStyle,
        spot: &blade::Spot,
        view: Vec3,
        distance: f32,
        lit: f32,
        (place, above): (Vec3, f32),
    ) -> Vec3 {
        let Some(around) = &self.surroundings else {
            return blade::blade(style, spot, view, distance, &self.light, lit);
        };
        let surface = blade::surface(style, spot, view, distance);
        let faces = around.faces(place, lit::rise(around.uniform.up(above), surface.far, 0.0));
        lit::blade(style, spot, &surface, view, &self.light, lit, &faces)
    }

    /// Radiance of the ground at `place`.
    pub(crate) fn ground(&self, turf: &Turf, p: Vec2, normal: Vec3, view: Vec3, distance: f32, lit: f32, place: Vec3) -> Vec3 {
        let pixel = self.frame.right.w;
        match &self.surroundings {
            None => ground::ground(turf, p, normal, view, distance, pixel, &self.light, lit),
            Some(around) => {
                let (floor, tops) = (around.faces(place, 0.0), around.faces(place, 1.0));
                lit::ground(turf, p, normal, view, distance, pixel, &self.light, lit, (&floor, &tops))
            }
        }
    }

    /// Radiance of bare earth at `place`.
    pub(crate) fn earth(&self, colour: Vec3, p: Vec2, normal: Vec3, view: Vec3, distance: f32, lit: f32, place: Vec3) -> Vec3 {
        let pixel = self.frame.right.w;
        match &self.surroundings {
            None => ground::earth(colour, p, normal, view, distance, pixel, &self.light, lit),
            Some(around) => lit::earth(colour, p, normal, view, distance, pixel, &self.light, lit, &around.faces(place, 0.0)),
        }
    }

    /// Light of the sky on a crown's leaf or wood.
    pub(crate) fn crown_sky(&self, albedo: Vec3, normal: Vec3, open: f32, through: f32, place: Vec3) -> Vec3 {
        let [front, back] = match &self.surroundings {
            None => [normal, -normal].map(|normal| self.light.ground.lerp(self.light.sky, 0.5 + 0.5 * normal.y)),
            Some(around) => {
                let faces = around.faces(place, 1.0);
                [normal, -normal].map(|normal| facing(&faces, normal).xyz())
            }
        };
        crown::sky(albedo, front, back, open, through)
    }

    /// Radiance of a body.
    pub(crate) fn body(&self, colour: Vec3, surface: Vec3, normal: Vec3, view: Vec3, lit: f32) -> Vec3 {
        let Some(around) = &self.surroundings else {
            return body::body(colour, surface, normal, view, &self.light, self.haze(), lit);
        };
        let mirror = body::mirror(normal, view);
        let seen = around.seen(body::level(mirror)).min(Vec3::splat(around.uniform.disc[3]));
        body::body_seeing(colour, surface, normal, view, &self.light, lit, body::reflected(mirror, surface.x, &self.light, seen))
    }
}
