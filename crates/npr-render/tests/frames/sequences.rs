//! Sequences of frames, two of them under way at once.

use npr_core::camera::Camera;
use npr_core::math::{cos, sin};
use npr_gpu::engine::{Engine, EngineError, PassTime, Readings, Session};
use npr_gpu::graph::{Graph, ResourceId};
use npr_gpu::processor::Processor;
use npr_render::{
    Frame, LineModel, LineModelOptions, LineRenderer, Model, RenderError, Renderer,
    RendererOptions, Shot, Smoke, Sphere,
};
use npr_scene::testing::Sheet;
use npr_scene::{Limits, MemoryResources, Scene, load_bytes};
use npr_stylesheet::Style;
use proptest::prelude::*;
use std::cell::{Cell, RefCell};
use std::rc::Rc;

const SIZE: [u32; 2] = [120, 90];

/// Most spheres of a shot.
const SPHERES: u32 = 12;

pub fn scene() -> Scene {
    let resources = MemoryResources::default();
    let file = Sheet::new(3).glb();
    load_bytes("sheet", &file, None, &resources, &Limits::default()).unwrap()
}

pub fn style(keys: &[&str]) -> Style {
    let every_part = "[[rule]]\nmatch.object = '*'\n";
    let mut style = Style::from_toml(every_part, &|_| Err(String::new())).unwrap();
    keys.iter().for_each(|key| style.set(key).unwrap());
    style
}

pub fn options(tile_pixels: u32) -> RendererOptions {
    RendererOptions {
        smoke: Some(puffs(SPHERES)),
        tile_pixels,
        ..RendererOptions::new(SIZE)
    }
}

/// Round smoke over the sheet, the more spheres the wider.
fn puffs(count: u32) -> Smoke {
    let sphere = |i: u32| {
        let angle = i as f32 * 2.4;
        let out = 0.1 * i as f32;
        let center = [1.0 + out * cos(angle), 0.6, 1.0 + out * sin(angle)];
        Sphere::new(center, 0.5)
    };
    Smoke {
        spheres: (0..count).map(sphere).collect(),
        space: Some(([-1.0; 3], [3.0; 3])),
    }
}

pub fn camera(angle_deg: f32) -> Camera {
    let angle = angle_deg.to_radians();
    Camera {
        eye: [1.0 + 5.0 * sin(angle), 3.0, 1.0 + 5.0 * cos(angle)],
        target: [1.0, 0.0, 1.0],
        ..Camera::framing([0.0; 3], [2.0; 3])
    }
}

fn shot(angle_deg: f32, count: Option<u32>) -> Shot {
    Shot {
        camera: camera(angle_deg),
        smoke: count.map(puffs),
        passed: false,
    }
}

/// The processor, and a device where there is one.
pub fn engines() -> Vec<&'static dyn Engine> {
    let mut engines: Vec<&'static dyn Engine> = vec![&Processor];
    #[cfg(feature = "wgpu")]
    engines.extend(npr_gpu::device::testing::device().map(|device| device as &dyn Engine));
    engines
}

fn one_by_one(renderer: &mut Renderer<'_>, shots: &[Shot]) -> Vec<Frame> {
    let draw = |shot: &Shot| {
        if let Some(smoke) = &shot.smoke {
            renderer.set_smoke(smoke).unwrap();
        }
        renderer.draw(&shot.camera).unwrap()
    };
    shots.iter().map(draw).collect()
}

/// Looks whose frames have something of their own to remember while the next is drawn.
pub const LOOKS: [&[&str]; 9] = [
    &[],
    &["line.method=angle", "light.shadow=true"],
    &[
        "background='#303030'",
        "line.background.method=contrast",
        "line.background.start=rim",
    ],
    &["line.method=strokes"],
    &["line.method=strokes", "line.background.method=contrast"],
    &["blend.with=technical", "blend.amount=0.5"],
    &["blend.with=ink", "blend.amount=0.4", "line.method=strokes"],
    &["rule.0.motion.trail=[-0.9, 0.3, 0.0]"],
    // Strokes that turn with the light are written anew for every camera.
    &["ink.tone=ink+hatch", "ink.follow=light"],
];

