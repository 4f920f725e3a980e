//! Graphics cards by their data sheets, and the times that these predict.

use npr_gpu::cost::Cost;

/// Microseconds that a card is busy with the start and the end of a dispatch or draw, before and after all of its work.
///
/// No data sheet states it. Measured kernels without work take about 3 (NVIDIA developer forum, thread 233645); a
/// barrier before the next one lets everything drain, so that 3 to 10 are usual. The 24 to 71 that calls of WebGPU take
/// a dispatch [Maczan 2026] are the processor's, which records a frame while the card draws the one before.
const LAUNCH_US: f64 = 5.0;

/// A graphics card.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Card {
    /// Its name, as drivers begin it.
    pub name: &'static str,
    /// Bytes per second between the card and its memory, in thousands of millions.
    pub gigabytes_per_s: f64,
    /// Microseconds that every dispatch or draw takes beside its bytes.
    pub launch_us: f64,
}

/// Cards from built-in to large: the first two are those of the published times of strokes, in [Jiang et al. 2022]
/// and [Kawaguchi 2024].
pub const CARDS: [Card; 5] = [
    Card::by_sheet("NVIDIA GeForce GTX 1070", 256.0),
    Card::by_sheet("NVIDIA GeForce RTX 2060", 336.0),
    Card::by_sheet("AMD Radeon RX 7600", 288.0),
    Card::by_sheet("Apple M1", 68.0),
    Card::by_sheet("NVIDIA GeForce RTX 4090", 1008.0),
];

/// The card that the goal of a frame in 2 ms names.
pub const GOAL: Card = Card::by_sheet("the goal's card", 300.0);

impl Card {
    /// A card with the bandwidth of its data sheet.
    const fn by_sheet(name: &'static str, gigabytes_per_s: f64) -> Self {
        Self {
            name,
            gigabytes_per_s,
            launch_us: LAUNCH_US,
        }
    }

    /// The same card with another time of launches.
    #[must_use]
    pub const fn launching_in(self, launch_us: f64) -> Self {
        Self { launch_us, ..self }
    }

    /// Milliseconds that a pass is predicted to take: its bytes at full bandwidth, and its launches.
    ///
    /// Arithmetic, the set-up of triangles and what is drawn over do not count, and neither does a cache that outlives
    /// a pass: the first three make frames slower, the last faster.
    pub fn predicted_ms(&self, cost: &Cost) -> f64 {
        cost.bytes() as f64 / (self.gigabytes_per_s * 1e6) + self.launches_ms(cost)
    }

    /// Milliseconds of launches alone.
    pub fn launches_ms(&self, cost: &Cost) -> f64 {
        cost.launches as f64 * self.launch_us / 1e3
    }

    /// Whether an engine runs on this card, by what it says of itself: the name, then the driver in brackets.
    pub fn is_described_by(&self, engine: &str) -> bool {
        engine
            .strip_prefix(self.name)
            .is_some_and(|rest| rest.starts_with(" ("))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pass of a gigabyte.
    const COST: Cost = Cost {
        launches: 4,
        workgroups: 1,
        invocations: 64,
        read_bytes: 600_000_000,
        written_bytes: 400_000_000,
        whole_bytes: 0,
        barriers: 1,
        workgroup_barriers: 0,
    };

    #[test]
    fn a_gigabyte_takes_its_share_of_a_second() {
        let card = Card::by_sheet("a card", 500.0).launching_in(10.0);
        assert!((card.predicted_ms(&COST) - 2.04).abs() < 1e-9);
        assert!((card.launches_ms(&COST) - 0.04).abs() < 1e-9);
        assert_eq!(card.predicted_ms(&Cost::default()), 0.0);
    }

    #[test]
    fn a_card_is_known_by_its_name() {
        let [_, rtx_2060, _, m1, _] = CARDS;
        assert!(rtx_2060.is_described_by("NVIDIA GeForce RTX 2060 (Vulkan, NVIDIA 550.1)"));
        assert!(!rtx_2060.is_described_by("NVIDIA GeForce RTX 2060 SUPER (Vulkan, NVIDIA 550.1)"));
        assert!(!rtx_2060.is_described_by("llvmpipe (Vulkan, llvmpipe)"));
        assert!(m1.is_described_by("Apple M1 (Metal, )"));
        assert!(!m1.is_described_by("Apple M1 Max (Metal, )"));
    }
}
