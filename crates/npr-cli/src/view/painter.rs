//! The thread that draws what a studio shows.

use super::actor::{Actor, Handed};
use super::asks::{Ask, Asks, Ends};
use super::order::{layer_of, order_arguments};
use super::playbill;
use super::save;
use super::swatch;
use super::why;
use crate::arguments::{Backend, RenderArguments, Size, ViewArguments};
use crate::device_choice::DeviceChoice;
use crate::fault::{Exit, Fault};
use crate::hardware;
use crate::job::{Job, PictureFormat};
use crate::message::quoted;
use crate::output::Output;
use crate::pose;
use crate::progress::Progress;
use crate::render::{self, Prepared};
use crate::source::{Loaded, Source};
use crate::target::Target;
use crate::viewpoint::{self, Seen, Viewed};
use npr_core::camera::{Camera, Projection};
use npr_core::interrupt::Interrupt;
use npr_gpu::engine::Engine;
use npr_gpu::processor::Processor;
use npr_render::{Frame, RenderError, Renderer, RendererOptions, Spot};
use npr_scene::Material;
use npr_stylesheet::Style;
use npr_view::{Film, News, Order, PassSeconds, Picture, Question, Take, Viewpoint};
use std::cell::{Cell, RefCell};
use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::mpsc::{Receiver, Sender};
use std::time::{Duration, Instant, SystemTime};

/// Time between two looks at the files that a picture is made from.
const LOOK: Duration = Duration::from_millis(500);

/// Renderers that are kept at a time: one of drafts and one of full pictures.
const KEPT: usize = 2;

/// Views whose strokes are kept.
const VIEWS: usize = 4;

/// What ends no picture.
static NEVER: Interrupt = Interrupt::NEVER;

/// Seconds that strokes may take to be found in drafts that follow a camera or a figure; beyond that their lines are
/// drawn by method `shape`.
const STROKES_S: f32 = 0.03;

/// Draws pictures one after the other, on a thread of its own.
pub struct Painter {
    args: ViewArguments,
    asks: Asks,
    news: Sender<News>,
    wake: Box<dyn Fn() + Send>,
    /// Where files go that are taken away.
    folder: PathBuf,
    /// The files that scene and style are made from, with the time of their last change.
    scene_files: RefCell<Vec<Watched>>,
    style_files: RefCell<Vec<Watched>>,
    /// The style that was read last, for the renderer of its order, which takes it.
    read: RefCell<Option<(Order, Style, RendererOptions)>>,
    /// Whether files of the style have changed since it was read.
    is_stale: Cell<bool>,
    scene: RefCell<PathBuf>,
    /// The file whose clips the figure of the scene plays.
    motion: RefCell<Option<PathBuf>>,
    /// How often a scene was opened.
    opened: Cell<u64>,
    /// The full picture that was drawn last.
    full: RefCell<Option<Order>>,
    /// Seconds that its strokes took to be found, where they were.
    strokes_s: Cell<f32>,
}

/// A renderer that is kept, with the order that it was made for and the pose that it has.
struct Kept<'a> {
    order: Order,
    style: Style,
    renderer: Renderer<'a>,
    handed: Handed,
    /// Whether its strokes are drawn by method `shape`.
    is_rough: bool,
    /// The picture whose strokes it shows, where that is another.
    strokes_of: Option<[u32; 2]>,
}

/// A file and when it changed last; `None` where there is none.
type Watched = (PathBuf, Option<SystemTime>);

impl Painter {
    /// A painter of the scene that arguments name, which calls `wake` after each of its news.
    pub fn new(
        args: ViewArguments,
        asks: Receiver<Ask>,
        news: Sender<News>,
        wake: Box<dyn Fn() + Send>,
        (folder, ends): (PathBuf, Ends),
    ) -> Self {
        let first = Ask::Open(args.scene.clone());
        Self {
            scene: RefCell::new(args.scene.clone()),
            opened: Cell::new(0),
            motion: RefCell::new(args.drawing.pose.motion.clone()),
            args,
            asks: Asks::after(first, asks, ends),
            news,
            wake,
            folder,
            scene_files: RefCell::default(),
            style_files: RefCell::default(),
            read: RefCell::default(),
            is_stale: Cell::new(false),
            full: RefCell::default(),
            strokes_s: Cell::new(0.0),
        }
    }

