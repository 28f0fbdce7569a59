//! What one drives: a truck that slides when it is steered too hard, a walker, a helicopter.
//!
//! The truck is a bicycle model with tyres that give way: side forces grow with the slip angle and end at grip. Numbers are those of a pickup of 1.9 t.

use sward::scene::Shape;

use crate::camera::wrapped;

/// What somebody asks for, each -1 to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Asked {
    /// Ahead, or back.
    pub ahead: f64,
    /// To the right, or left.
    pub right: f64,
    /// Up, or down.
    pub up: f64,
    /// The hand brake.
    pub brake: bool,
}

/// A kind of vehicle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Vehicle {
    /// Wheels.
    Truck,
    /// Feet: goes where it looks, turns on the spot.
    Walker,
    /// Flies, and can climb.
    Helicopter,
}

impl Vehicle {
    /// What a body is driven as.
    pub fn of(shape: &Shape, clearance: f64) -> Self {
        match shape {
            _ if clearance > 1.5 => Self::Helicopter,
            Shape::Truck => Self::Truck,
            _ => Self::Walker,
        }
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Truck => "truck",
            Self::Walker => "walker",
            Self::Helicopter => "helicopter",
        }
    }
}

/// A body that is driven.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// Its number in the scene.
    pub body: usize,
    /// What it is driven as.
    pub vehicle: Vehicle,
    /// m.
    pub ground: [f64; 2],
    /// Heading, rad; forward is (sin, cos).
    pub yaw: f64,
    /// Height over the ground, m.
    pub clearance: f64,
    /// Along and across its heading, to the right, m/s.
    pub speed: [f64; 2],
    /// Turning to the right, rad/s.
    spin: f64,
    /// Angle of the front wheels, rad; to the right.
    pub steering: f64,
}

/// From the middle to the axles, m.
const AXLE: f64 = 1.6;
/// Side force of an axle for each radian of slip, over its load, m/s²: half the truck's.
const STIFF: f64 = 45.0;
/// Most that grass holds a tyre with, m/s².
const GRIP: f64 = 6.0;
/// Pull of the engine, m/s², and fastest, m/s.
const PULL: f64 = 4.5;
const FASTEST: f64 = 22.0;
/// Part of a step in which tyres are reckoned, s.
const SLICE: f64 = 1.0 / 480.0;

impl Drive {
    /// Takes a body over where it stands.
    pub fn new(body: usize, vehicle: Vehicle, (ground, yaw, clearance): ([f64; 2], f64, f64)) -> Self {
        Self { body, vehicle, ground, yaw, clearance, speed: [0.0; 2], spin: 0.0, steering: 0.0 }
    }

    /// Angle between where it points and where it goes, rad.
    pub fn drift(&self) -> f64 {
        if self.speed[0].hypot(self.speed[1]) < 0.5 { 0.0 } else { self.speed[1].atan2(self.speed[0].abs()) }
    }

    /// Goes on for `dt` seconds.
    pub fn go(&mut self, asked: &Asked, dt: f64) {
        match self.vehicle {
            Vehicle::Truck => {
                let slices = (dt / SLICE).ceil().max(1.0);
                (0..slices as u32).for_each(|_| self.roll(asked, dt / slices));
            }
            Vehicle::Walker => self.walk(asked, dt),
            Vehicle::Helicopter => self.fly(asked, dt),
        }
    }

    fn roll(&mut self, asked: &Asked, dt: f64) {
        let [ahead, side] = self.speed;
        // Less lock at speed, and hands that take a moment.
        let lock = 0.6 / (1.0 + 0.06 * ahead.abs());
        self.steering += (asked.right * lock - self.steering).clamp(-2.2 * dt, 2.2 * dt);
        let slow = ahead.abs().max(1.0);
        let hold = |slip: f64, grip: f64| (-STIFF * slip).clamp(-grip, grip) * 0.5;
        let rear_grip = if asked.brake { 0.35 * GRIP } else { GRIP };
        let front = hold(((side + self.spin * AXLE) / slow).atan() - self.steering * ahead.signum(), GRIP);
        let rear = hold(((side - self.spin * AXLE) / slow).atan(), rear_grip);
        let pull = match asked.ahead {
            pedal if pedal * ahead < 0.0 => pedal * 8.0,
            pedal => pedal * PULL * (1.0 - (ahead.abs() / FASTEST).min(1.0)) * if ahead < 0.0 { 0.5 } else { 1.0 },
        };
        let resist = if asked.brake { 5.0 } else { 0.35 + 0.012 * ahead * ahead };
        let coast = ahead.signum() * resist.min(ahead.abs() / dt);
        self.speed[0] += (pull - coast + side * self.spin) * dt;
        self.speed[1] += (front + rear - ahead * self.spin) * dt;
        self.spin += (front - rear) * AXLE / 2.2 * dt;
        if self.speed[0].abs() < 0.4 && asked.ahead == 0.0 {
            (self.speed[1], self.spin) = (self.speed[1] * (1.0 - 12.0 * dt), self.spin * (1.0 - 12.0 * dt));
        }
        self.yaw = wrapped(self.yaw - self.spin * dt);
        self.shift(dt);
    }

