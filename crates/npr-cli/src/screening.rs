//! Films while they are drawn: frames are encoded and written on a thread of its own, beside the drawing.

use crate::engine::Drawn;
use crate::fault::{Exit, Fault};
use crate::message;
use crate::progress::{Counter, Progress};
use crate::reel::{Reel, Shown};
use crate::timings::DRAW;
use npr_gpu::engine::PassTime;
use npr_render::{Frame, RenderError, Renderer, Shot};
use std::cell::{Cell, RefCell};
use std::collections::BTreeSet;
use std::panic::resume_unwind;
use std::sync::mpsc::{SyncSender, sync_channel};
use std::thread;

/// Most frames that wait to be encoded. Drawing stops while as many wait, so that memory does not grow with the film.
const WAITING: usize = 2;

/// A frame that was drawn, with what there is to tell of it.
pub struct Take {
    /// The frame.
    pub shown: Shown,
    /// What was drawn in another way than the style asks.
    pub notices: Vec<String>,
    /// The times of the passes that drew it.
    pub times: Vec<PassTime>,
}

impl From<Frame> for Take {
    fn from(mut frame: Frame) -> Self {
        Self {
            notices: std::mem::take(&mut frame.notices),
            times: std::mem::take(&mut frame.times),
            shown: Shown::Pixels(frame),
        }
    }
}

/// A frame of a film on the way through it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Step {
    /// Its number.
    pub number: u32,
    /// Whether its strokes are found, for those of later frames to hold to, and it is not drawn.
    pub passed: bool,
}

/// The way through a film whose frames of these rising numbers are drawn, but for the first `done`: the others are
/// passed where strokes hold from frame to frame, from frame 0 on, and left out elsewhere.
pub fn steps(numbers: &[u32], done: usize, holds: bool) -> impl Iterator<Item = Step> {
    let wanted = &numbers[done.min(numbers.len())..];
    let first = match holds {
        true => Some(0),
        false => wanted.first().copied(),
    };
    let all = first.zip(wanted.last().copied());
    let all = all.into_iter().flat_map(|(first, last)| first..=last);
    all.filter_map(move |number| {
        let passed = wanted.binary_search(&number).is_err();
        (holds || !passed).then_some(Step { number, passed })
    })
}

/// Why a frame could not be drawn.
pub enum Unfit {
    /// A fault of the engine, or of what it was asked for: another engine may try.
    Engine(RenderError),
    /// Another one, which ends the run.
    Other(Fault),
}

impl From<RenderError> for Unfit {
    fn from(error: RenderError) -> Self {
        Self::Engine(error)
    }
}

impl From<Fault> for Unfit {
    fn from(fault: Fault) -> Self {
        Self::Other(fault)
    }
}

/// The state of a film while its frames are drawn.
pub struct Screening {
    /// Where frames are handed over.
    hand: SyncSender<Shown>,
    counter: Counter,
    /// Number of frames that are handed over, and of all.
    done: Cell<usize>,
    count: usize,
    /// Notices about what was drawn in another way than the style asks, each once.
    notices: RefCell<BTreeSet<String>>,
    times: RefCell<Vec<PassTime>>,
    /// Why no more frames can be drawn, where it is not the engine's fault.
    failed: RefCell<Option<Fault>>,
}

impl Screening {
    /// How many frames are handed over. An engine that takes over from another one goes on with the next.
    pub fn done(&self) -> usize {
        self.done.get()
    }

    /// Draws every frame that is not handed over yet, of a film that has one for each of `shots` that is not passed.
    /// Those that are handed over are left out, or passed where `holds`. Ends early where one cannot be written.
    pub fn show_all(
        &self,
        mut renderer: Renderer<'_>,
        shots: impl Iterator<Item = Shot>,
        holds: bool,
    ) -> Result<(), RenderError> {
        let mut done = self.done();
        let left = shots.filter_map(move |shot| match done > 0 && !shot.passed {
            true => {
                done -= 1;
                holds.then_some(Shot {
                    passed: true,
                    ..shot
                })
            }
            false => Some(shot),
        });
        for frame in renderer.frames(left) {
            if !self.show(frame?.into()) {
                break;
            }
        }
        Ok(())
    }

    /// The same of frames that `draw` draws one after the other; of those that are passed it gives nothing.
    pub fn show_each(
        &self,
        steps: impl Iterator<Item = Step>,
        mut draw: impl FnMut(Step) -> Result<Option<Take>, Unfit>,
    ) -> Result<(), RenderError> {
        for step in steps {
            let is_taken = match draw(step) {
                Ok(Some(take)) => self.show(take),
                Ok(None) => true,
                Err(Unfit::Engine(error)) => return Err(error),
                Err(Unfit::Other(fault)) => {
                    *self.failed.borrow_mut() = Some(fault);
                    false
                }
            };
            if !is_taken {
                break;
            }
        }
        Ok(())
    }