    /// Does what is asked for until nobody asks any more.
    pub fn work(self) {
        let this = Rc::new(self);
        this.work_on();
    }

    fn work_on(self: &Rc<Self>) {
        let mut engine = match self.engine() {
            Ok(engine) => engine,
            Err(fault) => {
                self.tell(News::Fault(fault.message));
                Box::new(Processor)
            }
        };
        let mut loaded: Option<Loaded> = None;
        let mut ask = self.next();
        loop {
            ask = match ask {
                Ask::End => return,
                Ask::Open(path) => {
                    self.open(&path, &mut loaded);
                    self.next()
                }
                // Only who draws a picture knows what is on it.
                Ask::PointAt(_) => self.next(),
                Ask::Save(take, order) => {
                    self.save(take, &order);
                    self.next()
                }
                Ask::Film(film, order) => {
                    self.film(&film, &order);
                    self.next()
                }
                // Poses of another scene may not fit; at first there was none.
                Ask::Draw(_, known) | Ask::Aside(_, known)
                    if known < self.opened.get() && self.opened.get() > 1 =>
                {
                    self.next()
                }
                Ask::Aside(order, _) => {
                    if let Some(loaded) = &loaded {
                        self.draw_aside(engine.as_ref(), loaded, &order);
                    }
                    self.next()
                }
                Ask::Draw(order, known) => {
                    let drawn = match &loaded {
                        Some(loaded) => self.draw(engine.as_ref(), loaded, &order),
                        None => Ok(self.next()),
                    };
                    match drawn {
                        Ok(next) => next,
                        Err(fault) if self.may_fall_back(&fault) && !is_processor(&*engine) => {
                            let text = format!("{}; the processor draws instead", fault.message);
                            self.tell(News::Fault(text));
                            engine = Box::new(Processor);
                            Ask::Draw(order, known)
                        }
                        Err(fault) => {
                            self.tell(News::Fault(fault.message));
                            self.next()
                        }
                    }
                }
            };
        }
    }

    /// The engine that the command would draw on.
    fn engine(&self) -> Result<Box<dyn Engine + Send>, Fault> {
        let opened = match self.args.drawing.backend {
            Backend::Cpu => return Ok(Box::new(Processor)),
            Backend::Gpu => hardware::open(DeviceChoice::Any, false),
            Backend::Auto => match hardware::open(DeviceChoice::Hardware, false) {
                Ok(device) => return Ok(device),
                Err(_) => return Ok(Box::new(Processor)),
            },
        };
        opened.map_err(|error| Fault::new(Exit::NoDevice, error))
    }

    /// Whether another engine may draw where one has failed.
    fn may_fall_back(&self, fault: &Fault) -> bool {
        fault.exit == Exit::NoDevice && self.args.drawing.backend == Backend::Auto
    }

    fn tell(&self, news: News) {
        // Nobody listens once the window is closed.
        let _ = self.news.send(news);
        (self.wake)();
    }

