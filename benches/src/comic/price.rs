//! What ink and hatching cost beside plain tones [Suzuki 2004: 380 frames a second plain, 350 in comic style].

use npr_gpu::engine::Engine;
use npr_render::RenderError;
use npr_stylesheet::Style;

use crate::subject::Subject;
use crate::timing::{Times, elapsed_ms, worked_ms};

/// What a style takes.
#[derive(Debug, Clone, Copy)]
pub struct Price {
    /// Preparing memory, tiles and charts, once, in ms.
    pub prepare_ms: f64,
    /// A whole frame.
    pub frame: Times,
    /// Work of all threads in a frame; 0 where the system does not tell.
    pub work: Times,
    /// The last pass alone: ramps, ink, hatching, layers.
    pub compose: Times,
}

/// Prices of some styles of one subject, drawn by turns so that a busy machine slows all of them alike.
///
/// # Errors
///
/// [`RenderError`] where the engine fails.
pub fn prices(
    engine: &dyn Engine,
    subject: &Subject,
    styles: &[Style],
    size: [u32; 2],
    runs: usize,
) -> Result<Vec<Price>, RenderError> {
    // Prepare a renderer for every style.
    let mut renderers = Vec::with_capacity(styles.len());
    let mut prepare_ms = Vec::with_capacity(styles.len());
    for style in styles {
        let mut renderer = None;
        prepare_ms.push(elapsed_ms(|| {
            renderer = Some(subject.warm_renderer(engine, style, size));
        }));
        renderers.extend(renderer.transpose()?);
    }

    // Draw all styles by turns.
    let mut frames = vec![Vec::with_capacity(runs); renderers.len()];
    let (mut composes, mut works) = (frames.clone(), frames.clone());
    for _ in 0..runs {
        for (i, renderer) in renderers.iter_mut().enumerate() {
            let mut drawn = None;
            let before = worked_ms();
            frames[i].push(elapsed_ms(|| drawn = Some(renderer.draw(&subject.camera))));
            let worked = before.zip(worked_ms()).map(|(from, to)| to - from);
            works[i].push(worked.unwrap_or_default());
            let last = drawn
                .transpose()?
                .and_then(|frame| frame.times.last().map(|pass| pass.time));
            composes[i].push(last.unwrap_or_default().as_secs_f64() * 1e3);
        }
    }

    // Join the times of every style.
    let timed = prepare_ms.into_iter().zip(frames);
    let timed = timed.zip(works.into_iter().zip(composes));
    Ok(timed
        .map(|((prepare_ms, frames), (works, composes))| Price {
            prepare_ms,
            frame: Times::of(frames),
            work: Times::of(works),
            compose: Times::of(composes),
        })
        .collect())
}