    fn walk(&mut self, asked: &Asked, dt: f64) {
        let wanted = asked.ahead * if asked.ahead < 0.0 { 0.8 } else { 1.6 };
        self.speed = [self.speed[0] + (wanted - self.speed[0]) * (1.0 - (-8.0 * dt).exp()), 0.0];
        self.spin += (asked.right * 2.2 - self.spin) * (1.0 - (-10.0 * dt).exp());
        self.yaw = wrapped(self.yaw - self.spin * dt);
        self.shift(dt);
    }

    fn fly(&mut self, asked: &Asked, dt: f64) {
        self.speed[0] += (asked.ahead * 14.0 - self.speed[0]) * (1.0 - (-0.9 * dt).exp());
        self.speed[1] *= (-0.9 * dt).exp();
        self.spin += (asked.right * 1.2 - self.spin) * (1.0 - (-2.5 * dt).exp());
        self.yaw = wrapped(self.yaw - self.spin * dt);
        self.clearance = (self.clearance + asked.up * 4.0 * dt).clamp(0.5, 60.0);
        self.shift(dt);
    }

    /// Moves by its speed; right of +z, its heading at yaw 0, is -x: y is up.
    fn shift(&mut self, dt: f64) {
        let (sine, cosine) = self.yaw.sin_cos();
        let [ahead, right] = self.speed;
        self.ground[0] += (sine * ahead - cosine * right) * dt;
        self.ground[1] += (cosine * ahead + sine * right) * dt;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn driven(asked: Asked, seconds: f64) -> Drive {
        let mut drive = Drive::new(0, Vehicle::Truck, ([0.0; 2], 0.0, 0.0));
        (0..(seconds * 60.0) as u32).for_each(|_| drive.go(&asked, 1.0 / 60.0));
        drive
    }

    #[test]
    fn a_truck_goes_ahead_and_stops() {
        let mut truck = driven(Asked { ahead: 1.0, ..Asked::default() }, 4.0);
        assert!(truck.speed[0] > 8.0 && truck.ground[1] > 15.0 && truck.ground[0].abs() < 1e-9, "{truck:?}");
        (0..240).for_each(|_| truck.go(&Asked { ahead: 0.0, brake: true, ..Asked::default() }, 1.0 / 60.0));
        assert!(truck.speed[0].abs() < 1e-3, "{truck:?}");
    }

    #[test]
    fn a_truck_turns_to_the_right_and_drifts_with_the_brake() {
        let straight = Asked { ahead: 1.0, ..Asked::default() };
        let mut truck = driven(straight, 3.0);
        (0..60).for_each(|_| truck.go(&Asked { right: 1.0, ahead: 0.3, ..Asked::default() }, 1.0 / 60.0));
        let gentle = truck.drift().abs();
        assert!(truck.yaw < -0.3 && truck.ground[0] < -0.1, "{truck:?}");
        let mut truck = driven(straight, 3.0);
        (0..60).for_each(|_| truck.go(&Asked { right: 1.0, brake: true, ..Asked::default() }, 1.0 / 60.0));
        assert!(truck.drift().abs() > 1.5 * gentle && truck.drift().abs() < 1.6, "{gentle} {truck:?}");
    }

    #[test]
    fn the_rate_of_steps_hardly_matters() {
        let asked = Asked { ahead: 1.0, right: 0.4, ..Asked::default() };
        let [mut fine, mut coarse] = [Drive::new(0, Vehicle::Truck, ([0.0; 2], 0.0, 0.0)); 2];
        (0..480).for_each(|_| fine.go(&asked, 1.0 / 120.0));
        (0..120).for_each(|_| coarse.go(&asked, 1.0 / 30.0));
        assert!((fine.ground[0] - coarse.ground[0]).hypot(fine.ground[1] - coarse.ground[1]) < 0.3, "{fine:?} {coarse:?}");
    }

    #[test]
    fn a_helicopter_climbs() {
        let mut drive = Drive::new(0, Vehicle::Helicopter, ([0.0; 2], 0.0, 5.0));
        (0..60).for_each(|_| drive.go(&Asked { up: 1.0, ..Asked::default() }, 1.0 / 60.0));
        assert!(drive.clearance > 8.0);
    }
}