    /// Loads a scene in place of the one before, which stays where that fails; or lets its figure play a motion.
    fn open(&self, path: &Path, loaded: &mut Option<Loaded>) {
        // Find out what the file is.
        let limits = self.args.drawing.limits.limits();
        let scene = self.scene.borrow().clone();
        let is_motion = scene != path && playbill::is_motion(path, loaded.as_ref(), &limits);
        let (scene, motion) = match is_motion {
            true => (scene, Some(path.to_owned())),
            false if scene == path => (scene, self.motion.borrow().clone()),
            false => (path.to_owned(), None),
        };

        // Load it.
        let external = self.args.drawing.allow_external.as_deref();
        let opened = Source::of(&scene)
            .load(&limits, external)
            .and_then(|mut found| {
                if let Some(motion) = &motion {
                    pose::take_motion(motion, &mut found, &limits)?;
                }
                found.inputs.extend(self.args.drawing.pose.pose.clone());
                Ok(found)
            });
        match opened {
            Ok(found) => {
                *self.scene_files.borrow_mut() = watched(found.inputs.iter().cloned());
                let has_own_camera = self.args.drawing.camera.camera.is_some();
                let cast = playbill::cast_of(&found.scene, motion.as_deref(), has_own_camera);
                *loaded = Some(found);
                self.full.replace(None);
                self.motion.replace(motion);
                self.is_stale.set(true);
                self.opened.set(self.opened.get() + 1);
                let name = scene.to_string_lossy().into_owned();
                self.tell(News::Scene(name, Box::new(cast)));
                self.scene.replace(scene);
            }
            Err(fault) => {
                // A file that is written just now is looked at again.
                let files = self.scene_files.take().into_iter().map(|(path, _)| path);
                self.scene_files.replace(watched(files));
                self.tell(News::Fault(fault.message));
            }
        }
    }

    fn save(&self, take: Take, order: &Order) {
        let scene = self.scene.borrow().clone();
        let saved = save::picture(&self.args, (&self.folder, &scene), (take, order));
        self.tell(match saved {
            Ok(path) => News::Done(format!("{} is written", quoted(&path))),
            Err(fault) => News::Fault(fault.message),
        });
    }

    /// Draws a film, tells how far it is, and ends it where that is asked for.
    fn film(self: &Rc<Self>, film: &Film, order: &Order) {
        let scene = self.scene.borrow().clone();
        let this = self.clone();
        let mut progress = Progress::told_to(Rc::new(move |done, of| {
            this.tell(News::Film(Some([done, of])));
            !this.asks.ends().film.is_raised()
        }));
        let places = (self.folder.as_path(), scene.as_path());
        let saved = save::film(&self.args, places, (film, order), &mut progress);
        self.tell(News::Film(None));
        self.tell(match saved {
            Ok(path) => News::Done(format!("{} is written", quoted(&path))),
            Err(fault) => News::Fault(fault.message),
        });
    }

    /// Draws the picture of an order, and those of later ones while the scene as it was prepared serves them. Gives
    /// what is asked for next.
    fn draw(&self, engine: &dyn Engine, loaded: &Loaded, first: &Order) -> Result<Ask, Fault> {
        // Prepare the scene for the style.
        let path = self.scene.borrow().clone();
        let args = order_arguments(&self.args, &path, first);
        let job = self.job(&args)?;
        self.watch_style(&job);
        self.is_stale.set(false);
        let (painted, mut prepared) = self.prepared(&job, loaded)?;
        if let Some(lines) = &mut prepared.subject.lines {
            lines.keep_views(VIEWS);
        }
        let limits = self.args.drawing.limits.limits();
        let mut actor = Actor::new(prepared.scene.clone(), limits);

        // Draw, and go on with what the preparation serves: drafts may be of one that is a little off.
        let style = job.look.style.clone();
        self.read
            .replace(Some((first.clone(), job.look.style, job.options)));
        let mut kept = VecDeque::new();
        let mut order = first.clone();
        loop {
            self.draw_one((engine, (&prepared, &mut actor)), &path, &order, &mut kept)?;
            let scene = (engine, (&prepared, &mut actor));
            let next = self.answer(scene, (&path, loaded), &mut kept);
            let Ask::Draw(asked, _) = &next else {
                return Ok(next);
            };
            let is_same = asked.style == first.style && asked.overrides == first.overrides;
            let is_painted_so = asked.pose.face.expressions == first.pose.face.expressions || {
                let args = order_arguments(&self.args, &path, asked);
                let expressions = &args.drawing.pose.expressions;
                playbill::painted(expressions, &loaded.scene).is_ok_and(|other| other == painted)
            };
            let serves = is_same || self.serves((&style, &prepared), &path, asked);
            let is_smoke_so = asked.pose.volumes == first.pose.volumes;
            if self.is_stale.get() || !serves || !is_painted_so || !is_smoke_so {
                return Ok(next);
            }
            order = asked.clone();
        }
    }

