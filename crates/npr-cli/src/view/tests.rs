//! What the window shows is what the command draws.

use super::*;
use crate::arguments::{Arguments, Command};
use crate::encoder;
use crate::render;
use clap::Parser;
use npr_view::{Picture, Pose, Remedy, Viewpoint};
use std::path::Path;
use std::time::{Duration, Instant};
use tempfile::TempDir;

mod asides;
mod dropped;
mod endurance;
mod films;
mod hand;
mod layers;
mod moments;
mod takes;

/// A box on a plate.
const OBJ: &str = "o Box\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
                   f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

/// A folder with a scene, and a desk that shows it.
struct Shop {
    folder: TempDir,
    desk: Desk,
}

impl Shop {
    /// A desk of a command line after `npr view box.obj`.
    fn new(options: &str) -> Self {
        Self::of(&[("box.obj", OBJ.as_bytes())], options)
    }

    /// A desk of a command line that shows the first of some files; `@` in options stands for their folder.
    fn of(files: &[(&str, &[u8])], options: &str) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        for (name, bytes) in files {
            put(&folder.path().join(name), bytes);
        }
        let scene = folder.path().join(files[0].0);
        let options = options.replace('@', &folder.path().to_string_lossy());
        let mut words = vec!["npr".into(), "view".into(), scene.into_os_string()];
        words.extend(options.split_whitespace().map(Into::into));
        let parsed = Arguments::try_parse_from(words).expect("a right line");
        let Command::View(said) = parsed.command else {
            panic!("another command");
        };
        let desk = Desk::beside(folder.path(), &said.0, Box::new(|| {})).expect("a desk");
        Self { folder, desk }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// The news that `pick` takes, once there are some.
    fn wait<T>(&mut self, pick: impl Fn(News) -> Option<T>) -> T {
        let start = Instant::now();
        loop {
            if let Some(found) = self.desk.news().into_iter().find_map(&pick) {
                return found;
            }
            assert!(start.elapsed() < Duration::from_secs(60), "no news");
            thread::sleep(Duration::from_millis(5));
        }
    }

    fn picture(&mut self, order: &Order) -> Picture {
        self.desk.draw(order.clone());
        self.wait(|news| match news {
            News::Picture(picture) if picture.order == *order => Some(*picture),
            News::Fault(text) => panic!("{text}"),
            _ => None,
        })
    }

    fn fault(&mut self) -> String {
        self.wait(|news| match news {
            News::Fault(text) => Some(text),
            _ => None,
        })
    }

    /// What a command line draws into a file.
    fn drawn(&self, words: &[String]) -> Vec<u8> {
        let path = self.path("drawn.png");
        let output = ["-o".to_owned(), path.to_string_lossy().into_owned()];
        let words = words.iter().chain(&output);
        let parsed = Arguments::try_parse_from(words).expect("a right line");
        let Command::Render(args) = parsed.command else {
            panic!("another command");
        };
        render::render(&args.0).expect("a picture");
        std::fs::read(path).expect("a file")
    }
}

fn write(path: &Path, text: &str) {
    put(path, text.as_bytes());
}

fn put(path: &Path, bytes: &[u8]) {
    let output = crate::output::Output::of(path).expect("a place");
    output.write(bytes).expect("room");
}

fn order(overrides: &[&str], viewpoint: Option<Viewpoint>) -> Order {
    Order {
        change: 1,
        style: "ink".to_owned(),
        overrides: overrides.iter().map(|text| (*text).to_owned()).collect(),
        viewpoint,
        pose: Pose::default(),
        layer: None,
        swatch: None,
        size: [120, 90],
        is_draft: false,
    }
}

fn aside(is_parallel: bool) -> Viewpoint {
    Viewpoint {
        eye: [2.125, 3.1, -4.7],
        target: [0.4, 0.45, 0.55],
        up: [0.0, 1.0, 0.0],
        fov_deg: 33.3,
        is_parallel,
    }
}

