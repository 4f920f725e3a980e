//! The choice of the engine that draws, and what happens when it fails.

use crate::arguments::{Backend, DrawingArguments};
use crate::device_choice::DeviceChoice;
use crate::fault::{Exit, Fault};
use crate::hardware;
use crate::message;
use crate::progress::Progress;
use crate::timings::DRAW;
use npr_gpu::engine::{Engine, EngineError};
use npr_gpu::processor::Processor;
use npr_render::RenderError;
use std::cell::{Cell, RefCell};
use std::panic::resume_unwind;
use std::thread::{self, JoinHandle};

/// A frame or its lines, and the engine that drew it.
#[derive(Debug)]
pub struct Drawn<T> {
    /// What was drawn.
    pub picture: T,
    /// Description of the engine, in one line.
    pub engine: String,
}

/// A function that draws a picture on an engine.
type Picture<'a, T> = &'a dyn Fn(&dyn Engine) -> Result<T, RenderError>;

/// A function that opens a graphics device.
type Open<'a> = &'a dyn Fn() -> Result<Box<dyn Engine>, EngineError>;

/// An opened device, or the reason why there is none.
type Opened = Result<Box<dyn Engine + Send>, EngineError>;

/// The engine that the user asked for. A device is opened on a thread of its own beside other work, because drivers
/// take some tens of milliseconds.
pub struct EngineChoice<'a> {
    arguments: &'a DrawingArguments,
    /// The thread that opens a device. The first caller that needs a device takes it.
    opening: Cell<Option<JoinHandle<Opened>>>,
}

impl<'a> EngineChoice<'a> {
    /// Starts to open a device, where `arguments` ask for one.
    pub fn begin(arguments: &'a DrawingArguments) -> Self {
        let choice = Self {
            arguments,
            opening: Cell::new(None),
        };
        if let Some(devices) = choice.devices() {
            let times_passes = choice.times_passes();
            let open = move || hardware::open(devices, times_passes);
            // Where no thread can be started, the device is opened when it is needed.
            choice.opening.set(thread::Builder::new().spawn(open).ok());
        }
        choice
    }

    /// The devices that may draw; `None` where the processor draws.
    fn devices(&self) -> Option<DeviceChoice> {
        match self.arguments.backend {
            Backend::Cpu => None,
            Backend::Gpu => Some(DeviceChoice::Any),
            Backend::Auto => Some(DeviceChoice::Hardware),
        }
    }

    fn times_passes(&self) -> bool {
        self.arguments.timings.is_some()
    }

    /// The device that [`Self::begin`] started to open. Every later call opens a new one.
    fn open(&self, devices: DeviceChoice) -> Result<Box<dyn Engine>, EngineError> {
        let opened = match self.opening.take() {
            Some(opening) => joined(opening),
            None => hardware::open(devices, self.times_passes()),
        };
        opened.map(|device| device as Box<dyn Engine>)
    }

    /// Draws a picture on the engine.
    ///
    /// A lost device is opened once more. Where it fails again, or for another reason, the processor draws instead if
    /// the backend is `auto`; `warn` then gets a message, unless there is no device at all.
    fn draw<T>(&self, picture: Picture<'_, T>, warn: &dyn Fn(&str)) -> Result<Drawn<T>, Fault> {
        let drawn = match self.devices() {
            None => draw_on(&Processor, picture),
            Some(devices) => {
                let open = || self.open(devices);
                match devices {
                    DeviceChoice::Any => draw_on_device(&open, picture),
                    DeviceChoice::Hardware => draw_somewhere(&open, picture, warn),
                }
            }
        };
        drawn.map_err(Fault::from)
    }

    /// Draws a picture as a step of the run. Warnings are printed when the step is over.
    pub fn draw_as_step<T>(
        &self,
        picture: Picture<'_, T>,
        progress: &mut Progress,
    ) -> Result<Drawn<T>, Fault> {
        let warnings = RefCell::new(Vec::new());
        let drawn = progress.step(DRAW, || {
            self.draw(picture, &|text| {
                warnings.borrow_mut().push(text.to_owned());
            })
        });
        for text in warnings.into_inner() {
            progress.suspend(|| message::warn(self.arguments.quiet, &text));
        }
        drawn
    }
}

impl Drop for EngineChoice<'_> {
    /// Waits for a device that nobody used: a program must not end while a driver starts.
    fn drop(&mut self) {
        drop(self.opening.take().map(JoinHandle::join));
    }
}