    /// A scene that was loaded, prepared for the picture of a job, and its materials in the colours of expressions.
    fn prepared(&self, job: &Job<'_>, loaded: &Loaded) -> Result<(Vec<Material>, Prepared), Fault> {
        let painted = playbill::painted(&job.args.drawing.pose.expressions, &loaded.scene)?;
        let mut loaded = Loaded {
            scene: loaded.scene.clone(),
            format: loaded.format,
            volume: loaded.volume.clone(),
            inputs: loaded.inputs.clone(),
        };
        loaded.scene.materials.clone_from(&painted);
        let prepared = render::prepare(job, loaded, None, &mut Progress::new(true))?;
        Ok((painted, prepared))
    }

    /// Draws a picture beside the present one, of the scene or a sample prepared for it alone, and tells it.
    fn draw_aside(&self, engine: &dyn Engine, loaded: &Loaded, order: &Order) {
        let path = self.scene.borrow().clone();
        let sample = order.swatch.map(|swatch| swatch::of(swatch, order));
        let draw = || {
            let (loaded, order) = match &sample {
                Some((loaded, order)) => (loaded, order),
                None => (loaded, order),
            };
            let start = Instant::now();
            let args = order_arguments(&self.args, &path, order);
            let job = self.job(&args)?;
            let (_, prepared) = self.prepared(&job, loaded)?;
            let read = (order.clone(), job.look.style, job.options);
            self.read.replace(Some(read));
            let limits = self.args.drawing.limits.limits();
            let mut actor = Actor::new(prepared.scene.clone(), limits);
            let scene = (engine, (&prepared, &mut actor));
            let asked = (order, &self.asks.ends().picture);
            let (mut found, camera, viewpoint) =
                self.poised(scene, &path, asked, &mut VecDeque::new())?;
            let frame = self.drawn(&mut found.renderer, &camera, order)?;
            let shown =
                frame.map(|frame| picture((engine, &actor), order, viewpoint, (frame, start)));
            Ok(shown.map(Box::new))
        };
        let drawn: Result<Option<Box<Picture>>, Fault> = draw();
        if let Some(drawn) = drawn.map_err(|fault| fault.message).transpose() {
            self.tell(News::Aside(Box::new(order.clone()), drawn));
        }
    }