#[test]
fn the_picture_is_what_the_command_and_the_saved_style_draw() {
    let mut shop = Shop::new("--backend cpu --fov 50");
    let changes = [
        "line.color=#a02010",
        "line.width.max=2.5",
        "shade.paper=#ccddee",
    ];
    let cases = [None, Some(aside(false)), Some(aside(true))];
    let mut pictures = Vec::new();
    for (number, viewpoint) in cases.into_iter().enumerate() {
        // Draw it in the window, after a draft in another style.
        let mut order = order(&changes, viewpoint);
        let draft = Order {
            is_draft: true,
            overrides: Vec::new(),
            size: [40, 30],
            ..order.clone()
        };
        shop.picture(&draft);
        let picture = shop.picture(&order);
        let png = encoder::png(order.size, &picture.rgba, false).expect("a file");

        // Draw it by the command line.
        let words = shop.desk.words(&order);
        assert!(shop.drawn(&words) == png, "{}", words.join(" "));

        // Draw it by the saved style.
        let base = shop.desk.style("ink").expect("a preset");
        let sheet = Sheet::new("ink", base, &order.overrides).expect("a style");
        let file = shop.path(&format!("style{number}.toml"));
        write(&file, &sheet.file());
        order.style = file.to_string_lossy().into_owned();
        order.overrides.clear();
        assert!(
            shop.drawn(&shop.desk.words(&order)) == png,
            "{}",
            sheet.file()
        );
        pictures.push(png);
    }
    assert!(pictures[0] != pictures[1] && pictures[1] != pictures[2]);
}

#[test]
fn a_camera_turns_round_smoke() {
    let ball = npr_vdb::testing::Sample::ball(4).bytes();
    let mut shop = Shop::of(&[("ball.vdb", &ball)], "--backend cpu");
    let toon = |viewpoint| Order {
        style: "toon".to_owned(),
        ..order(&[], viewpoint)
    };
    let front = shop.picture(&toon(None)).viewpoint;
    let [x, y, z] = [0, 1, 2].map(|i| front.eye[i] - front.target[i]);
    let beside = [z, y, -x];
    let aside = Viewpoint {
        eye: [0, 1, 2].map(|i| front.target[i] + beside[i]),
        ..front
    };
    let pictures = [front, aside].map(|viewpoint| {
        let order = toon(Some(viewpoint));
        let picture = shop.picture(&order);
        let png = encoder::png(order.size, &picture.rgba, false).expect("a file");
        let words = shop.desk.words(&order);
        assert!(shop.drawn(&words) == png, "{}", words.join(" "));
        let mut tones: Vec<&[u8]> = picture.rgba.chunks_exact(4).collect();
        tones.sort_unstable();
        tones.dedup();
        assert!(tones.len() > 2, "{} tones", tones.len());
        png
    });
    assert!(pictures[0] != pictures[1]);
}

#[test]
fn faults_are_told_and_the_picture_before_can_be_drawn_again() {
    let mut shop = Shop::new("--backend cpu");
    let good = order(&[], None);
    let before = shop.picture(&good);
    shop.desk.draw(order(&["background=none.png"], None));
    assert!(shop.fault().contains("none.png"));
    shop.desk.open("no/where.glb");
    assert!(shop.fault().contains("where.glb"));
    write(&shop.path("broken.obj"), "f 1 2 3\n");
    let broken = shop.path("broken.obj").to_string_lossy().into_owned();
    shop.desk.open(&broken);
    assert!(shop.fault().contains("broken.obj"));
    assert!(
        shop.desk
            .style("inky")
            .expect_err("no preset")
            .contains("inky")
    );
    let again = shop.picture(&Order { change: 2, ..good });
    assert!(again.rgba == before.rgba);
}