    /// Hands over the next frame, and returns whether frames are still taken.
    fn show(&self, take: Take) -> bool {
        self.notices.borrow_mut().extend(take.notices);
        self.add_times(&take.times);
        let is_taken = self.hand.send(take.shown).is_ok();
        self.done.set(self.done() + 1);
        let goes_on = self.counter.tell_pace(DRAW, self.done(), self.count);
        if !goes_on {
            let fault = Fault::new(Exit::Failed, "the film is cancelled");
            *self.failed.borrow_mut() = Some(fault);
        }
        is_taken && goes_on
    }

    fn add_times(&self, more: &[PassTime]) {
        let mut times = self.times.borrow_mut();
        if times.len() != more.len() {
            *times = more.to_vec();
            return;
        }
        for (sum, more) in times.iter_mut().zip(more) {
            sum.time += more.time;
        }
    }
}

/// Draws a film by `draw`, which hands its frames to the screening, and writes them as `reel` says; gives the times of
/// the passes, added up. Tells notices unless `quiet`.
pub fn screened(
    reel: Reel<'_>,
    quiet: bool,
    progress: &mut Progress,
    draw: impl FnOnce(&Screening, &mut Progress) -> Result<Drawn<()>, Fault>,
) -> Result<Drawn<Vec<PassTime>>, Fault> {
    let (hand, taken) = sync_channel(WAITING);
    let screening = Screening {
        hand,
        counter: progress.counter(),
        done: Cell::new(0),
        count: reel.count(),
        notices: RefCell::default(),
        times: RefCell::default(),
        failed: RefCell::default(),
    };
    thread::scope(|scope| {
        // Write frames on a thread that does nothing else, while they are drawn on this one.
        let write = move || reel.write(&mut taken.into_iter());
        let writing = thread::Builder::new().spawn_scoped(scope, write)?;
        let drawn = draw(&screening, progress);
        let Screening {
            hand,
            notices,
            times,
            failed,
            ..
        } = screening;

        // Wait for the last ones. What went wrong with drawing comes first.
        drop(hand);
        let written = progress.step("write", || {
            writing.join().unwrap_or_else(|panic| resume_unwind(panic))
        });
        let engine = drawn?.engine;
        failed.into_inner().map_or(written, Err)?;
        progress.suspend(|| message::warn_all(quiet, notices.into_inner()));
        Ok(Drawn {
            picture: times.into_inner(),
            engine,
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reel::{Encoding, Stills};
    use crate::render;
    use crate::target::Target;
    use npr_core::camera::Camera;
    use npr_gpu::engine::{Engine, EngineError, Readings, Session};
    use npr_gpu::graph::{Graph, ResourceId};
    use npr_gpu::processor::Processor;
    use npr_render::{RendererOptions, Smoke, Sphere};
    use npr_stylesheet::Style;
    use std::rc::Rc;

    /// A device that is lost after some submissions, with all that it has in flight.
    struct Dying(Rc<Cell<usize>>);

    struct DyingSession(Box<dyn Session>, Rc<Cell<usize>>);

    impl Dying {
        fn after(submits: usize) -> Box<dyn Engine> {
            Box::new(Self(Rc::new(Cell::new(submits))))
        }
    }

    impl Engine for Dying {
        fn describe(&self) -> String {
            "dying".to_owned()
        }

        fn prepare(&self, graph: Graph) -> Result<Box<dyn Session>, EngineError> {
            let session = Processor.prepare(graph)?;
            Ok(Box::new(DyingSession(session, self.0.clone())))
        }
    }

    impl DyingSession {
        fn check(&self) -> Result<(), EngineError> {
            match self.1.get() {
                0 => Err(EngineError::Lost {
                    reason: "unplugged".to_owned(),
                }),
                _ => Ok(()),
            }
        }
    }

    impl Session for DyingSession {
        fn write_at(
            &mut self,
            id: ResourceId,
            first: usize,
            words: &[u32],
        ) -> Result<(), EngineError> {
            self.check()?;
            self.0.write_at(id, first, words)
        }

        fn grow(&mut self, id: ResourceId, count: usize) -> Result<(), EngineError> {
            self.check()?;
            self.0.grow(id, count)
        }

        fn submit(&mut self, ids: &[ResourceId]) -> Result<(), EngineError> {
            self.check()?;
            self.1.set(self.1.get() - 1);
            self.0.submit(ids)
        }

        fn collect(&mut self) -> Result<(Vec<PassTime>, Readings), EngineError> {
            let collected = self.0.collect();
            self.check()?;
            collected
        }

        fn in_flight(&self) -> usize {
            self.0.in_flight()
        }

        fn read_all(&mut self, ids: &[ResourceId]) -> Result<Readings, EngineError> {
            self.check()?;
            self.0.read_all(ids)
        }
    }

    /// The smoke of six pictures, which differs from picture to picture.
    fn puffs() -> Vec<Smoke> {
        let puff = |i| Smoke {
            spheres: vec![Sphere::new([i as f32 * 0.3 - 0.8, 0.0, 0.0], 0.4)],
            space: Some(([-2.0; 3], [2.0; 3])),
        };
        (0..6).map(puff).collect()
    }

    /// Runs `work` with a film of [`puffs`] that goes into six files of a folder, and gives the contents of the files.
    fn written(
        work: impl FnOnce(&Screening, &dyn Fn(&dyn Engine) -> Result<(), RenderError>),
    ) -> Vec<Option<Vec<u8>>> {
        let (folder, smoke) = (tempfile::tempdir().expect("a folder"), puffs());
        let target = Target::of(&folder.path().join("#.png")).expect("a place");
        let (scene, style) = (npr_scene::Scene::default(), Style::default());
        let mut progress = Progress::new(true);
        let limits = npr_scene::Limits::default();
        let prepared = render::prepared(&scene, &style, &limits, None, &mut progress);
        let prepared = prepared.expect("an empty scene");
        let options = RendererOptions {
            smoke: smoke.first().cloned(),
            ..RendererOptions::new([48, 32])
        };
        let camera = Camera::framing([-1.0; 3], [1.0; 3]);
        let reel = Reel::Stills(Stills {
            target: &target,
            numbers: (0..6).collect(),
            encoding: Encoding::Png { keep_alpha: false },
        });
        let shots = smoke.iter().map(|smoke| Shot {
            camera,
            smoke: Some(smoke.clone()),
            passed: false,
        });
        let drawn = screened(reel, true, &mut progress, |screening, _| {
            work(screening, &|engine| {
                let renderer = prepared.renderer(engine, &style, &options)?;
                screening.show_all(renderer, shots.clone(), false)
            });
            Ok(Drawn {
                picture: (),
                engine: String::new(),
            })
        });
        drawn.expect("written");
        let path = |number| folder.path().join(format!("{number}.png"));
        (0..6)
            .map(|number| std::fs::read(path(number)).ok())
            .collect()
    }

    #[test]
    fn what_is_not_drawn_is_passed_where_strokes_hold() {
        let way = |done, holds| -> Vec<(u32, bool)> {
            let all = steps(&[2, 3, 5], done, holds);
            all.map(|step| (step.number, step.passed)).collect()
        };
        assert_eq!(way(0, false), [(2, false), (3, false), (5, false)]);
        assert_eq!(way(2, false), [(5, false)]);
        let passed = |from, to| (from..to).map(|number| (number, true));
        let first = passed(0, 2).chain([(2, false), (3, false), (4, true), (5, false)]);
        assert!(way(0, true).into_iter().eq(first));
        assert!(
            way(2, true)
                .into_iter()
                .eq(passed(0, 5).chain([(5, false)]))
        );
        assert_eq!((way(3, true), way(3, false)), (Vec::new(), Vec::new()));
    }

    #[test]
    fn a_film_goes_on_where_devices_were_lost_with_two_pictures_in_flight() {
        let wanted = written(|_, pictures| pictures(&Processor).expect("drawn"));
        assert!(wanted.iter().all(Option::is_some));
        assert!(wanted.windows(2).all(|pair| pair[0] != pair[1]));
        for lives in [[1, 1], [2, 3], [3, 4], [5, 2], [5, 9], [6, 2]] {
            let mut left = lives
                .into_iter()
                .collect::<std::collections::VecDeque<usize>>();
            let opened = RefCell::new(&mut left);
            let open = || {
                let life = opened.borrow_mut().pop_front();
                Ok(Dying::after(life.expect("it is opened twice at most")))
            };
            let warnings = RefCell::new(Vec::new());
            let warn = |text: &str| warnings.borrow_mut().push(text.to_owned());
            let files = written(|screening, pictures| {
                crate::engine::draw_somewhere(&open, &pictures, &warn)
                    .expect("the processor draws");
                assert_eq!(screening.done(), 6, "{lives:?}");
            });
            assert!(files == wanted, "{lives:?}");
            let is_lost_twice = lives[0].saturating_sub(2) + lives[1] <= 6;
            let said = "the graphics device was lost: unplugged; the processor draws instead";
            assert_eq!(
                warnings.into_inner(),
                [said][..usize::from(is_lost_twice)],
                "{lives:?}"
            );
        }
    }

    #[test]
    fn a_film_on_a_device_that_is_lost_twice_ends_with_one_sentence() {
        let wanted = written(|_, pictures| pictures(&Processor).expect("drawn"));
        let open = || Ok(Dying::after(3));
        let files = written(|screening, pictures| {
            let lost =
                crate::engine::draw_on_device(&open, &pictures).expect_err("it is lost twice");
            let fault = Fault::from(lost);
            assert_eq!(fault.exit, Exit::NoDevice);
            assert_eq!(fault.message, "the graphics device was lost: unplugged");
            assert_eq!(screening.done(), 2);
        });
        // Each device finished one picture, and nothing is left of the others.
        assert!(files[..2] == wanted[..2]);
        assert!(files[2..].iter().all(Option::is_none));
    }
}
