//! Sequences of frames: a device draws one while the caller has the one before.

use crate::error::RenderError;
use crate::frame::Frame;
use crate::renderer::{Begun, Renderer};
use crate::smoke::Smoke;
use npr_core::camera::Camera;
use std::collections::VecDeque;

/// What a frame of a sequence shows.
#[derive(Debug, Clone, PartialEq)]
pub struct Shot {
    /// The eye that sees it.
    pub camera: Camera,
    /// The smoke from this frame on, as [`Renderer::set_smoke`] takes it; `None` goes on with the one before.
    pub smoke: Option<Smoke>,
    /// Whether it is passed over: its strokes are found, for those of the next shot to hold to, and it gives no frame.
    pub passed: bool,
}

impl From<Camera> for Shot {
    fn from(camera: Camera) -> Self {
        Self {
            camera,
            smoke: None,
            passed: false,
        }
    }
}

impl<'a> Renderer<'a> {
    /// Draws a sequence, a frame for every shot that is not passed, in their order: the same frames as
    /// [`Self::set_smoke`] and [`Self::draw`] give one after the other.
    ///
    /// A device works on a frame while the caller does something with the one before: two frames are under way at
    /// once. The processor waits for no more than what is left of a frame, and the device not at all where the caller
    /// is the faster. A frame begins when the one before it is asked for. Frames in tiles are drawn one by one, two of
    /// their tiles at once.
    ///
    /// The first error ends the sequence: that of a shot comes after the frames of the shots before it, the loss of a
    /// device in place of the first frame that is lost. Whoever drops the iterator has seen enough: frames under way
    /// are forgotten, and the smoke stays that of the last shot that was asked for.
    ///
    /// A second frame under way costs memory for the results that are read: 4 bytes a pixel of the frame.
    ///
    /// ```
    /// # use npr_core::camera::Camera;
    /// # use npr_gpu::processor::Processor;
    /// # use npr_render::{Model, Renderer, RendererOptions};
    /// # let model = Model::new(&npr_scene::Scene::default())?;
    /// # let style = npr_stylesheet::Style::default();
    /// # let options = RendererOptions::new([64, 36]);
    /// let mut renderer = Renderer::new(&Processor, &model, &style, &options)?;
    /// let turntable = (0..3).map(|step| {
    ///     let angle = step as f32 * std::f32::consts::TAU / 3.0;
    ///     let eye = [4.0 * angle.sin(), 1.0, 4.0 * angle.cos()];
    ///     Camera { eye, ..Camera::framing([-1.0; 3], [1.0; 3]) }
    /// });
    /// for frame in renderer.frames(turntable) {
    ///     let frame = frame?;
    ///     // The device draws the next one while this one is written.
    ///     assert_eq!(frame.size, [64, 36]);
    /// }
    /// # Ok::<(), npr_render::RenderError>(())
    /// ```
    pub fn frames<I>(&mut self, shots: I) -> Frames<'_, 'a, I::IntoIter>
    where
        I: IntoIterator<Item: Into<Shot>>,
    {
        self.forget_begun();
        Frames::new(self, shots.into_iter())
    }

    /// Starts to draw a shot, or passes it over.
    fn begin_shot(&mut self, shot: &Shot) -> Result<Option<Begun>, RenderError> {
        if let Some(smoke) = &shot.smoke {
            self.set_smoke(smoke)?;
        }
        match shot.passed {
            true => self.pass(&shot.camera).map(|()| None),
            false => self.begin(&shot.camera).map(Some),
        }
    }
}

/// The frames of a sequence, in order: what [`Renderer::frames`] gives.
#[must_use = "frames are drawn as they are asked for"]
pub struct Frames<'r, 'a, I> {
    renderer: &'r mut Renderer<'a>,
    /// None once it has ended, or a frame failed.
    shots: Option<I>,
    /// The frames that are being drawn, the first one in front.
    begun: VecDeque<Begun>,
    /// Why the next frame could not be begun.
    failure: Option<RenderError>,
}

impl<'r, 'a, I> Frames<'r, 'a, I>
where
    I: Iterator<Item: Into<Shot>>,
{
    fn new(renderer: &'r mut Renderer<'a>, shots: I) -> Self {
        Self {
            renderer,
            shots: Some(shots),
            begun: VecDeque::new(),
            failure: None,
        }
    }

    /// Starts to draw frames until no more may be under way, there are no more, or one fails.
    fn begin_next(&mut self) {
        while self.begun.len() < self.renderer.most_begun() {
            let shot = self.shots.as_mut().and_then(Iterator::next);
            let begun = shot.map(|shot| self.renderer.begin_shot(&shot.into()));
            match begun {
                Some(Ok(begun)) => self.begun.extend(begun),
                ended => {
                    self.shots = None;
                    self.failure = ended.and_then(Result::err).or(self.failure.take());
                    break;
                }
            }
        }
    }
}

impl<I> Iterator for Frames<'_, '_, I>
where
    I: Iterator<Item: Into<Shot>>,
{
    type Item = Result<Frame, RenderError>;

    fn next(&mut self) -> Option<Self::Item> {
        // Start the next frame before the first is waited for.
        self.begin_next();
        let Some(first) = self.begun.pop_front() else {
            return self.failure.take().map(Err);
        };
        let frame = self.renderer.finish(first);

        // What fails ends the sequence.
        if frame.is_err() {
            self.shots = None;
            self.begun.clear();
            self.failure = None;
        }
        Some(frame)
    }
}