#[test]
fn files_that_change_are_read_anew() {
    // Change the scene.
    let mut shop = Shop::new("--backend cpu --view front --ortho");
    let first = shop.picture(&order(&[], None));
    write(&shop.path("box.obj"), &OBJ.replace("1 1 1", "1 3 1"));
    let scene = shop.wait(|news| match news {
        News::Scene(path, _) => Some(path),
        _ => None,
    });
    assert!(scene.ends_with("box.obj"));
    let second = shop.picture(&Order {
        change: 2,
        ..order(&[], None)
    });
    assert!(first.rgba != second.rgba);

    // Change the style.
    let file = shop.path("my.toml");
    write(&file, "extends = \"ink\"\n");
    let style = file.to_string_lossy().into_owned();
    let of_file = Order {
        style,
        change: 3,
        ..order(&[], None)
    };
    assert!(shop.picture(&of_file).rgba == second.rgba);
    write(&file, "extends = \"ink\"\nline.color = \"#f00\"\n");
    shop.wait(|news| (news == News::StyleChanged).then_some(()));
    let third = shop.picture(&Order {
        change: 4,
        ..of_file.clone()
    });
    assert!(third.rgba != second.rgba);

    // Change the parent of the style's parent.
    write(&shop.path("base.toml"), "extends = \"ink\"\n");
    write(&shop.path("middle.toml"), "extends = \"base.toml\"\n");
    write(&file, "extends = \"middle.toml\"\n");
    shop.wait(|news| (news == News::StyleChanged).then_some(()));
    let fourth = shop.picture(&Order {
        change: 5,
        ..of_file.clone()
    });
    assert!(fourth.rgba == second.rgba);
    let base = shop.path("base.toml");
    write(&base, "extends = \"ink\"\nline.color = \"#f00\"\n");
    shop.wait(|news| (news == News::StyleChanged).then_some(()));
    let fifth = shop.picture(&Order {
        change: 6,
        ..of_file
    });
    assert!(fifth.rgba == third.rgba);
}

#[test]
fn a_picture_of_one_pixel_is_drawn() {
    let mut shop = Shop::new("--backend cpu");
    let picture = shop.picture(&Order {
        size: [1, 1],
        ..order(&[], None)
    });
    assert_eq!(picture.rgba.len(), 4);
}

#[test]
fn a_command_line_says_again_what_the_user_said() {
    let shop =
        Shop::new("--backend cpu --eye 1,2,3 --seed 4 --quiet --style toon --set line.opacity=1");
    let words = |viewpoint| {
        let words = shop.desk.words(&order(&["line.color=#fff"], viewpoint));
        words[3..].join(" ")
    };
    assert_eq!(
        words(None),
        "--style ink --set line.color=#fff --size 120x90 --eye=1,2,3 --seed=4 --backend=cpu"
    );
    assert!(!words(Some(aside(false))).contains("--eye=1,2,3"));
}

#[test]
fn a_studio_starts_with_the_style_that_is_asked_for() {
    let of = |options: &str| {
        let line = format!("npr view a.glb --backend cpu {options}");
        let parsed = Arguments::try_parse_from(line.split_whitespace()).expect("a right line");
        let Command::View(said) = parsed.command else {
            panic!("another command");
        };
        check(&said.0.args)?;
        studio(&said.0, Box::new(|| {}))
    };
    let studio = of("--style ink --set line.opacity=0.5 --background #abc --size 64x48");
    let order = studio.expect("a studio").order();
    assert_eq!((order.style.as_str(), order.size), ("ink", [64, 48]));
    assert_eq!(order.overrides, ["line.opacity=0.5", "background=#aabbcc"]);
    assert_eq!(of("").expect("a studio").order().style, DEFAULT_PRESET);
    assert!(of("--style no/where.toml").is_err());
    assert_eq!(
        of("--set line.opacity=7")
            .map(|_| ())
            .map_err(|fault| fault.exit),
        Err(Exit::Usage)
    );
}

#[test]
fn the_view_turns_about_the_middle_of_the_scene() {
    let mut shop = Shop::new("--backend cpu");
    let framed = shop.picture(&order(&[], None));
    let target = framed.viewpoint.target;
    assert!(
        target.iter().all(|place| (place - 0.5).abs() < 0.2),
        "{target:?}"
    );
    let placed = Order {
        change: 2,
        ..order(&[], Some(framed.viewpoint))
    };
    let differing = shop
        .picture(&placed)
        .rgba
        .iter()
        .zip(&framed.rgba)
        .filter(|(a, b)| a != b)
        .count();
    assert!(differing < framed.rgba.len() / 100, "{differing}");
}

