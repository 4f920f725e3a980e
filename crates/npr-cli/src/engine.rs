//! Which engine draws, and what happens when it fails.

use crate::arguments::Backend;
use crate::fault::{Exit, Fault};
use crate::hardware;
use npr_gpu::engine::{Engine, EngineError};
use npr_gpu::processor::Processor;
use npr_render::{Frame, RenderError};

/// Which graphics devices may draw.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Choice {
    /// Hardware only: software devices are slower than the processor engine.
    Hardware,
    /// Any, hardware first.
    Any,
}

/// A frame, and the engine that drew it.
#[derive(Debug)]
pub struct Drawn {
    /// The frame.
    pub frame: Frame,
    /// The engine in one line.
    pub engine: String,
}

/// Draws a picture on the engine that `backend` asks for.
///
/// A device that is lost is opened once more. Where it fails again, or fails otherwise, the processor
/// takes over if the choice is automatic, after a word to `warn`.
pub fn draw(
    backend: Backend,
    picture: &dyn Fn(&dyn Engine) -> Result<Frame, RenderError>,
    warn: &dyn Fn(&str),
) -> Result<Drawn, Fault> {
    let drawn = match backend {
        Backend::Cpu => draw_on(&Processor, picture),
        Backend::Gpu => draw_on_device(Choice::Any, picture),
        Backend::Auto => match draw_on_device(Choice::Hardware, picture) {
            Err(RenderError::Engine(EngineError::NoDevice { .. })) => draw_on(&Processor, picture),
            Err(RenderError::Engine(error)) => {
                warn(&format!("{error}; the processor draws instead"));
                draw_on(&Processor, picture)
            }
            done => done,
        },
    };
    drawn.map_err(Fault::from)
}

fn draw_on_device(
    choice: Choice,
    picture: &dyn Fn(&dyn Engine) -> Result<Frame, RenderError>,
) -> Result<Drawn, RenderError> {
    let draw = || draw_on(hardware::open(choice)?.as_ref(), picture);
    match draw() {
        Err(RenderError::Engine(EngineError::Lost { .. })) => draw(),
        done => done,
    }
}

fn draw_on(
    engine: &dyn Engine,
    picture: &dyn Fn(&dyn Engine) -> Result<Frame, RenderError>,
) -> Result<Drawn, RenderError> {
    Ok(Drawn {
        frame: picture(engine)?,
        engine: engine.describe(),
    })
}

impl From<RenderError> for Fault {
    fn from(error: RenderError) -> Self {
        match &error {
            RenderError::EmptyFrame { .. } => Self::new(Exit::Usage, error),
            RenderError::FrameTooLarge { .. } | RenderError::TooMany { .. } => {
                Self::new(Exit::Limit, format!("{error}, and no option lifts that"))
            }
            RenderError::Memory(_) => {
                Self::new(Exit::Limit, format!("{error}; --memory-limit lifts that"))
            }
            RenderError::Engine(EngineError::NoDevice { .. }) => Self::new(Exit::NoDevice, error),
            _ => Self::new(Exit::Failed, error),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    fn frame() -> Frame {
        Frame {
            size: [1, 1],
            rgba: vec![0; 4],
            times: Vec::new(),
        }
    }

    #[test]
    fn the_processor_is_tried_once() {
        let tries = Cell::new(0);
        let failing = |_: &dyn Engine| {
            tries.set(tries.get() + 1);
            Err(RenderError::Engine(EngineError::Lost {
                reason: "unplugged".to_owned(),
            }))
        };
        let fault = draw(Backend::Cpu, &failing, &|_| ()).expect_err("it fails");
        assert_eq!((fault.exit, tries.get()), (Exit::Failed, 1));
    }

    #[test]
    fn what_is_not_the_engines_fault_is_not_tried_elsewhere() {
        let warned = Cell::new(false);
        let empty = |_: &dyn Engine| {
            Err(RenderError::EmptyFrame {
                width: 0,
                height: 1,
            })
        };
        let fault = draw(Backend::Auto, &empty, &|_| warned.set(true)).expect_err("no pixels");
        assert_eq!(fault.exit, Exit::Usage);
        assert!(!warned.get());
    }

    #[test]
    fn auto_always_draws() {
        let drawn = draw(Backend::Auto, &|_| Ok(frame()), &|_| ()).expect("a frame");
        assert_eq!(drawn.frame, frame());
        assert!(!drawn.engine.is_empty());
    }
}
