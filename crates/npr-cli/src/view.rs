//! `npr view`: a studio whose pictures are drawn as `npr render` draws them.

mod actor;
mod asks;
mod order;
mod painter;
mod playbill;
mod save;
mod swatch;
mod why;

use crate::arguments::{Said, ViewArguments};
use crate::debug_layer::DebugLayer;
use crate::ending::has_ending;
use crate::fault::{Exit, Fault};
use crate::message::quoted;
use crate::source::has_volume_name;
use crate::style_source::StyleSource;
use asks::{Ask, Ends};
use npr_stylesheet::{DEFAULT_PRESET, Stated};
use npr_view::{
    FileKind, Film, Host, Layer, News, Order, Pose, Question, Sheet, Studio, Take, shell_line,
};
use order::{pose_of, render_arguments};
use painter::Painter;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::thread::{self, JoinHandle};

/// Options that the studio says itself.
const OWN_OPTIONS: [&str; 13] = [
    "style",
    "overrides",
    "background",
    "size",
    "quiet",
    "timings",
    "dump_style",
    "clip",
    "time",
    "motion",
    "pose",
    "expressions",
    "look_at",
];

/// Options that say where the camera is.
const CAMERA_OPTIONS: [&str; 7] = ["eye", "target", "up", "fov", "view", "ortho", "camera"];

/// The host of a studio: it reads files, and lets a painter draw on a thread of its own.
pub struct Desk {
    said: Said<ViewArguments>,
    scene: PathBuf,
    /// How often the painter has told that it opened a scene.
    opened: u64,
    asks: Sender<Ask>,
    news: Receiver<News>,
    /// News that the desk has itself.
    own: Vec<News>,
    /// Whether it was told that the painter has ended.
    has_ended: bool,
    /// Where files go that are taken away.
    folder: PathBuf,
    ends: Ends,
    /// Whether a film is drawn.
    is_filming: bool,
    painter: Option<JoinHandle<()>>,
}

/// Refuses a style that cannot be read, before there is a window.
pub fn check(args: &ViewArguments) -> Result<(), Fault> {
    sheet_of(args).map(|_| ())
}

/// The studio of a command line, drawn by a painter that calls `wake` when it has news.
pub fn studio(said: &Said<ViewArguments>, wake: Box<dyn Fn() + Send>) -> Result<Studio, Fault> {
    let sheet = sheet_of(&said.args)?;
    let is_sized = said.options.iter().any(|(id, _)| id == "size");
    let size = said.args.drawing.size;
    let size = is_sized.then_some([size.width, size.height]);
    let pose = pose_of(&said.args.drawing.pose);
    Ok(Studio::new(sheet, size, Box::new(Desk::new(said, wake)?)).posed(pose))
}

/// The style that a command line asks for, with its overrides.
fn sheet_of(args: &ViewArguments) -> Result<Sheet, Fault> {
    let look = render_arguments(args, &args.scene).look();
    let name = look.style.as_deref().unwrap_or(DEFAULT_PRESET);
    let stated = StyleSource::of(Some(name)).load(args.drawing.allow_external.as_deref())?;
    let mut overrides = look.overrides.clone();
    let background = look.background.as_ref();
    overrides.extend(background.map(|background| format!("background={background}")));
    Sheet::new(name, stated, &overrides)
        .map_err(|error| Fault::new(Exit::Usage, format!("--set: {error}")))
}

impl Desk {
    /// A desk with a painter that has opened the scene of a command line. `wake` is called when there are news. Files
    /// that are taken away go into the current folder.
    fn new(said: &Said<ViewArguments>, wake: Box<dyn Fn() + Send>) -> Result<Self, Fault> {
        Self::beside(Path::new("."), said, wake)
    }

    /// The same with a folder that files go into.
    fn beside(
        folder: &Path,
        said: &Said<ViewArguments>,
        wake: Box<dyn Fn() + Send>,
    ) -> Result<Self, Fault> {
        let (asks, of_desk) = channel();
        let (to_desk, news) = channel();
        let ends = Ends::default();
        let taken = (folder.to_owned(), ends.clone());
        let painter = Painter::new(said.args.clone(), of_desk, to_desk, wake, taken);
        let painter = thread::Builder::new()
            .name("painter".to_owned())
            .spawn(move || painter.work())?;
        Ok(Self {
            said: said.clone(),
            scene: said.args.scene.clone(),
            opened: 0,
            asks,
            news,
            own: Vec::new(),
            has_ended: false,
            folder: folder.to_owned(),
            ends,
            is_filming: false,
            painter: Some(painter),
        })
    }

    /// The words of a command line that draws the picture of an order.
    fn words(&self, order: &Order) -> Vec<String> {
        self.words_of("render", order)
    }