/// The result of a thread that opens a device. A panic of the thread is passed on.
fn joined(opening: JoinHandle<Opened>) -> Opened {
    opening.join().unwrap_or_else(|panic| resume_unwind(panic))
}

/// Draws a picture on a device, or on the processor where that fails. `warn` gets a message where there is a device
/// that fails.
pub fn draw_somewhere<T>(
    open: Open<'_>,
    picture: Picture<'_, T>,
    warn: &dyn Fn(&str),
) -> Result<Drawn<T>, RenderError> {
    match draw_on_device(open, picture) {
        Err(RenderError::Engine(EngineError::NoDevice { .. })) => draw_on(&Processor, picture),
        Err(RenderError::Engine(error)) => {
            warn(&format!("{error}; the processor draws instead"));
            draw_on(&Processor, picture)
        }
        done => done,
    }
}

/// Draws a picture on a device. A lost device is opened once more.
pub fn draw_on_device<T>(open: Open<'_>, picture: Picture<'_, T>) -> Result<Drawn<T>, RenderError> {
    let draw = || draw_on(open()?.as_ref(), picture);
    match draw() {
        Err(RenderError::Engine(EngineError::Lost { .. })) => draw(),
        done => done,
    }
}

fn draw_on<T>(engine: &dyn Engine, picture: Picture<'_, T>) -> Result<Drawn<T>, RenderError> {
    Ok(Drawn {
        picture: picture(engine)?,
        engine: engine.describe(),
    })
}

impl From<RenderError> for Fault {
    fn from(error: RenderError) -> Self {
        match &error {
            RenderError::EmptyFrame { .. } => Self::new(Exit::Usage, error),
            RenderError::Lettering { .. }
            | RenderError::Ramp { .. }
            | RenderError::Hatch { .. }
            | RenderError::Brush { .. } => Self::new(Exit::Input, error),
            RenderError::FrameTooLarge { .. } | RenderError::TooMany { .. } => {
                Self::new(Exit::Limit, format!("{error}, and no option lifts that"))
            }
            RenderError::Memory(_) => {
                Self::new(Exit::Limit, format!("{error}; --memory-limit lifts that"))
            }
            RenderError::Engine(_) => Self::new(Exit::NoDevice, error),
            _ => Self::new(Exit::Failed, error),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_gpu::engine::Session;
    use npr_gpu::graph::Graph;

    fn lost() -> RenderError {
        RenderError::Engine(EngineError::Lost {
            reason: "unplugged".to_owned(),
        })
    }

    /// A picture that fails with `error` the first `times` times. `tries` counts the attempts.
    fn failing<'a>(
        times: u32,
        tries: &'a Cell<u32>,
        error: &'a dyn Fn() -> RenderError,
    ) -> impl Fn(&dyn Engine) -> Result<(), RenderError> + 'a {
        move |_| {
            tries.set(tries.get() + 1);
            if tries.get() <= times {
                Err(error())
            } else {
                Ok(())
            }
        }
    }

    fn device() -> Result<Box<dyn Engine>, EngineError> {
        Ok(Box::new(Processor))
    }

    #[test]
    fn a_lost_device_is_opened_once_more() {
        for (losses, ends_well) in [(0, true), (1, true), (2, false)] {
            let tries = Cell::new(0);
            let drawn = draw_on_device(&device, &failing(losses, &tries, &lost));
            assert_eq!((drawn.is_ok(), tries.get()), (ends_well, losses.min(1) + 1));
        }
    }

    #[test]
    fn the_processor_takes_over_after_a_word() {
        let (tries, words) = (Cell::new(0), RefCell::new(Vec::new()));
        let warn = |text: &str| words.borrow_mut().push(text.to_owned());
        draw_somewhere(&device, &failing(2, &tries, &lost), &warn).expect("the processor draws");
        assert_eq!(tries.get(), 3);
        let args = ["the graphics device was lost: unplugged; the processor draws instead"];
        assert_eq!(words.into_inner(), args);
    }

    #[test]
    fn a_machine_without_a_device_draws_without_a_word() {
        let none = || {
            Err(EngineError::NoDevice {
                reason: "no driver".to_owned(),
            })
        };
        let silent = |text: &str| panic!("{text}");
        draw_somewhere(&none, &|_| Ok(()), &silent).expect("the processor draws");
        let fault = Fault::from(draw_on_device(&none, &|_| Ok(())).expect_err("no device"));
        assert_eq!(fault.exit, Exit::NoDevice);
    }

