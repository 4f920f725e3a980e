//! A window that is used for long: its size, style, scene, camera and time change at random, and files break.

use super::*;
use egui::{Event, Key, Modifiers, PointerButton, Pos2, RawInput, Rect, vec2};
use npr_mesh::testing::Random;
use npr_scene::testing::{Vrm, avatar, wing};
use std::sync::Arc as Shared;
use std::time::SystemTime;

/// Frames between two looks at how things are.
const ROUND: usize = 50;

/// Frames in which the steps that can be undone, of which a window keeps 200, become as many as they may be.
const WARM: usize = 2000;

/// What lets the allocator of Linux give back blocks of 128 KiB and more as soon as they are freed. Of its own accord
/// it keeps them once it has seen some larger ones, so that what the system counts goes up and down by a fifth.
const FRUGAL: [(&str, &str); 2] = [
    ("MALLOC_MMAP_THRESHOLD_", "131072"),
    ("MALLOC_TRIM_THRESHOLD_", "131072"),
];

/// Width in points from which a window has a panel beside the picture, and more than that takes.
const PANELLED: f32 = 360.0;

/// A file in the hand.
#[derive(Debug)]
struct Held(PathBuf);

impl egui::DroppedFile for Held {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        Err("nobody reads it".to_owned())
    }
}

/// A window without a screen.
struct Pane {
    ctx: egui::Context,
    studio: Studio,
    folder: TempDir,
    time_s: f64,
    size: [f32; 2],
    random: Random,
}

impl Pane {
    fn new(seed: u64) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let scene = folder.path().join("box.obj");
        write(&scene, OBJ);
        let words = ["npr", "view", "--backend", "cpu", "--style", "ink"].map(Into::into);
        let words = words.into_iter().chain([scene.into_os_string()]);
        let parsed = Arguments::try_parse_from(words).expect("a right line");
        let Command::View(said) = parsed.command else {
            panic!("another command");
        };
        Self {
            ctx: egui::Context::default(),
            studio: studio(&said.0, Box::new(|| {})).expect("a studio"),
            folder,
            time_s: 0.0,
            size: [700.0, 500.0],
            random: Random::new(seed),
        }
    }

    /// Shows a frame of the window, a sixtieth of a second after the one before, in which this happens.
    fn show(&mut self, events: Vec<Event>, dropped: &[PathBuf]) {
        self.time_s += 1.0 / 60.0;
        let held = |path: &PathBuf| Shared::new(Held(path.clone())) as egui::DroppedFileHandle;
        let [width, height] = self.size;
        let input = RawInput {
            screen_rect: Some(Rect::from_min_size(Pos2::ZERO, vec2(width, height))),
            max_texture_side: Some(8192),
            time: Some(self.time_s),
            events,
            dropped_files: dropped.iter().map(held).collect(),
            ..RawInput::default()
        };
        let mut shown = self.ctx.run_ui(input, |ui| self.studio.show(ui));
        // Nobody uploads its textures.
        shown.textures_delta.clear();
        let told = self.studio.told().unwrap_or("broken");
        assert!(told.contains("broken"), "{told}");
    }

    /// Shows frames until the picture is the full one of what is asked for.
    fn settle(&mut self) {
        let start = Instant::now();
        let is_whole = |studio: &Studio| {
            let picture = studio.picture().map(|picture| &picture.order);
            picture == Some(&studio.order())
        };
        self.show(Vec::new(), &[]);
        while !is_whole(&self.studio) {
            let told = self.studio.told();
            assert!(start.elapsed() < Duration::from_secs(120), "{told:?}");
            thread::sleep(Duration::from_millis(2));
            self.show(Vec::new(), &[]);
        }
    }

    /// Writes a file of the folder, and drops it on the window.
    fn drop_file(&mut self, name: &str, bytes: &[u8]) {
        let path = self.folder.path().join(name);
        put(&path, bytes);
        self.show(Vec::new(), &[path]);
    }

    /// A side of a window from 1 to about 1500 points, small ones as often as large ones.
    fn side(&mut self) -> f32 {
        npr_core::math::exp(self.random.unit() * 7.3).round()
    }

    fn press(&mut self, modifiers: Modifiers, key: Key) {
        let event = |pressed| Event::Key {
            key,
            physical_key: None,
            pressed,
            repeat: false,
            modifiers,
        };
        self.show(vec![event(true), event(false)], &[]);
    }

    fn drag(&mut self) {
        // Stay on the picture: the border of the panel would go with the pointer.
        let room = match self.size[0] > PANELLED {
            true => self.size[0] - PANELLED,
            false => self.size[0],
        };
        let size = [room.min(self.size[0] * 0.5), self.size[1] * 0.8];
        let place =
            |random: &mut Random| Pos2::new(random.unit() * size[0], random.unit() * size[1]);
        let button = |pos, pressed| Event::PointerButton {
            pos,
            button: PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        };
        let from = place(&mut self.random);
        let to = place(&mut self.random);
        self.show(vec![Event::PointerMoved(from), button(from, true)], &[]);
        self.show(vec![Event::PointerMoved(to)], &[]);
        self.show(vec![button(to, false), Event::PointerGone], &[]);
    }

    /// Does anything that a user may do.
    fn act(&mut self) {
        match self.random.below(21) {
            0..=6 => {
                self.size = match self.random.below(40) {
                    0 => [1.0, 1.0],
                    1 => [7680.0, 4320.0],
                    _ => [self.side(), self.side()],
                };
                self.show(Vec::new(), &[]);
            }
            7..=9 => {
                let presets = ["ink", "toon", "brush", "screentone"];
                let preset = presets[self.random.below(presets.len())];
                let (opacity, light) = (self.random.unit(), self.random.unit());
                let text = format!(
                    "extends = \"{preset}\"\nline.opacity = {opacity}\nshade.saturation = {light}\n"
                );
                self.drop_file("own.toml", text.as_bytes());
            }
            10 => {
                let texts = [
                    "line.colour = 3",
                    "extends = \"broken",
                    "[line]\nopacity = 7\n",
                    "\u{0}",
                ];
                let text = texts[self.random.below(texts.len())];
                self.drop_file("broken.toml", text.as_bytes());
            }
            11 => {
                let high = 1 + self.random.below(4);
                let text = OBJ.replace("1 1 1", &format!("1 {high} 1"));
                self.drop_file("box.obj", text.as_bytes());
            }
            12 => self.drop_file("wing.glb", &wing()),
            13 => self.drop_file("one.vrm", &avatar(Vrm::One)),
            14 => {
                let texts: [&[u8]; 3] = [b"f 1 2 3\n", b"v 0 0\n", b"\0\0\0"];
                let text = texts[self.random.below(texts.len())];
                self.drop_file("broken.obj", text);
            }
            15 => self.drag(),
            16 => {
                let keys = [
                    Key::Space,
                    Key::ArrowLeft,
                    Key::ArrowRight,
                    Key::Num5,
                    Key::Home,
                    Key::B,
                    Key::L,
                ];
                let key = keys[self.random.below(keys.len())];
                self.press(Modifiers::NONE, key);
            }
            17 => {
                let key = [Key::Z, Key::Y][self.random.below(2)];
                self.press(Modifiers::COMMAND, key);
            }
            18 => thread::sleep(Duration::from_millis(3)),
            19 => {
                let words = ["", "line.brush", "ink.hatch", "times passes"];
                let words = words[self.random.below(words.len())];
                self.studio.search(words);
                self.show(Vec::new(), &[]);
            }
            _ => self.show(Vec::new(), &[]),
        }
    }

    /// Goes back to how it all began, and gives the picture with what was asked for.
    fn rest(&mut self) -> (Order, Vec<u8>) {
        self.size = [700.0, 500.0];
        self.drop_file("rest.toml", b"extends = \"ink\"\n");
        self.drop_file("other.obj", OBJ.as_bytes());
        self.settle();
        self.drop_file("box.obj", OBJ.as_bytes());
        self.press(Modifiers::NONE, Key::Home);
        self.settle();
        assert_eq!(self.studio.told(), None);
        let picture = self.studio.picture().expect("a picture");
        let order = Order {
            change: 0,
            ..picture.order.clone()
        };
        (order, picture.rgba.clone())
    }
}