    /// The words of a command line that draws a film.
    fn film_words(&self, film: &Film, order: &Order) -> Vec<String> {
        let stem = self.scene.file_stem().unwrap_or_default();
        let mut words = self.words_of("animate", order);
        words.extend(film.options());
        let name = format!("{}{}", stem.to_string_lossy(), film.form.ending());
        words.extend(["-o".to_owned(), name]);
        words
    }

    /// The words of a command that draws what an order says.
    fn words_of(&self, command: &str, order: &Order) -> Vec<String> {
        let scene = self.scene.to_string_lossy().into_owned();
        let mut words = ["npr", command].map(str::to_owned).to_vec();
        words.push(scene);
        words.extend(order.options());
        let is_placed = order.viewpoint.is_some();
        for (id, said) in &self.said.options {
            let is_own = OWN_OPTIONS.contains(&id.as_str());
            let is_replaced = is_placed && CAMERA_OPTIONS.contains(&id.as_str());
            if !is_own && !is_replaced {
                words.extend_from_slice(said);
            }
        }
        words
    }

    fn ask(&mut self, ask: Ask) {
        // A painter that has ended is told of with the news.
        let _ = self.asks.send(ask);
    }
}

impl Host for Desk {
    fn style(&mut self, name: &str) -> Result<Stated, String> {
        let external = self.said.args.drawing.allow_external.as_deref();
        StyleSource::of(Some(name))
            .load(external)
            .map_err(|fault| fault.message)
    }

    fn kind(&self, path: &str) -> FileKind {
        let path = Path::new(path);
        let pictures = ["png", "jpg", "jpeg"];
        let is_picture = pictures.iter().any(|ending| has_ending(path, ending));
        if has_ending(path, "toml") {
            FileKind::Style
        } else if has_volume_name(path) {
            FileKind::Volume
        } else if is_picture {
            FileKind::Picture
        } else {
            FileKind::Scene
        }
    }

    fn smokes(&self) -> Vec<String> {
        let names = npr_smoke::Source::ALL.iter();
        names.map(|source| source.name().to_owned()).collect()
    }

    fn layers(&self) -> Vec<Layer> {
        let named = |(name, text)| Layer { name, text };
        DebugLayer::all().map(named).collect()
    }

    fn open(&mut self, path: &str) {
        self.ask(Ask::Open(PathBuf::from(path)));
    }

    fn draw(&mut self, order: Order) {
        self.ask(Ask::Draw(order, self.opened));
        self.ends.picture.raise();
    }

    fn draw_aside(&mut self, order: Order) {
        self.ask(Ask::Aside(order, self.opened));
    }

    fn point_at(&mut self, question: Question) {
        self.ask(Ask::PointAt(question));
    }

    fn news(&mut self) -> Vec<News> {
        let mut all = std::mem::take(&mut self.own);
        loop {
            match self.news.try_recv() {
                Ok(News::Scene(path, cast)) => {
                    self.scene = PathBuf::from(&path);
                    self.opened += 1;
                    all.push(News::Scene(path, cast));
                }
                Ok(news) => {
                    self.is_filming &= news != News::Film(None);
                    all.push(news);
                }
                Err(TryRecvError::Empty) => return all,
                Err(TryRecvError::Disconnected) => {
                    if !self.has_ended {
                        let text = "drawing has stopped for good: save the style and start again";
                        all.push(News::Fault(text.to_owned()));
                        self.has_ended = true;
                    }
                    return all;
                }
            }
        }
    }

    fn command(&self, order: &Order) -> String {
        shell_line(&self.words(order))
    }

    fn save(&mut self, take: Take, sheet: &Sheet, order: &Order) {
        match take {
            Take::Style => {
                let saved = save::style(&self.folder, &self.scene, sheet);
                self.own.push(match saved {
                    Ok(path) => News::Done(format!("{} holds the style", quoted(&path))),
                    Err(fault) => News::Fault(fault.message),
                });
            }
            Take::Png | Take::Svg | Take::Json => self.ask(Ask::Save(take, order.clone())),
        }
    }

    fn save_pose(&mut self, pose: &Pose) -> Result<String, String> {
        let path = save::pose(&self.folder, &self.scene, &self.said.args, pose);
        let path = path.map_err(|fault| fault.message)?;
        Ok(path.to_string_lossy().into_owned())
    }

    fn film_command(&self, film: &Film, order: &Order) -> String {
        shell_line(&self.film_words(film, order))
    }

    fn film(&mut self, film: &Film, order: &Order) {
        self.ends.film.lower();
        self.is_filming = true;
        self.ask(Ask::Film(*film, order.clone()));
    }

    fn cancel(&mut self) {
        self.ends.film.raise();
    }
}

impl Drop for Desk {
    /// Ends a film that is drawn, so that no half of it stays.
    fn drop(&mut self) {
        if self.is_filming {
            self.cancel();
            self.ask(Ask::End);
            // What it has to say of its end concerns nobody any more.
            let _ = self.painter.take().map(JoinHandle::join);
        }
    }
}

#[cfg(test)]
mod tests;