/// Checks that a sequence in a look has the frames that are drawn one by one.
fn check_sequence(look: &[&str], tile_pixels: u32, shots: &[Shot]) {
    let (scene, style, options) = (scene(), style(look), options(tile_pixels));
    let model = Model::new(&scene).unwrap();
    let lines = LineModel::new(&scene, &LineModelOptions::default()).unwrap();
    for engine in engines() {
        let renderer = || {
            let lines = LineRenderer::new(engine, &lines);
            Renderer::with_lines(engine, (&model, lines), &style, &options).unwrap()
        };
        let wanted = one_by_one(&mut renderer(), shots);
        let mut sequence = renderer();
        let frames = sequence.frames(shots.to_vec());
        let drawn: Vec<Frame> = frames.map(Result::unwrap).collect();
        assert_eq!(drawn.len(), wanted.len());
        for (number, (one, other)) in drawn.iter().zip(&wanted).enumerate() {
            let place = format!("frame {number}, {look:?}, {}", engine.describe());
            assert!(one.rgba == other.rgba, "{place}");
            assert_eq!(one.notices, other.notices, "{place}");
            let names =
                |frame: &Frame| -> Vec<&str> { frame.times.iter().map(|time| time.name).collect() };
            assert_eq!(names(one), names(other), "{place}");
        }
    }
}

#[test]
fn every_look_is_the_same_in_a_sequence() {
    // The eye goes on, stays and jumps; smoke comes and goes.
    let shots = [
        shot(0.0, Some(SPHERES)),
        shot(1.0, Some(2)),
        shot(1.0, None),
        shot(90.0, Some(SPHERES - 1)),
        shot(200.0, Some(0)),
    ];
    for look in LOOKS {
        check_sequence(look, 1 << 20, &shots);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 10, ..ProptestConfig::default() })]

    #[test]
    fn frames_of_a_sequence_are_those_drawn_one_by_one(
        look in 0..LOOKS.len(),
        in_tiles in any::<bool>(),
        moments in prop::collection::vec((0usize..8, prop::option::of(0u32..=SPHERES)), 0..6),
    ) {
        // Small turns go on from the frame before, the last ones are cuts.
        let angles = [0.0, 1.0, 2.0, 3.0, 4.0, 90.0, 200.0, 310.0];
        let shots = moments.iter().map(|&(angle, count)| shot(angles[angle], count));
        let tile_pixels = if in_tiles { 1 } else { 1 << 20 };
        check_sequence(LOOKS[look], tile_pixels, &shots.collect::<Vec<_>>());
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Call {
    Submit,
    Collect,
    Read,
}
use Call::{Collect, Submit};

/// An engine whose sessions tell what they are asked for, each with its number.
struct Spy<'e> {
    engine: &'e dyn Engine,
    sessions: Cell<usize>,
    calls: Rc<RefCell<Vec<(usize, Call)>>>,
}

struct SpySession {
    session: Box<dyn Session>,
    number: usize,
    calls: Rc<RefCell<Vec<(usize, Call)>>>,
}

impl<'e> Spy<'e> {
    fn new(engine: &'e dyn Engine) -> Self {
        Self {
            engine,
            sessions: Cell::new(0),
            calls: Rc::default(),
        }
    }
}

impl Engine for Spy<'_> {
    fn describe(&self) -> String {
        self.engine.describe()
    }

    fn runs_twins(&self) -> bool {
        self.engine.runs_twins()
    }

    fn prepare(&self, graph: Graph) -> Result<Box<dyn Session>, EngineError> {
        let number = self.sessions.get();
        self.sessions.set(number + 1);
        Ok(Box::new(SpySession {
            session: self.engine.prepare(graph)?,
            number,
            calls: self.calls.clone(),
        }))
    }
}

impl SpySession {
    fn tell(&self, call: Call) {
        self.calls.borrow_mut().push((self.number, call));
    }
}

impl Session for SpySession {
    fn write_at(&mut self, id: ResourceId, first: usize, words: &[u32]) -> Result<(), EngineError> {
        self.session.write_at(id, first, words)
    }

    fn grow(&mut self, id: ResourceId, count: usize) -> Result<(), EngineError> {
        self.session.grow(id, count)
    }

    fn submit(&mut self, ids: &[ResourceId]) -> Result<(), EngineError> {
        self.tell(Submit);
        self.session.submit(ids)
    }

    fn collect(&mut self) -> Result<(Vec<PassTime>, Readings), EngineError> {
        self.tell(Collect);
        self.session.collect()
    }

