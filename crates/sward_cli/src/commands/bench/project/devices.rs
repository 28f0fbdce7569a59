//! The GPUs that costs are projected onto, by the numbers their makers publish.

use serde::Serialize;

/// What a GPU can do at most.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct Device {
    /// Name, and what kind it is.
    pub(crate) name: &'static str,
    /// Short, for the head of a column.
    pub(crate) short: &'static str,
    /// Numbers that it computes with at once.
    pub(crate) lanes: f64,
    /// Clock under load, GHz.
    pub(crate) clock_ghz: f64,
    /// Bytes that its memory moves, GB/s.
    pub(crate) bandwidth_gb_per_s: f64,
}

impl Device {
    /// Operations a second. A fused multiply and add counts as two in a maker's FLOPS, but as one here: what is counted is not known to fuse.
    pub(crate) fn rate(&self) -> f64 {
        self.lanes * self.clock()
    }

    /// Clocks a second.
    pub(crate) fn clock(&self) -> f64 {
        self.clock_ghz * 1e9
    }

    /// Bytes a second.
    pub(crate) fn bandwidth(&self) -> f64 {
        self.bandwidth_gb_per_s * 1e9
    }
}

/// An integrated one, a laptop's and a desktop's.
pub(crate) const DEVICES: [Device; 3] = [
    // Intel's data for the Core i7-1185G7: 96 execution units of 8 lanes, 1.35 GHz at most; two channels of 64 bits LPDDR4x-4267, which the
    // processor's cores share.
    Device { name: "Intel Iris Xe (96 EU, integrated)", short: "Iris Xe", lanes: 768.0, clock_ghz: 1.35, bandwidth_gb_per_s: 68.3 },
    // NVIDIA's comparison of GeForce laptops: 3072 CUDA cores, boost 1.47 to 2.37 GHz by the laptop's power, of which the least is taken; 128 bits
    // of GDDR6 at 16 Gbit/s.
    Device { name: "NVIDIA GeForce RTX 4060 Laptop", short: "4060 Laptop", lanes: 3072.0, clock_ghz: 1.47, bandwidth_gb_per_s: 256.0 },
    // NVIDIA's specification of the GeForce RTX 4070 Ti: 7680 CUDA cores, boost 2.61 GHz; 192 bits of GDDR6X at 21 Gbit/s.
    Device { name: "NVIDIA GeForce RTX 4070 Ti", short: "4070 Ti", lanes: 7680.0, clock_ghz: 2.61, bandwidth_gb_per_s: 504.0 },
];

#[cfg(test)]
mod tests {
    use super::*;

    /// The makers' FLOPS, two for each operation here.
    #[test]
    fn rates_are_those_that_are_published() {
        for (device, tera) in DEVICES.iter().zip([2.07, 9.03, 40.1]) {
            assert!((2.0 * device.rate() / 1e12 / tera - 1.0).abs() < 0.01, "{device:?}");
        }
        assert!(DEVICES.windows(2).all(|pair| pair[0].rate() < pair[1].rate() && pair[0].bandwidth() < pair[1].bandwidth()));
    }
}
