//! What smokes.

/// What smokes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Source {
    /// A chimney on the floor that puffs, so that its column rises in billows.
    #[default]
    Plume,
    /// One puff from the floor, rising as a ring that rolls and thins out.
    Puff,
    /// A blast above the floor: a ball of fire that swells, then rises and rolls up.
    Explosion,
    /// A fair-weather cloud that is there from the start, boils and drifts.
    Cloud,
}

impl Source {
    /// All sources.
    pub const ALL: [Self; 4] = [Self::Plume, Self::Puff, Self::Explosion, Self::Cloud];

    /// The source's name, as in commands.
    pub fn name(self) -> &'static str {
        match self {
            Self::Plume => "plume",
            Self::Puff => "puff",
            Self::Explosion => "explosion",
            Self::Cloud => "cloud",
        }
    }

    /// The source of a name.
    pub fn of_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|source| source.name() == name)
    }

    /// The temperature that counts as hottest when it is drawn, for settings of a heat: about that of its heart.
    pub fn hottest(self, heat: f32) -> f32 {
        match self {
            Self::Plume | Self::Puff | Self::Explosion => heat,
            Self::Cloud => f32::MAX,
        }
    }

    /// Cells along x, y and z of a grid on which the source looks good within seconds.
    pub fn usual_size(self) -> [u32; 3] {
        match self {
            Self::Plume => [30, 30, 60],
            Self::Puff => [32, 32, 40],
            Self::Explosion => [40, 40, 40],
            Self::Cloud => [48, 30, 24],
        }
    }

    /// Number of a frame that shows what the source is, of `fps` frames a second.
    pub fn telling_frame(self, fps: f32) -> u32 {
        // Of 24 a second.
        let frame: u32 = match self {
            Self::Plume => 72,
            Self::Puff => 30,
            Self::Explosion => 16,
            Self::Cloud => 24,
        };
        let telling = f64::from(frame) / 24.0 * f64::from(fps);
        (telling.round() as u32).max(1)
    }

    /// Share of all motion that the air takes away per second.
    ///
    /// A blast is over at once and its smoke hangs; without, it shot out of any box.
    pub(super) fn drag(self) -> f32 {
        if self == Self::Explosion { 1.5 } else { 0.0 }
    }
}