    fn in_flight(&self) -> usize {
        self.session.in_flight()
    }

    fn read_all(&mut self, ids: &[ResourceId]) -> Result<Readings, EngineError> {
        self.tell(Call::Read);
        self.session.read_all(ids)
    }
}

/// What drawing `count` shots asks of an engine.
fn calls_of(look: &[&str], tile_pixels: u32, count: usize) -> Vec<(usize, Call)> {
    let style = style(look);
    let model = Model::new(&scene()).unwrap();
    let spy = Spy::new(&Processor);
    let mut renderer = Renderer::new(&spy, &model, &style, &options(tile_pixels)).unwrap();
    let shots = (0..count).map(|i| shot(10.0 * i as f32, Some(1 + i as u32)));
    let drawn = renderer.frames(shots).map(Result::unwrap).count();
    assert_eq!(drawn, count);
    spy.calls.take()
}

/// Submits and waits of `count` runs, of which two are in flight.
fn overlapped(count: usize) -> Vec<(usize, Call)> {
    let more = (1..count).flat_map(|_| [Submit, Collect]);
    let all = [Submit].into_iter().chain(more).chain([Collect]);
    all.map(|call| (0, call)).collect()
}

#[test]
fn the_next_frame_is_submitted_before_the_first_is_waited_for() {
    for count in 1..5 {
        assert_eq!(calls_of(&[], 1 << 20, count), overlapped(count));
    }
}

#[test]
fn tiles_of_a_frame_are_under_way_two_at_a_time() {
    let tile_count = calls_of(&[], 1, 1).len() / 2;
    assert!(tile_count > 2, "{tile_count}");
    let wanted = overlapped(tile_count).repeat(3);
    assert_eq!(calls_of(&[], 1, 3), wanted);
}

#[test]
fn both_looks_of_a_blend_are_under_way() {
    let calls = calls_of(&["blend.with=technical", "blend.amount=0.5"], 1 << 20, 3);
    let both = |call| [(0, call), (1, call)];
    let wanted = [Submit, Submit, Collect, Submit, Collect, Collect].map(both);
    // Whichever of both sessions was prepared first.
    let flipped = wanted.map(|[one, two]| [two, one]);
    assert!(
        calls == wanted.concat() || calls == flipped.concat(),
        "{calls:?}"
    );
}

#[test]
fn a_shot_is_asked_for_when_its_frame_begins() {
    let (style, model) = (style(&[]), Model::new(&scene()).unwrap());
    let mut renderer = Renderer::new(&Processor, &model, &style, &options(1 << 20)).unwrap();
    let asked = Cell::new(0);
    let shots = (0..4).map(|i| {
        asked.set(asked.get() + 1);
        camera(30.0 * i as f32)
    });
    let mut frames = renderer.frames(shots);
    for wanted in [2, 3, 4, 4] {
        assert!(matches!(frames.next(), Some(Ok(_))));
        assert_eq!(asked.get(), wanted);
    }
    assert!(frames.next().is_none());
}

#[test]
fn a_shot_that_fails_ends_the_sequence_after_the_frames_before_it() {
    let (style, model) = (style(&[]), Model::new(&scene()).unwrap());
    let new = || Renderer::new(&Processor, &model, &style, &options(1 << 20)).unwrap();
    let mut renderer = new();
    let counts = [1, 2, 3, SPHERES + 1, 4];
    let shots = counts.map(|count| shot(count as f32, Some(count)));
    let drawn: Vec<_> = renderer.frames(shots.clone()).collect();
    assert_eq!(drawn.len(), 4);
    let wanted = one_by_one(&mut new(), &shots[..3]);
    let frames = drawn[..3].iter().map(|frame| frame.as_ref().unwrap());
    assert!(
        frames
            .map(|frame| &frame.rgba)
            .eq(wanted.iter().map(|frame| &frame.rgba))
    );
    assert!(matches!(drawn[3], Err(RenderError::TooMany { .. })));
}

