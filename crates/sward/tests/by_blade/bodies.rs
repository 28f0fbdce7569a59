//! Bodies push blades out of themselves; blades swing back and are handed back.

use crate::field::{deepest, held, meadow};

const WIND: &str = "Natural(velocity: (4, 1), turbulence: 0.25)";
const WALKER: &str = "(name: \"walker\", shape: Ellipsoid(radii: (0.25, 0.9, 0.2)), path: Circle(centre: (0, 2), radius: 3, speed: 1.4))";
const CAR: &str = "(name: \"car\", shape: Truck, path: Keyframes(keys: [(time: 0, at: (0, -30)), (time: 10, at: (0, 50))]))";

#[test]
fn scratch() {
    for (name, body, response) in [("walker", WALKER, "VirtualInertia()"), ("car", CAR, "VirtualInertia()"), ("car", CAR, "Chain()")] {
        let mut world = meadow(response, WIND, body);
        for step in 0..480 {
            let plan = world.plan();
            let summaries = world.respond(&plan);
            world.finish(summaries);
            let [inside, below] = deepest(&world, &plan);
            if step % 20 == 19 || inside > 0.005 {
                println!("{name} {step}: held {} inside {:.2} mm below {:.2} mm, patches {} slots {}", held(&world).len(), 1e3 * inside, 1e3 * below,
                    plan.stands[0].patches.len(), plan.stands[0].patches.iter().filter(|p| p.lag != sward::state::NONE).count());
            }
        }
    }
}