#[test]
fn a_line_that_is_pointed_at_says_what_would_remove_it() {
    // Point at the front upper edge of the box, in the middle of the picture as seen from the front.
    let mut shop = Shop::new("--backend cpu --view front --ortho");
    let order = order(&["line.least=0", "line.crease_least=0"], None);
    let picture = shop.picture(&order);
    let red = |y: &u32| picture.rgba[(y * picture.order.size[0] + 60) as usize * 4];
    let top = (0..45).min_by_key(red).expect("rows");
    assert!(red(&top) < 200, "no outline above the middle");
    let question = |place: [f32; 2]| Question {
        order: order.clone(),
        place,
        reach_px: 4.0,
    };
    let mut ask = |question| {
        shop.desk.point_at(question);
        shop.wait(|news| match news {
            News::Pointed(answer) => Some(*answer),
            News::Fault(text) => panic!("{text}"),
            _ => None,
        })
    };
    let line = ask(question([60.5, top as f32 + 0.5]))
        .line
        .expect("a line");
    let rows = line
        .points
        .iter()
        .map(|[_, y]| (y * 90.0 - top as f32 - 0.5).abs());
    assert!(rows.fold(f32::INFINITY, f32::min) < 2.0, "{line:?}");
    assert_eq!(line.part.object, "Box");
    assert_eq!(line.removal, Remedy::Key("line.kinds.contour".to_owned()));
    assert!(
        line.facts
            .iter()
            .any(|fact| fact.key.as_deref() == Some("line.width.base"))
    );

    // In the middle there is the part alone, in the corner nothing.
    let inside = ask(question([60.0, 45.0]));
    assert!(inside.line.is_none() && inside.part.expect("a part").object == "Box");
    let beside = ask(question([2.0, 2.0]));
    assert_eq!(
        (beside.line, beside.part, beside.notice),
        (None, None, None)
    );
}

#[test]
fn what_was_found_for_one_style_is_drawn_in_the_next_as_the_command_draws_it() {
    let mut shop = Shop::new("--backend cpu");
    let cases: [&[&str]; 9] = [
        &[],
        &["line.width.base=6"],
        &["line.width.base=6", "shade.saturation=0.4"],
        &["line.crease_angle_deg=100"],
        &["line.kinds.crease=false"],
        &[
            "line.paint.source=surface",
            "line.paint.light.width=[1.0, 0.4]",
        ],
        &["line.cards=centre"],
        &["line.method=shape"],
        &["shade.calm=0.2", "line.split_angle_deg=60"],
    ];
    for viewpoint in [None, Some(aside(false))] {
        for changes in cases {
            let full = order(changes, viewpoint);
            let draft = Order {
                size: [60, 45],
                is_draft: true,
                ..full.clone()
            };
            assert_eq!(shop.picture(&draft).rgba.len(), 60 * 45 * 4);
            let shown = shop.picture(&full);
            let bytes = shop.drawn(&shop.desk.words(&full));
            let drawn = encoder::png(full.size, &shown.rgba, false).expect("a picture");
            assert!(drawn == bytes, "{changes:?}");
        }
    }
}

/// Share of a picture that is dark.
fn ink_of(picture: &Picture) -> f64 {
    let pixels = picture.rgba.chunks_exact(4);
    let dark = pixels.filter(|pixel| pixel[1] < 100).count();
    dark as f64 / f64::from(picture.order.size[0] * picture.order.size[1])
}

#[test]
fn a_draft_has_the_strokes_of_the_full_picture_before() {
    let mut shop = Shop::new("--backend cpu");
    let full = Order {
        style: "toon".to_owned(),
        ..order(&["line.width.base=6px"], Some(aside(false)))
    };
    let draft = Order {
        size: [60, 45],
        is_draft: true,
        ..full.clone()
    };
    let own = ink_of(&shop.picture(&draft));
    let whole = ink_of(&shop.picture(&full));
    let scaled = ink_of(&shop.picture(&draft));
    assert!((scaled / whole - 1.0).abs() < 0.25, "{scaled} of {whole}");
    assert!(own > 1.4 * whole, "{own} of {whole}");
}

#[test]
fn a_draft_is_framed_as_the_full_picture_whatever_its_sides_are_rounded_to() {
    let mut shop = Shop::new("--backend cpu");
    let full = Order {
        size: [301, 200],
        ..order(&[], None)
    };
    let whole = shop.picture(&full).viewpoint;
    for size in [[75, 50], [38, 25], [150, 100]] {
        let draft = Order {
            size,
            is_draft: true,
            ..order(&["line.width.base=6"], None)
        };
        assert_eq!(shop.picture(&draft).viewpoint, whole, "{size:?}");
    }
}
