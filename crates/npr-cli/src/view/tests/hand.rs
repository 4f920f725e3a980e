//! How fast the picture follows the hand: drafts a second while something is dragged, and how soon it is full again.

use super::*;
use egui::accesskit::Role;
use egui::{Event, Modifiers, PointerButton, Pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;

/// Width and height of the window in points, as it opens.
const WINDOW: [f32; 2] = [1280.0, 800.0];

/// Time between two frames of the window.
const FRAME: Duration = Duration::from_micros(16_667);

/// How long something is dragged.
const DRAGGED: Duration = Duration::from_millis(2500);

/// From letting go until something is dragged again, while the full picture is drawn: it is begun after 0.2 s.
const PAUSE: Duration = Duration::from_millis(300);

/// How often every drag is measured.
const TIMES: usize = 5;

/// Names of the paths of scenes in the environment, between colons.
const SCENES: &str = "NPR_VIEW_SCENES";

/// What is dragged.
#[derive(Debug, Clone, Copy)]
enum Held {
    /// The slider of a key.
    Slider(&'static str),
    /// The number of a key.
    Number(&'static str),
    /// The picture, which turns.
    Picture,
}

/// What a drag gave.
#[derive(Debug, Clone, Copy)]
struct Measured {
    /// Drafts a second.
    drafts: f64,
    /// Width and height of the last one.
    size: [u32; 2],
    /// Seconds from when the hand let go to the full picture.
    full_s: f64,
    /// Seconds to the first draft of a drag that begins while the full picture is drawn.
    first_s: f64,
}

/// A window without a screen, whose clock is that of the wall.
struct Hand {
    harness: Harness<'static, Studio>,
    start: Instant,
    frames: u32,
    place: Pos2,
}

impl Hand {
    /// A window that shows a scene, once the picture is full.
    fn new(scene: &Path) -> Self {
        let words = ["npr", "view", "--backend", "cpu"].map(std::ffi::OsString::from);
        let words = words.into_iter().chain([scene.as_os_str().to_owned()]);
        let parsed = Arguments::try_parse_from(words).expect("a right line");
        let Command::View(said) = parsed.command else {
            panic!("another command");
        };
        let studio = studio(&said.0, Box::new(|| {})).expect("a studio");
        let harness = Harness::builder()
            .with_size(vec2(WINDOW[0], WINDOW[1]))
            .build_ui_state(|ui, studio: &mut Studio| studio.show(ui), studio);
        let mut hand = Self {
            harness,
            start: Instant::now(),
            frames: 0,
            place: Pos2::new(400.0, 400.0),
        };
        hand.settle();
        hand
    }

    /// Shows the next frame of the window when it is time for it, or at once where it is late.
    fn show(&mut self) {
        self.frames += 1;
        thread::sleep((FRAME * self.frames).saturating_sub(self.start.elapsed()));
        self.frames = (self.start.elapsed().as_micros() / FRAME.as_micros()) as u32;
        self.harness.input_mut().time = Some(self.start.elapsed().as_secs_f64());
        self.harness.step();
    }

    fn full_is_shown(&self) -> bool {
        let studio = self.harness.state();
        let picture = studio.picture().map(|picture| &picture.order);
        picture == Some(&studio.order())
    }

    /// Shows frames until the picture is the full one, and gives the seconds.
    fn settle(&mut self) -> f64 {
        let start = Instant::now();
        self.show();
        while !self.full_is_shown() {
            assert!(start.elapsed() < Duration::from_secs(120), "no picture");
            self.show();
        }
        start.elapsed().as_secs_f64()
    }

    fn press(&mut self, pressed: bool) {
        let pos = self.place;
        self.harness.event(Event::PointerMoved(pos));
        self.harness.event(Event::PointerButton {
            pos,
            button: PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        });
    }

    /// Takes hold of something, moves it to and fro, and lets go.
    fn drag(&mut self, held: Held) -> Measured {
        // Put the pointer on it.
        let (key, role) = match held {
            Held::Slider(key) => (key, Role::Slider),
            Held::Number(key) => (key, Role::SpinButton),
            Held::Picture => ("", Role::Unknown),
        };
        self.harness.state_mut().search(key);
        for _ in 0..20 {
            self.show();
        }
        self.place = match held {
            Held::Picture => Pos2::new(400.0, 400.0),
            _ => {
                let control = self.harness.get_by_role_and_label(role, key);
                control.rect().center()
            }
        };
        self.press(true);
        self.show();

        // Move it, and count the drafts that are shown.
        let start = Instant::now();
        let (mut shown, mut count, mut size) = (0, 0_u32, [0; 2]);
        let from = self.place;
        while start.elapsed() < DRAGGED {
            let way = start.elapsed().as_secs_f32() * 3.0;
            self.place = from + vec2(30.0 * npr_core::math::sin(way), 0.0);
            self.harness.event(Event::PointerMoved(self.place));
            self.show();
            let picture = self.harness.state().picture().expect("a picture");
            if picture.order.is_draft && picture.order.change != shown {
                (shown, size) = (picture.order.change, picture.order.size);
                count += 1;
            }
        }
        let drafts = f64::from(count) / start.elapsed().as_secs_f64();

        // Let go.
        self.press(false);
        Measured {
            drafts,
            size,
            full_s: self.settle(),
            first_s: self.catch(from),
        }
    }

    /// Moves what was dragged, lets go, and drags it on while the full picture is drawn: gives the seconds to the first
    /// draft.
    fn catch(&mut self, from: Pos2) -> f64 {
        // Let the full picture begin.
        self.place = from;
        self.press(true);
        self.move_by(30.0);
        self.press(false);
        let let_go = Instant::now();
        while let_go.elapsed() < PAUSE {
            self.show();
        }

        // Drag on.
        self.place = from;
        self.press(true);
        let before = self.harness.state().order().change;
        let caught = Instant::now();
        self.move_by(-30.0);
        let change = |hand: &Self| hand.harness.state().order().change;
        assert_ne!(change(self), before, "nothing was dragged");
        let is_shown = |hand: &Self| {
            let shown = hand.harness.state().picture();
            shown.is_some_and(|picture| picture.order.change > before)
        };
        while !is_shown(self) {
            self.show();
        }
        let first_s = caught.elapsed().as_secs_f64();
        self.press(false);
        self.settle();
        first_s
    }

    /// Moves the pointer to a side in two steps: the first is the one that makes a press a drag.
    fn move_by(&mut self, way: f32) {
        for _ in 0..2 {
            self.place += vec2(0.5 * way, 0.0);
            self.harness.event(Event::PointerMoved(self.place));
            self.show();
        }
    }
}

/// The median of some values.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Measures all of it: `cargo xtask measure view` keeps the table.
#[test]
#[ignore = "it measures, in release"]
fn measured() {
    let scenes = std::env::var_os(SCENES).unwrap_or_else(|| "../../assets/still_life.glb".into());
    let what = [
        Held::Number("line.width.base"),
        Held::Slider("line.width.max"),
        Held::Slider("shade.saturation"),
        Held::Picture,
    ];
    let threads = thread::available_parallelism().map_or(1, usize::from);
    println!("# The window\n");
    println!(
        "- {threads} threads, no graphics device; window of {} x {} points",
        WINDOW[0], WINDOW[1]
    );
    println!(
        "- preset toon; {TIMES} drags of {} s each: the median, and the best",
        DRAGGED.as_secs_f32()
    );
    println!("- drafts a second: pictures that follow the hand while it drags");
    println!("- full after: from letting go to the full picture, 0.2 s of which nothing is drawn");
    println!(
        "- first draft after: from the first move of a drag that begins while the full picture is drawn\n"
    );
    println!(
        "| scene | dragged | drafts a second | the best | of pixels | full after, s | the best | first draft after, s |"
    );
    println!("|---|---|---:|---:|---:|---:|---:|---:|");
    for scene in std::env::split_paths(&scenes) {
        let name = scene.file_stem().unwrap_or_default().to_string_lossy();
        let mut hand = Hand::new(&scene);
        for held in what {
            let measured: Vec<Measured> = (0..TIMES).map(|_| hand.drag(held)).collect();
            let drafts: Vec<f64> = measured.iter().map(|one| one.drafts).collect();
            let full: Vec<f64> = measured.iter().map(|one| one.full_s).collect();
            let first = measured.iter().map(|one| one.first_s).collect();
            let [width, height] = measured[TIMES - 1].size;
            let best = drafts.iter().copied().fold(0.0, f64::max);
            let soonest = full.iter().copied().fold(f64::MAX, f64::min);
            let what = match held {
                Held::Slider(key) | Held::Number(key) => format!("`{key}`"),
                Held::Picture => "the picture, turned".to_owned(),
            };
            println!(
                "| {name} | {what} | {:.1} | {best:.1} | {width}x{height} | {:.2} | {soonest:.2} | {:.2} |",
                median(drafts),
                median(full),
                median(first),
            );
        }
    }
}