    /// Tells what is on the pictures that were drawn, and draws others beside them, until something else is asked for,
    /// and gives that.
    fn answer<'a>(
        &self,
        (engine, (prepared, actor)): (&'a dyn Engine, (&'a Prepared, &mut Actor)),
        (path, loaded): (&Path, &Loaded),
        kept: &mut VecDeque<Kept<'a>>,
    ) -> Ask {
        loop {
            let question = match self.next() {
                Ask::PointAt(question) => question,
                Ask::Aside(order, known) if known >= self.opened.get() => {
                    self.draw_aside(engine, loaded, &order);
                    continue;
                }
                other => return other,
            };
            let scene = (prepared, &mut *actor);
            let told = self.point_at((engine, scene), path, &question, kept);
            if let Err(fault) = told {
                self.tell(News::Fault(fault.message));
            }
        }
    }

    fn point_at<'a>(
        &self,
        scene: (&'a dyn Engine, (&'a Prepared, &mut Actor)),
        path: &Path,
        question: &Question,
        kept: &mut VecDeque<Kept<'a>>,
    ) -> Result<(), Fault> {
        let (mut found, camera, _) = self.poised(scene, path, self.asked(&question.order), kept)?;
        let spot = Spot {
            place: question.place.map(f64::from),
            reach_px: f64::from(question.reach_px),
        };
        let pointed = found.renderer.point_at(&camera, spot)?;
        let answer = why::answer(question, &found.style, pointed);
        keep(kept, found);
        self.tell(News::Pointed(Box::new(answer)));
        Ok(())
    }

    fn job<'a>(&self, args: &'a RenderArguments) -> Result<Job<'a>, Fault> {
        let source = Source::of(args.scene.as_deref().unwrap_or(Path::new("-")));
        let target = Target::One(Output::Standard);
        Job::drawn_into(args, source, target, PictureFormat::Png)
    }

    /// Watches the files that a picture is made from besides its scene.
    fn watch_style(&self, job: &Job<'_>) {
        let volumes = job.args.drawing.volumes.volumes.iter();
        let files = job
            .look
            .inputs()
            .chain(volumes.map(|volume| volume.name.clone()));
        self.style_files.replace(watched(files));
    }

    /// Whether an order can be drawn of a scene that was prepared for another style.
    fn serves(&self, (style, prepared): (&Style, &Prepared), path: &Path, order: &Order) -> bool {
        let args = order_arguments(&self.args, path, order);
        let Ok(job) = self.job(&args) else {
            return false;
        };
        let asked = &job.look.style;
        let serves = asked.id_map == style.id_map
            && asked.smoke == style.smoke
            && asked.curve_sources().eq(style.curve_sources())
            && (order.is_draft || prepared.subject.serves(style, asked));
        if serves && !order.is_draft {
            self.watch_style(&job);
        }
        self.read
            .replace(Some((order.clone(), job.look.style, job.options)));
        serves
    }

    /// Whether the strokes of a draft would take too long: those of another view than that of the last full picture
    /// have to be found. A layer shows how the style draws, and never another method.
    fn is_rough(&self, order: &Order) -> bool {
        let is_free = order.is_draft && order.layer.is_none();
        is_free && !self.is_known(order) && self.strokes_s.get() > STROKES_S
    }

    /// Whether the last full picture shows the scene of an order as its camera does.
    fn is_known(&self, order: &Order) -> bool {
        let full = self.full.borrow();
        let is_of = |full: &Order| full.viewpoint == order.viewpoint && full.pose == order.pose;
        full.as_ref().is_some_and(is_of)
    }

    /// The picture whose strokes a draft shows: the last full one, where it has the same shape.
    fn strokes_of(&self, order: &Order) -> Option<[u32; 2]> {
        let full = self.full.borrow().as_ref().map(|full| full.size);
        full.filter(|full| {
            let [width, height] = order.size.map(f64::from);
            let [full_width, full_height] = full.map(f64::from);
            order.is_draft && (full_width / full_height * height - width).abs() <= 1.0
        })
    }

    /// The renderer of an order's style and size: one that is kept, which is taken out, or a new one.
    fn renderer<'a>(
        &self,
        (engine, prepared): (&'a dyn Engine, &'a Prepared),
        (args, (order, interrupt)): (&RenderArguments, (&Order, &Interrupt)),
        kept: &mut VecDeque<Kept<'a>>,
    ) -> Result<Kept<'a>, Fault> {
        let read = self.read.take();
        let (is_rough, strokes_of) = (self.is_rough(order), self.strokes_of(order));
        let draws = |other: &Kept<'_>| {
            let is_alike = other.is_rough == is_rough && other.strokes_of == strokes_of;
            let other = &other.order;
            is_alike
                && other.size == order.size
                && other.is_draft == order.is_draft
                && other.layer == order.layer
                && other.style == order.style
                && other.overrides == order.overrides
        };
        let found = kept.iter().position(draws);
        if let Some(found) = found.and_then(|place| kept.remove(place)) {
            return Ok(found);
        }
        let (mut style, options) = match read {
            Some((of, style, options)) if of == *order => (style, options),
            _ => {
                let job = self.job(args)?;
                (job.look.style, job.options)
            }
        };
        if is_rough {
            style = style.with_shapes_for_strokes().unwrap_or(style);
        }
        let options = RendererOptions {
            smoke: prepared.smoke.clone(),
            strokes_of,
            interrupt: interrupt.clone(),
            ..options
        };
        Ok(Kept {
            order: order.clone(),
            is_rough,
            strokes_of,
            renderer: prepared.renderer(engine, (&style, &options))?,
            style,
            handed: Handed::default(),
        })
    }

    /// The renderer of an order, taken out of those that are kept and with the order's pose, and the camera to draw
    /// with.
    fn poised<'a>(
        &self,
        (engine, (prepared, actor)): (&'a dyn Engine, (&'a Prepared, &mut Actor)),
        path: &Path,
        (order, interrupt): (&Order, &Interrupt),
        kept: &mut VecDeque<Kept<'a>>,
    ) -> Result<(Kept<'a>, Camera, Viewpoint), Fault> {
        // Find the renderer, or make it.
        let args = order_arguments(&self.args, path, order);
        let asked = (&args, (order, interrupt));
        let mut found = self.renderer((engine, prepared), asked, kept)?;

        // Place the camera, and pose the scene for it.
        let (pose, style) = (&args.drawing.pose, &found.style);
        actor.stand(pose, style)?;
        // A draft is framed as the picture whose strokes it shows: its own sides are rounded.
        let size = found
            .strokes_of
            .map_or(args.drawing.size, |[width, height]| Size { width, height });
        let camera = |seen: &Seen<'_>| viewpoint::camera(&args.drawing.camera, seen, size);
        let (camera, viewpoint) = match order.viewpoint {
            Some(point) => (camera(&prepared.seen()?)?, point),
            None => {
                let seen = actor.seen(prepared)?;
                let camera = camera(&seen)?;
                let point = Viewpoint::of(&about_middle(camera, seen.bounds()));
                (camera, point)
            }
        };
        actor.face(&camera, style)?;
        let seconds = pose.time.unwrap_or(0.0);
        actor.hand_to(&mut found.renderer, &mut found.handed, seconds)?;
        Ok((found, camera, viewpoint))
    }

    /// An order, with what ends its picture.
    fn asked<'o>(&'o self, order: &'o Order) -> (&'o Order, &'o Interrupt) {
        match order.is_draft {
            true => (order, &NEVER),
            false => (order, &self.asks.ends().picture),
        }
    }

    /// Draws a frame to its end, or none where something else waits to be drawn.
    fn drawn(
        &self,
        renderer: &mut Renderer<'_>,
        camera: &Camera,
        order: &Order,
    ) -> Result<Option<Frame>, Fault> {
        loop {
            match frame_of(renderer, camera, order) {
                Ok(frame) => return Ok(Some(frame)),
                Err(error) if error.is_interrupted() && self.asks.have_picture() => {
                    return Ok(None);
                }
                // The flag was raised for the frame itself, after it was taken.
                Err(error) if error.is_interrupted() => {}
                Err(error) => return Err(error.into()),
            }
        }
    }

    /// Draws one picture, with a renderer that is kept for the next, unless something else waits to be drawn.
    fn draw_one<'a>(
        &self,
        (engine, (prepared, actor)): (&'a dyn Engine, (&'a Prepared, &mut Actor)),
        path: &Path,
        order: &Order,
        kept: &mut VecDeque<Kept<'a>>,
    ) -> Result<(), Fault> {
        let start = Instant::now();
        let scene = (engine, (prepared, &mut *actor));
        let (mut found, camera, viewpoint) = self.poised(scene, path, self.asked(order), kept)?;
        let drawn = Instant::now();
        let Some(frame) = self.drawn(&mut found.renderer, &camera, order)? else {
            keep(kept, found);
            return Ok(());
        };
        if !order.is_draft {
            let passes: Duration = frame.times.iter().map(|pass| pass.time).sum();
            let strokes = drawn.elapsed().saturating_sub(passes);
            if !self.is_known(order) {
                self.strokes_s.set(strokes.as_secs_f32());
            }
            self.full.replace(Some(order.clone()));
        }
        keep(kept, found);
        let picture = picture((engine, actor), order, viewpoint, (frame, start));
        self.tell(News::Picture(Box::new(picture)));
        Ok(())
    }

    /// Waits for what is asked for next, and looks at the files now and then.
    fn next(&self) -> Ask {
        loop {
            if let Some(ask) = self.asks.next(LOOK) {
                return ask;
            }
            if have_changed(&self.scene_files) {
                return Ask::Open(self.scene.borrow().clone());
            }
            if have_changed(&self.style_files) {
                self.is_stale.set(true);
                self.tell(News::StyleChanged);
            }
        }
    }
}