#[test]
fn whoever_has_seen_enough_leaves_nothing_behind() {
    let (style, model) = (style(&[]), Model::new(&scene()).unwrap());
    for engine in engines() {
        for tile_pixels in [1, 1 << 20] {
            let options = options(tile_pixels);
            let new = || Renderer::new(engine, &model, &style, &options).unwrap();
            let mut renderer = new();
            let first = renderer.frames([0.0, 50.0, 100.0].map(camera)).next();
            assert!(first.unwrap().is_ok());
            renderer.pass_costs().unwrap();
            renderer.frames([7.0, 8.0].map(camera)).next();
            let next = renderer.draw(&camera(200.0)).unwrap();
            assert!(next.rgba == new().draw(&camera(200.0)).unwrap().rgba);
            renderer.frames([7.0, 8.0].map(camera)).next();
            let mut again = renderer.frames([camera(200.0)]);
            assert!(again.next().unwrap().unwrap().rgba == next.rgba);
        }
    }
}

#[cfg(feature = "wgpu")]
mod on_devices {
    use super::*;
    use npr_gpu::device::{Device, Traffic, testing};

    #[test]
    fn a_sequence_submits_and_waits_once_a_frame() {
        // A device of its own: others would count along.
        let Some(device) = testing::open() else {
            return;
        };
        let (style, model) = (style(&[]), Model::new(&scene()).unwrap());
        let mut renderer = Renderer::new(&device, &model, &style, &options(1 << 20)).unwrap();
        let before = device.traffic();
        let mut frames = renderer.frames((0..6).map(|i| shot(i as f32, Some(i))));
        for number in 1..=6 {
            assert!(matches!(frames.next(), Some(Ok(_))));
            let Traffic { submits, waits } = device.traffic();
            let made = [submits - before.submits, waits - before.waits];
            assert_eq!(made, [6.min(number + 1), number]);
        }
        assert!(frames.next().is_none());
    }

    /// A device that is lost after some submissions.
    struct Dying(Device, usize);

    struct DyingSession(Box<dyn Session>, Device, usize);

    impl Engine for Dying {
        fn describe(&self) -> String {
            self.0.describe()
        }

        fn prepare(&self, graph: Graph) -> Result<Box<dyn Session>, EngineError> {
            let session = self.0.prepare(graph)?;
            Ok(Box::new(DyingSession(session, self.0.clone(), self.1)))
        }
    }

    impl Session for DyingSession {
        fn write_at(
            &mut self,
            id: ResourceId,
            first: usize,
            words: &[u32],
        ) -> Result<(), EngineError> {
            self.0.write_at(id, first, words)
        }

        fn grow(&mut self, id: ResourceId, count: usize) -> Result<(), EngineError> {
            self.0.grow(id, count)
        }

        fn submit(&mut self, ids: &[ResourceId]) -> Result<(), EngineError> {
            self.0.submit(ids)?;
            // It is an error to start anything after the loss.
            self.2 -= 1;
            if self.2 == 0 {
                self.1.destroy();
            }
            Ok(())
        }

        fn collect(&mut self) -> Result<(Vec<PassTime>, Readings), EngineError> {
            self.0.collect()
        }

        fn in_flight(&self) -> usize {
            self.0.in_flight()
        }

        fn read_all(&mut self, ids: &[ResourceId]) -> Result<Readings, EngineError> {
            self.0.read_all(ids)
        }
    }

    #[test]
    fn a_loss_ends_the_sequence_with_the_first_frame_that_is_lost() {
        let (style, model) = (style(&[]), Model::new(&scene()).unwrap());
        for after in 1..=5 {
            let Some(device) = testing::open() else {
                return;
            };
            let dying = Dying(device, after);
            let mut renderer = Renderer::new(&dying, &model, &style, &options(1 << 20)).unwrap();
            let shots = (0..5).map(|i| shot(i as f32, Some(i)));
            let drawn: Vec<_> = renderer.frames(shots).collect();
            // Both frames that were under way are gone, and one error tells.
            let (last, whole) = drawn.split_last().unwrap();
            assert_eq!(whole.len(), after.saturating_sub(2));
            assert!(whole.iter().all(Result::is_ok));
            let lost = last.as_ref().map(drop).unwrap_err();
            assert!(matches!(
                lost,
                RenderError::Engine(EngineError::Lost { .. })
            ));
        }
    }
}

#[test]
fn a_camera_is_a_shot_that_goes_on_with_the_smoke() {
    let seen = Camera::framing([0.0; 3], [1.0; 3]);
    let shot = Shot::from(seen);
    assert_eq!((shot.camera, shot.smoke), (seen, None));
}
