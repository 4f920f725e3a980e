//! The sides that scenes are usually looked at from.

/// A side that a scene is looked at from. Up is +y, and what faces the viewer of a scene faces +z, as in glTF.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StandardView {
    /// From +z.
    Front,
    /// From -z.
    Back,
    /// From -x.
    Left,
    /// From +x.
    Right,
    /// From above; the top of the picture is -z.
    Top,
    /// From below; the top of the picture is +z.
    Bottom,
    /// From (1, 1, 1), where all three axes are seen alike: isometric in parallel view.
    Iso,
}

impl StandardView {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Front,
        Self::Back,
        Self::Left,
        Self::Right,
        Self::Top,
        Self::Bottom,
        Self::Iso,
    ];

    /// Its name, as command lines have it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Front => "front",
            Self::Back => "back",
            Self::Left => "left",
            Self::Right => "right",
            Self::Top => "top",
            Self::Bottom => "bottom",
            Self::Iso => "iso",
        }
    }

    /// The one of a name.
    pub fn of(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|view| view.name() == name)
    }

    /// The direction from the scene towards the eye, and the one that is up in the picture, in the world; of any
    /// length.
    pub fn sides(self) -> ([f32; 3], [f32; 3]) {
        const UP: [f32; 3] = [0.0, 1.0, 0.0];
        match self {
            Self::Front => ([0.0, 0.0, 1.0], UP),
            Self::Back => ([0.0, 0.0, -1.0], UP),
            Self::Left => ([-1.0, 0.0, 0.0], UP),
            Self::Right => ([1.0, 0.0, 0.0], UP),
            Self::Top => ([0.0, 1.0, 0.0], [0.0, 0.0, -1.0]),
            Self::Bottom => ([0.0, -1.0, 0.0], [0.0, 0.0, 1.0]),
            Self::Iso => ([1.0, 1.0, 1.0], UP),
        }
    }
}