/// Bytes of this process that lie in memory, as Linux counts them; none elsewhere.
fn resident_bytes() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmRSS:"))?;
    let kibibytes: u64 = line.trim().strip_suffix(" kB")?.trim().parse().ok()?;
    Some(kibibytes * 1024)
}

/// Uses a window for so many frames, and gives the memory after each round.
fn used(frames: usize) -> Vec<u64> {
    // Another seed in every run, told where it fails.
    let named = std::env::var("PROPTEST_RNG_SEED").ok();
    let named = named.and_then(|text| text.parse().ok());
    let now = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH);
    let seed = named.unwrap_or(now.map_or(1, |now| now.as_nanos() as u64));
    println!("the seed is {seed}");
    let mut pane = Pane::new(seed);
    let first = pane.rest();
    let mut sizes = Vec::new();
    for _ in 0..frames.div_ceil(ROUND) {
        for _ in 0..ROUND {
            pane.act();
        }
        let (order, rgba) = pane.rest();
        assert_eq!(order, first.0);
        assert!(rgba == first.1);
        sizes.extend(resident_bytes());
    }
    sizes
}

#[test]
fn a_window_is_used_for_a_hundred_frames() {
    used(100);
}

/// Takes minutes: `cargo test -p npr-cli --lib -- --ignored --nocapture endurance`.
#[test]
#[ignore = "it takes minutes"]
fn a_window_that_is_used_for_long_takes_no_more_memory() {
    // Go on in a process whose allocator gives back what is freed.
    if std::env::var_os(FRUGAL[0].0).is_none() {
        let name = "view::tests::endurance::a_window_that_is_used_for_long_takes_no_more_memory";
        let program = std::env::current_exe().expect("a program");
        let status = std::process::Command::new(program)
            .args(["--ignored", "--nocapture", "--exact", name])
            .envs(FRUGAL)
            .status();
        assert!(status.expect("a process").success());
        return;
    }

    // Use a window.
    let sizes = used(WARM + 2000);
    println!("{sizes:?}");
    // Compare the least of either half of what comes then: more than that is what was freed in pieces.
    let least = |sizes: &[u64]| sizes.iter().min().copied().unwrap_or(1) as f64;
    let (sizes, half) = (&sizes[sizes.len().min(WARM / ROUND)..], 2000 / ROUND / 2);
    let [first, last] = [sizes.chunks(half).next(), sizes.rchunks(half).next()];
    let growth = last.map_or(1.0, least) / first.map_or(1.0, least) - 1.0;
    println!("{:.1} % more memory", growth * 100.0);
    assert!(growth <= 0.02, "{growth}: {sizes:?}");
}
