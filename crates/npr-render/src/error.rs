//! Why a picture could not be made.

use npr_core::budget::OverBudget;
use npr_core::interrupt::Interrupted;
use npr_gpu::curves::CurvesError;
use npr_gpu::engine::EngineError;
use npr_vector::mesh_lines::draw::FindError;

/// Why a picture could not be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError {
    /// The frame has no pixels.
    #[error("a frame of {width}x{height} pixels is empty")]
    EmptyFrame {
        /// Width asked for.
        width: u32,
        /// Height asked for.
        height: u32,
    },
    /// The frame is larger than any picture may be.
    #[error("a frame of {width}x{height} pixels is larger than {limit} a side")]
    FrameTooLarge {
        /// Width asked for.
        width: u32,
        /// Height asked for.
        height: u32,
        /// Most pixels a side.
        limit: u32,
    },
    /// More triangles or vertices than can be numbered.
    #[error("the scene has more than {limit} {what}")]
    TooMany {
        /// What there is too much of.
        what: &'static str,
        /// The most there may be.
        limit: u64,
    },
    /// The plan needs more memory than allowed.
    #[error(transparent)]
    Memory(#[from] OverBudget),
    /// Lines could not be closed to regions.
    #[error(transparent)]
    Fill(#[from] npr_drawing::fill::FillError),
    /// The linked sides of pixels could not be ranked.
    #[error("line.potrace: {0}")]
    Rank(#[from] npr_vector::rank::RankError),
    /// Lines could not be looked for in a picture.
    #[error(transparent)]
    Bitmap(#[from] npr_trace::BitmapError),
    /// Words of the style cannot be set.
    #[error("lettering.{index}: {source}")]
    Lettering {
        /// Which of the style's words, counted from 0.
        index: usize,
        /// Why not.
        source: npr_drawing::lettering::LetteringError,
    },
    /// A picture that the style names was not given.
    #[error("{key}: the picture '{name}' was not given")]
    MissingPicture {
        /// The key that names it.
        key: String,
        /// Its name there.
        name: String,
    },
    /// A picture that the style names has no pixels, or not as many as its size says.
    #[error("{key}: the picture has no pixels, or not as many as its size says")]
    EmptyPicture {
        /// The key that names it.
        key: String,
    },
    /// What cannot be recorded into a frame of another program.
    #[error("{what} cannot be drawn inside the frame of another program")]
    NotRecorded {
        /// What it is: a key of the style, or the size.
        what: String,
    },
    /// The camera and the matrix of a host program do not belong together.
    #[error("the camera and the matrix of the program show the scene {px} pixels apart")]
    OtherView {
        /// How far apart they show a corner of the scene.
        px: f32,
    },
    /// A pose is of another scene than the model.
    #[error("the scene has {have} matrices of nodes and joints, but the model was made of {want}")]
    OtherScene {
        /// How many matrices the pose has.
        have: usize,
        /// How many the model has.
        want: usize,
    },
    /// A pose is of a scene with other meshes than the line model.
    #[error("the scene has {have} vertices, but the model was made of {want}")]
    OtherMeshes {
        /// How many vertices the pose has, counted for every instance.
        have: usize,
        /// How many the model has.
        want: usize,
    },
    /// The style names a look that does not exist.
    #[error(transparent)]
    Style(#[from] npr_stylesheet::StyleError),
    /// A picture cannot be a ramp.
    #[error("{key}: {source}")]
    Ramp {
        /// The key that names it.
        key: String,
        /// Why not.
        source: npr_style::tone_row::RowError,
    },
    /// A picture cannot serve as a hatch tile.
    #[error("{key}: {source}")]
    Hatch {
        /// The key that names it.
        key: String,
        /// Why not.
        source: npr_style::hatch::HatchError,
    },
    /// A picture cannot serve as the image of a brush.
    #[error("{key}: {source}")]
    Brush {
        /// The key that names it.
        key: String,
        /// Why not.
        source: npr_style::brush::BrushError,
    },
    /// The engine failed.
    #[error(transparent)]
    Engine(#[from] EngineError),
}

impl RenderError {
    /// Whether somebody ended the work before it was done ([`RendererOptions::interrupt`]).
    ///
    /// [`RendererOptions::interrupt`]: crate::RendererOptions::interrupt
    pub fn is_interrupted(&self) -> bool {
        matches!(self, Self::Engine(EngineError::Interrupted(_)))
    }
}

impl From<Interrupted> for RenderError {
    fn from(interrupted: Interrupted) -> Self {
        Self::Engine(interrupted.into())
    }
}

impl From<FindError> for RenderError {
    fn from(error: FindError) -> Self {
        match error {
            FindError::Memory(error) => error.into(),
            FindError::Interrupted(error) => error.into(),
        }
    }
}

impl From<CurvesError> for RenderError {
    fn from(error: CurvesError) -> Self {
        match error.split() {
            Ok(lists) => Self::Rank(lists),
            Err(engine) => Self::Engine(engine),
        }
    }
}

/// Most elements of a list: their numbers leave room for "none" and for the bit that marks hulls.
const COUNT_LIMIT: u64 = 1 << 30;

/// Fails if `have` elements and `more` of them together exceed [`COUNT_LIMIT`].
pub(crate) fn check_count(what: &'static str, have: usize, more: usize) -> Result<(), RenderError> {
    if have as u64 + more as u64 > COUNT_LIMIT {
        return Err(RenderError::TooMany {
            what,
            limit: COUNT_LIMIT,
        });
    }
    Ok(())
}
