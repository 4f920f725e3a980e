//! What a frame is made of beside its surfaces, a file for each feature.
//!
//! Every feature has these steps, under the same names, as far as it takes part in them:
//!
//! 1. `needs`: what a style asks for, before anything is planned.
//! 2. `plan`: its resources and passes, added to the frame's graph.
//! 3. `upload`, once, and `upload_view`, for every camera: what the host fills.
//! 4. `finish`: what goes over the finished picture.
//!
//! [`FrameRenderer`](crate::frame_renderer::FrameRenderer) runs the first three,
//! [`Renderer`](crate::renderer::Renderer) the last. Features know the frame's graph and not each other.

pub(crate) mod background_contrast;
pub(crate) mod beams;
pub(crate) mod blending;
pub(crate) mod compositing;
pub(crate) mod hull;
pub(crate) mod lettering;
pub(crate) mod line_features;
pub(crate) mod screen_lines;
pub(crate) mod shadows;
pub(crate) mod smoke;
pub(crate) mod speed_lines;
pub(crate) mod stroke_places;
pub(crate) mod strokes;