    #[test]
    fn a_device_that_fails_is_as_good_as_none() {
        let errors = [
            EngineError::NoDevice {
                reason: "old card lacks compute shaders".to_owned(),
            },
            EngineError::Lost {
                reason: "unplugged".to_owned(),
            },
            EngineError::Failed {
                place: "shade.compose_frame".to_owned(),
                reason: "the shader does not compile".to_owned(),
            },
            EngineError::OutOfMemory {
                resource: "frame",
                bytes: 1 << 40,
            },
        ];
        for error in errors {
            // With `--backend gpu` the failure ends the run with one sentence.
            let fails = || RenderError::Engine(error.clone());
            let tries = Cell::new(0);
            let demanded = draw_on_device(&device, &failing(9, &tries, &fails));
            let fault = Fault::from(demanded.expect_err("the device fails"));
            assert_eq!(fault.exit, Exit::NoDevice, "{error}");
            assert!(
                fault.message.starts_with("the graphics device")
                    || fault.message.starts_with("no graphics device")
            );
            assert_eq!(fault.message.lines().count(), 1);

            // With `--backend auto` the processor draws.
            let on_processor = |engine: &dyn Engine| match engine.runs_twins() {
                true => Ok("drawn"),
                false => Err(fails()),
            };
            let open = || Ok(Box::new(Unfit) as Box<dyn Engine>);
            let drawn = draw_somewhere(&open, &on_processor, &|_| ()).expect("the processor draws");
            assert_eq!(drawn.picture, "drawn", "{error}");
        }
    }

    /// A device on which every picture fails.
    struct Unfit;

    impl Engine for Unfit {
        fn describe(&self) -> String {
            "unfit".to_owned()
        }

        fn prepare(&self, _: Graph) -> Result<Box<dyn Session>, EngineError> {
            unreachable!("the picture fails before")
        }
    }

    /// A device that is lost when it is asked to compile.
    #[cfg(feature = "gpu")]
    struct Dying(npr_gpu::device::Device);

    #[cfg(feature = "gpu")]
    impl Engine for Dying {
        fn describe(&self) -> String {
            self.0.describe()
        }

        fn prepare(&self, graph: Graph) -> Result<Box<dyn Session>, EngineError> {
            self.0.destroy();
            self.0.prepare(graph)
        }
    }

    #[cfg(feature = "gpu")]
    #[test]
    fn a_device_that_is_lost_while_it_compiles_leaves_the_picture_to_the_processor() {
        use npr_render::{Model, Renderer, RendererOptions};
        let open = || match npr_gpu::device::testing::open() {
            Some(device) => Ok(Box::new(Dying(device)) as Box<dyn Engine>),
            None => Err(EngineError::NoDevice {
                reason: "no driver".to_owned(),
            }),
        };
        let model = Model::new(&npr_scene::Scene::default()).expect("a model");
        let picture = |engine: &dyn Engine| {
            let style = npr_stylesheet::Style::default();
            let options = RendererOptions::new([32, 18]);
            let mut renderer = Renderer::new(engine, &model, &style, &options)?;
            renderer.draw(&model.framing(16.0 / 9.0, 0.7))
        };
        let fault = Fault::from(draw_on_device(&open, &picture).expect_err("it is lost"));
        assert_eq!(fault.exit, Exit::NoDevice, "{}", fault.message);
        assert!(!fault.message.contains('\n'), "{}", fault.message);
        let drawn = draw_somewhere(&open, &picture, &|_| ()).expect("the processor draws");
        let expected = picture(&Processor).expect("drawn");
        assert_eq!(drawn.picture.rgba, expected.rgba);
        assert_eq!(drawn.engine, Processor.describe());
    }

    #[test]
    fn what_is_not_the_engines_fault_is_not_tried_again() {
        let empty = || RenderError::EmptyFrame {
            width: 0,
            height: 1,
        };
        let tries = Cell::new(0);
        let silent = |text: &str| panic!("{text}");
        let drawn = draw_somewhere(&device, &failing(9, &tries, &empty), &silent);
        assert_eq!(
            drawn.map_err(|error| Fault::from(error).exit).err(),
            Some(Exit::Usage)
        );
        assert_eq!(tries.get(), 1);
    }
}