/// Keeps a renderer before all others, and lets go of what is more than [`KEPT`].
fn keep<'a>(kept: &mut VecDeque<Kept<'a>>, found: Kept<'a>) {
    kept.push_front(found);
    kept.truncate(KEPT);
}

/// The frame of an order, or the layer that it shows.
fn frame_of(
    renderer: &mut Renderer<'_>,
    camera: &Camera,
    order: &Order,
) -> Result<Frame, RenderError> {
    match layer_of(order) {
        None => renderer.draw(camera),
        Some(layer) => layer.draw(renderer, camera, order.size),
    }
}

/// A frame of an order as a picture, which was begun at a time.
fn picture(
    (engine, actor): (&dyn Engine, &Actor),
    order: &Order,
    viewpoint: Viewpoint,
    (mut frame, start): (Frame, Instant),
) -> Picture {
    frame.notices.extend_from_slice(actor.warnings());
    let passes = frame.times.iter().map(|pass| PassSeconds {
        name: pass.name,
        seconds: pass.time.as_secs_f32(),
    });
    Picture {
        rgba: frame.rgba,
        viewpoint,
        engine: engine.describe(),
        seconds: start.elapsed().as_secs_f32(),
        passes: engine.tells_passes_apart().then(|| passes.collect()),
        notices: frame.notices,
        order: order.clone(),
    }
}

/// The same view with its target where the middle of the scene is nearest to the axis, so that it turns about that.
fn about_middle(camera: Camera, (min, max): ([f32; 3], [f32; 3])) -> Camera {
    if !matches!(camera.projection, Projection::Perspective { .. }) {
        return camera;
    }
    let back = camera.axes()[2];
    let away = (0..3).map(|i| (camera.eye[i] - (min[i] + max[i]) * 0.5) * back[i]);
    let distance: f32 = away.sum();
    if distance <= 0.0 {
        return camera;
    }
    Camera {
        target: std::array::from_fn(|i| camera.eye[i] - back[i] * distance),
        ..camera
    }
}

fn is_processor(engine: &dyn Engine) -> bool {
    engine.describe() == Processor.describe()
}

/// Files with the time of their last change.
fn watched(files: impl IntoIterator<Item = PathBuf>) -> Vec<Watched> {
    let time = |path: &Path| {
        std::fs::metadata(path)
            .and_then(|data| data.modified())
            .ok()
    };
    files
        .into_iter()
        .map(|path| {
            let changed = time(&path);
            (path, changed)
        })
        .collect()
}

/// Whether any of the files has changed since it was looked at; it is looked at now.
fn have_changed(files: &RefCell<Vec<Watched>>) -> bool {
    let before = files.take();
    let now = watched(before.iter().map(|(path, _)| path.clone()));
    let is_changed = now != before;
    files.replace(now);
    is_changed
}

#[cfg(test)]
mod tests;
