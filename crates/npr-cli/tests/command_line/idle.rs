//! Keys and options that cannot act are told, once and by name.

use crate::trace::encoded;
use crate::workplace::Workplace;
use clap::Command;
use image::{ImageFormat, Rgb, RgbImage};

/// What an option does beside others.
enum Does {
    /// The file differs.
    Acts,
    /// A warning with this text; the file is the same.
    Told(&'static str),
}
use Does::{Acts, Told};

/// A command line without and with an option, and what that does; `FILE` stands for the output.
type Case = (&'static [&'static str], &'static [&'static str], Does);

const SMALL: [&str; 4] = ["--size", "96x64", "--backend", "cpu"];

const DRAWINGS: &[Case] = &[
    (
        &["render", "scene.obj", "-o", "a.png"],
        &["--enlarge", "2"],
        Acts,
    ),
    (
        &["render", "scene.obj", "-o", "a.svg", "--style", "blueprint"],
        &["--enlarge", "2"],
        Told("--enlarge is ignored: .svg files have no pixels"),
    ),
    (
        &["render", "scene.obj", "-o", "a.png"],
        &["--debug-layer", "stroke"],
        Acts,
    ),
    (
        &["lines", "scene.obj", "-o", "a.svg"],
        &["--crease", "100"],
        Acts,
    ),
    (
        &["lines", "scene.obj", "-o", "a.svg", "--method", "surface"],
        &["--crease", "100"],
        Acts,
    ),
    (
        &["lines", "scene.obj", "-o", "a.svg", "--method", "potrace"],
        &["--crease", "100"],
        Acts,
    ),
    (
        // Without it the folds of the box are creases by both.
        &["lines", "scene.obj", "-o", "a.svg", "--set", NORMALS_ALONE],
        &["--crease-from", "faces"],
        Acts,
    ),
    (
        &["lines", "scene.obj", "-o", "a.svg"],
        &["--split", "30"],
        Acts,
    ),
    (
        &["lines", "scene.obj", "-o", "a.svg"],
        &["--hidden", "dashed"],
        Acts,
    ),
    (
        &["lines", "scene.obj", "-o", "a.png"],
        &["--hidden", "dashed"],
        Acts,
    ),
    (
        &["lines", "scene.obj", "-o", "a.json"],
        &["--hidden", "layer"],
        Acts,
    ),
    (
        &["lines", "scene.obj", "-o", "a.json", "--hidden", "layer"],
        &["--hidden", "dashed"],
        Told("--hidden is ignored: "),
    ),
    (
        &["lines", "scene.obj", "-o", "a.svg"],
        &["--kinds", "contour"],
        Acts,
    ),
    (&["lines", "scene.obj", "-o", "a.svg"], &["--fill"], Acts),
    (
        &["lines", "scene.obj", "-o", "a.png", "--background", "#f00"],
        &["--fill"],
        Acts,
    ),
    (
        &["lines", "scene.obj", "-o", "a.json"],
        &["--fill"],
        Told("--fill is ignored: "),
    ),
    (
        &["lines", "scene.obj", "-o", "a.svg", "--svg", "centreline"],
        &["--fill"],
        Acts,
    ),
    (
        &["lines", "scene.obj", "-o", "a.svg", "--svg", "centreline"],
        &["--background", "#f00"],
        Told("--background is ignored: "),
    ),
    (
        &["lines", "scene.obj", "-o", "a.json"],
        &["--svg", "centreline"],
        Told("--svg is ignored: "),
    ),
    (
        &[
            "lines",
            "scene.obj",
            "-o",
            "a.svg",
            "--set",
            "line.brush.tip=charcoal",
        ],
        &["--svg", "stamps"],
        Acts,
    ),
    (
        &[
            "lines",
            "scene.obj",
            "-o",
            "a.pdf",
            "--set",
            "line.brush.tip=charcoal",
        ],
        &["--svg", "stamps"],
        Acts,
    ),
    (
        &[
            "lines",
            "scene.obj",
            "-o",
            "a.png",
            "--set",
            "line.brush.tip=charcoal",
        ],
        &["--svg", "stamps"],
        Acts,
    ),
    (
        &[
            "lines",
            "scene.obj",
            "-o",
            "a.json",
            "--set",
            "line.brush.tip=charcoal",
        ],
        &["--svg", "stamps"],
        Told("--svg is ignored: "),
    ),
    (
        &["lines", "scene.obj", "-o", "a.svg"],
        &["--svg", "stamps"],
        Told("--svg is ignored: "),
    ),
    (
        &["lines", "scene.obj", "-o", "a.svg"],
        &["--svg", "centreline"],
        Acts,
    ),
    (
        &["lines", "scene.obj", "-o", "a.png"],
        &["--svg", "centreline"],
        Acts,
    ),
    (
        &["lines", "scene.obj", "-o", "a.pdf"],
        &["--page", "A4"],
        Acts,
    ),
    (
        &["lines", "scene.obj", "-o", "a.svg"],
        &["--background", "#f00"],
        Acts,
    ),
    (
        &["lines", "scene.obj", "-o", "a.json"],
        &["--background", "#f00"],
        Told("--background is ignored: "),
    ),
    (
        &["lines", "scene.obj", "-o", "a.svg"],
        &["--painted"],
        Told("--painted is ignored: "),
    ),
    (
        &["lines", "scene.obj", "-o", "a.svg"],
        &["--weld", "0.1"],
        Acts,
    ),
    (
        &["lines", "scene.obj", "-o", "a.svg"],
        &["--spheres", "9"],
        Told("--spheres is ignored: "),
    ),
    (
        &["render", "scene.obj", "-o", "a.png"],
        &["--spheres", "9"],
        Told("--spheres is ignored: "),
    ),
    (
        &["render", "scene.obj", "-o", "a.png"],
        &["--threshold", "0.5"],
        Told("--threshold is ignored: "),
    ),
    (
        &["render", "scene.obj", "-o", "a.png"],
        &["--detail", "9"],
        Told("--detail is ignored: "),
    ),
    (
        &["render", "scene.obj", "-o", "a.png"],
        &["--seed", "9"],
        Told("--seed is ignored: "),
    ),
    (
        &["render", "scene.obj", "-o", "a.png"],
        &["--density", "x"],
        Told("--density is ignored: "),
    ),
    (
        &["render", "scene.obj", "-o", "a.png"],
        &["--velocity", "x"],
        Told("--velocity is ignored: "),
    ),
    (
        &["render", "scene.obj", "-o", "a.png"],
        &["--heat", "x"],
        Told("--heat is ignored: "),
    ),
    (
        &["render", "scene.obj", "-o", "a.png"],
        &["--volume-up", "z"],
        Told("--volume-up is ignored: "),
    ),
    (
        &["render", "scene.obj", "-o", "a.png"],
        &["--eye", "3,4,5"],
        Acts,
    ),
    (
        &["render", "scene.obj", "-o", "a.png"],
        &["--target", "0.4,0.2,0"],
        Acts,
    ),
    (
        &["render", "scene.obj", "-o", "a.png"],
        &["--up", "1,1,0"],
        Acts,
    ),
    (
        &["render", "scene.obj", "-o", "a.png"],
        &["--fov", "15", "--eye", "3,4,5"],
        Acts,
    ),
    (
        &["render", "scene.obj", "-o", "a.png"],
        &["--view", "left"],
        Acts,
    ),
    (
        &["lines", "scene.obj", "-o", "a.svg"],
        &["--view", "iso"],
        Acts,
    ),
    (
        &["render", "scene.obj", "-o", "a.png", "--view", "front"],
        &["--ortho"],
        Acts,
    ),
    (&["lines", "scene.obj", "-o", "a.svg"], &["--ortho"], Acts),
    (
        &[
            "animate",
            "scene.obj",
            "--turntable",
            "--frames",
            "0..1",
            "-o",
            "a.gif",
        ],
        &["--ortho"],
        Acts,
    ),
    (
        &["render", "scene.obj", "-o", "a.png"],
        &["--size", "80x64"],
        Acts,
    ),
    (
        &["render", "scene.obj", "-o", "a.png"],
        &["--style", "ink"],
        Acts,
    ),
    (
        &["render", "scene.obj", "-o", "a.png"],
        &["--set", "line.color=#f00"],
        Acts,
    ),
    (
        &["render", "scene.obj", "-o", "a.png"],
        &["--volume", "puff@2,0,1*0.5"],
        Acts,
    ),
    (
        &["render", "wing.glb", "-o", "a.png"],
        &["--clip", "Beat"],
        Acts,
    ),
    (
        &["lines", "wing.glb", "-o", "a.svg"],
        &["--clip", "1"],
        Acts,
    ),
    (
        &["render", "wing.glb", "-o", "a.png"],
        &["--time", "0.5"],
        Acts,
    ),
    (
        &["lines", "wing.glb", "-o", "a.svg", "--clip", "Beat"],
        &["--time", "0.5"],
        Acts,
    ),
    (
        &["render", "scene.obj", "-o", "a.png"],
        &["--time", "0.5"],
        Told("--time is ignored: "),
    ),
    (
        &["lines", "scene.obj", "-o", "a.svg"],
        &["--time", "0.5"],
        Told("--time is ignored: "),
    ),
    (
        &["render", "avatar.vrm", "-o", "a.png"],
        &["--expression", "happy=0.8"],
        Acts,
    ),
    (
        &["render", "avatar.vrm", "-o", "a.png"],
        &["--motion", "wave.vrma"],
        Acts,
    ),
    (
        &["render", "avatar.vrm", "-o", "a.png"],
        &["--pose", "bow.json"],
        Acts,
    ),
    (
        &["lines", "avatar.vrm", "-o", "a.svg"],
        &["--expression", "happy=0.8"],
        Acts,
    ),
    (
        &["lines", "avatar.vrm", "-o", "a.svg"],
        &["--motion", "wave.vrma"],
        Acts,
    ),
    (
        &["lines", "avatar.vrm", "-o", "a.svg"],
        &["--pose", "bow.json"],
        Acts,
    ),
    (
        &["render", "puppet.vrm", "-o", "a.png"],
        &["--look-at", "camera"],
        Acts,
    ),
    (
        &[
            "lines",
            "puppet.vrm",
            "-o",
            "a.svg",
            "--eye",
            "0.2,1.7,0.6",
            "--target",
            "0,1.6,0",
        ],
        &["--look-at", "9,1.6,1"],
        Acts,
    ),
    (
        &["lines", "avatar.vrm", "-o", "a.svg"],
        &["--look-at", "camera"],
        Told("--look-at is ignored: the scene has no figure"),
    ),
    (
        &[
            "render",
            "avatar.vrm",
            "-o",
            "a.png",
            "--motion",
            "wave.vrma",
        ],
        &["--time", "0.7"],
        Acts,
    ),
    (
        &[
            "render",
            "avatar.vrm",
            "-o",
            "a.png",
            "--motion",
            "wave.vrma",
        ],
        &["--pose", "bow.json"],
        Acts,
    ),
    (
        &[
            "render",
            "avatar.vrm",
            "-o",
            "a.png",
            "--motion",
            "wave.vrma",
            "--time",
            "1",
        ],
        &["--expression", "happy=0"],
        Acts,
    ),
];

/// A film of one frame of the box, as pictures and as line drawings.
const TURN: &[&str] = &[
    "animate",
    "scene.obj",
    "--turntable",
    "--frames",
    "2",
    "--length",
    "9",
    "-o",
    "a.png",
];
const ORBIT: &[&str] = &[
    "animate",
    "scene.obj",
    "--orbit",
    "40",
    "--frames",
    "2",
    "-o",
    "a.png",
];
const SHAPES: &[&str] = &[
    "animate",
    "scene.obj",
    "--orbit",
    "40",
    "--frames",
    "2",
    "--set",
    "line.method=shape",
    "-o",
    "a.png",
];
const LINES: &[&str] = &[
    "animate",
    "scene.obj",
    "--orbit",
    "40",
    "--frames",
    "0",
    "-o",
    "a.svg",
];

/// A setting that leaves hard folds to the normals.
const NORMALS_ALONE: &str = "line.crease_hard_deg=180";

/// The same drawings where the normals alone tell creases.
const LINES_BY_NORMALS: &[&str] = &[
    "animate",
    "scene.obj",
    "--orbit",
    "40",
    "--frames",
    "0",
    "-o",
    "a.svg",
    "--set",
    NORMALS_ALONE,
];
const PLAYED: &[&str] = &[
    "animate",
    "scene.obj",
    "--orbit",
    "40",
    "--frames",
    "2..3",
    "-o",
    "a.gif",
];
const OF_LINES: &str = "is ignored: frames are pictures: --lines draws the lines alone";

const BEAT: &[&str] = &["animate", "wing.glb", "--frames", "3", "-o", "a.png"];

/// A film of an avatar that turns, and one in which it moves.
const STANDING: &[&str] = &[
    "animate",
    "avatar.vrm",
    "--orbit",
    "40",
    "--frames",
    "2",
    "-o",
    "a.png",
];
const WAVING: &[&str] = &[
    "animate",
    "avatar.vrm",
    "--motion",
    "wave.vrma",
    "--frames",
    "20",
    "-o",
    "a.png",
];

const ANIMATIONS: &[Case] = &[
    (STANDING, &["--expression", "happy"], Acts),
    (STANDING, &["--pose", "bow.json"], Acts),
    (
        &[
            "animate",
            "puppet.vrm",
            "--orbit",
            "40",
            "--frames",
            "2",
            "-o",
            "a.png",
        ],
        &["--look-at", "camera"],
        Acts,
    ),
    (STANDING, &["--motion", "wave.vrma"], Acts),
    (WAVING, &["--expression", "happy=0"], Acts),
    (WAVING, &["--pose", "bow.json"], Acts),
    (BEAT, &["--fps", "6"], Acts),
    (BEAT, &["--clip", "1"], Acts),
    (BEAT, &["--turntable", "--length", "7"], Acts),
    (
        &[
            "animate", "wing.glb", "--frames", "3", "--orbit", "9", "-o", "a.png",
        ],
        &["--time", "0.5"],
        Acts,
    ),
    (
        ORBIT,
        &["--time", "0.5"],
        Told("--time is ignored: the scene has no clips"),
    ),
    (TURN, &["--length", "8"], Acts),
    (TURN, &["--frames", "3"], Acts),
    (TURN, &["--lines"], Acts),
    (
        TURN,
        &["--fps", "12"],
        Told("--fps is ignored: every file holds one frame, and no clip plays"),
    ),
    (ORBIT, &["--orbit", "-40"], Acts),
    (ORBIT, &["--length", "8"], Told("--length is ignored: ")),
    (ORBIT, &["--eye", "3,4,5"], Acts),
    (ORBIT, &["--style", "ink"], Acts),
    (ORBIT, &["--seed", "9"], Told("--seed is ignored: ")),
    (ORBIT, &["--volume", "puff@2,0,1*0.5"], Acts),
    (PLAYED, &["--fps", "12"], Acts),
    (LINES, &["--kinds", "contour"], Acts),
    (LINES, &["--crease", "100"], Acts),
    (LINES_BY_NORMALS, &["--crease-from", "faces"], Acts),
    (LINES, &["--split", "30"], Acts),
    (LINES, &["--hidden", "dashed"], Acts),
    (LINES, &["--fill"], Acts),
    (LINES, &["--svg", "centreline"], Acts),
    (LINES, &["--page", "A4"], Acts),
    (LINES, &["--weld", "0.1"], Acts),
    (LINES, &["--painted"], Told("--painted is ignored: ")),
    (
        SHAPES,
        &["--hold", "off"],
        Told("--hold is ignored: no lines of this style are strokes (line.method)"),
    ),
    (ORBIT, &["--kinds", "contour"], Told(OF_LINES)),
    (ORBIT, &["--crease", "100"], Told(OF_LINES)),
    (ORBIT, &["--crease-from", "faces"], Told(OF_LINES)),
    (ORBIT, &["--split", "30"], Told(OF_LINES)),
    (ORBIT, &["--method", "surface"], Told(OF_LINES)),
    (ORBIT, &["--hidden", "dashed"], Told(OF_LINES)),
    (ORBIT, &["--smooth", "off"], Told(OF_LINES)),
    (ORBIT, &["--fill"], Told(OF_LINES)),
    (ORBIT, &["--painted"], Told(OF_LINES)),
    (ORBIT, &["--weld", "0.1"], Told(OF_LINES)),
    (ORBIT, &["--svg", "centreline"], Told(OF_LINES)),
    (ORBIT, &["--page", "A4"], Told(OF_LINES)),
];

const SMOKES: &[Case] = &[
    (PUFF, &["--spheres", "9"], Acts),
    (PUFF, &["--threshold", "0.4"], Acts),
    (PUFF, &["--detail", "4"], Acts),
    (PUFF, &["--seed", "9"], Acts),
    (PUFF, &["--particles", "published"], Acts),
    (
        PUFF,
        &["--emitter", "0,0,0*1"],
        Told("--emitter is ignored: "),
    ),
    (PUFF, &["--fps", "12"], Acts),
    (PUFF, &["--frames", "3"], Acts),
    (PUFF, &["--grid", "8x8x9"], Acts),
    (PUFF, &["--step", "2"], Told("--step is ignored: ")),
    (PUFF, &["--time", "1"], Told("--time is ignored: ")),
    (PUFF, &["--pose", "x"], Told("--pose is ignored: ")),
    (PUFF, &["--motion", "x"], Told("--motion is ignored: ")),
    (PUFF, &["--density", "x"], Told("--density is ignored: ")),
    (
        PUFF,
        &["--volume-up", "z"],
        Told("--volume-up is ignored: "),
    ),
    (
        PUFF,
        &["--set", "line.color=#f00"],
        Told("'line.color' is ignored: "),
    ),
];

const PUFF: &[&str] = &[
    "smoke", "puff", "-o", "a.png", "--grid", "8x8x8", "--frames", "4",
];

const TRACINGS: &[Case] = &[
    (
        &["trace", "blots.png", "-o", "a.svg"],
        &["--turdsize", "400"],
        Acts,
    ),
    (
        &["trace", "blots.png", "-o", "a.svg"],
        &["--alphamax", "0"],
        Acts,
    ),
    (
        &["trace", "blots.png", "-o", "a.svg"],
        &["--opttolerance", "5"],
        Acts,
    ),
    (
        &["trace", "blots.png", "-o", "a.svg"],
        &["--longcurve"],
        Acts,
    ),
    (&["trace", "blots.png", "-o", "a.svg"], &["--invert"], Acts),
    (
        &["trace", "blots.png", "-o", "a.svg"],
        &["--blacklevel", "0.1"],
        Acts,
    ),
    (
        &["trace", "blots.png", "-o", "a.svg"],
        &["--turnpolicy", "white"],
        Acts,
    ),
    (
        &["trace", "blots.png", "-o", "a.svg"],
        &["--centreline"],
        Acts,
    ),
    (
        &["trace", "blots.png", "-o", "a.svg"],
        &["--colours", "4"],
        Acts,
    ),
    (
        &["trace", "blots.png", "-o", "a.svg", "--longcurve"],
        &["--opttolerance", "5"],
        Told("--opttolerance is ignored: "),
    ),
    (
        &["trace", "blots.png", "-o", "a.svg", "--centreline"],
        &["--alphamax", "0"],
        Told("--alphamax is ignored: "),
    ),
    (
        &["trace", "blots.png", "-o", "a.svg", "--centreline"],
        &["--turnpolicy", "black"],
        Told("--turnpolicy is ignored: "),
    ),
    (
        &["trace", "blots.png", "-o", "a.svg", "--centreline"],
        &["--longcurve"],
        Told("--longcurve is ignored: "),
    ),
];

/// Options that change no drawing by their nature or are tested elsewhere, with the reason.
const EXCEPTIONS: &[(&str, &str)] = &[
    ("output", "it names the file"),
    ("format", "it says what the file is, whatever its name"),
    ("quiet", "it is about messages"),
    ("timings", "it is about messages"),
    (
        "resume",
        "it is about work that is done; `animate::` tests it",
    ),
    (
        "turntable",
        "it is in every film that has no --orbit, and not beside it",
    ),
    ("backend", "engines agree"),
    ("cache", "it is about time"),
    ("method", "it says where lines come from"),
    ("smooth", "`lines::` tests it"),
    (
        "camera",
        "`scenes::` tests it, and a scene without cameras refuses it",
    ),
    ("dump_style", "it prints a style in place of a drawing"),
    ("allow_external", "it is about what may be read"),
    ("memory_limit", "it is a limit"),
    ("max_file", "it is a limit"),
    ("max_json", "it is a limit"),
    ("max_json_objects", "it is a limit"),
    ("max_nodes", "it is a limit"),
    ("max_triangles", "it is a limit"),
    ("max_image_side", "it is a limit"),
    ("max_image", "it is a limit"),
    ("max_images", "it is a limit"),
    (
        "spur",
        "`trace::` tests it; without --centreline it is refused",
    ),
];

/// Blots, a speck and two corners that touch, grey at the edges.
fn blots() -> Vec<u8> {
    let gray = |x: u32, y: u32| {
        let (x, y) = (x as i32, y as i32);
        let of = |cx: i32, cy: i32, r: i32| (x - cx) * (x - cx) + (y - cy) * (y - cy) < r * r;
        let touches = (40..48).contains(&x) && (40..48).contains(&y)
            || (48..56).contains(&x) && (48..56).contains(&y);
        match () {
            () if of(16, 16, 9) || of(45, 16, 3) || touches => Rgb([0; 3]),
            () if of(16, 16, 12) => Rgb([90; 3]),
            () => Rgb([255; 3]),
        }
    };
    encoded(&RgbImage::from_fn(64, 64, gray).into(), ImageFormat::Png)
}

/// A box whose normals run on from its front to its right side, and break elsewhere, and a leaf that nearly touches
/// it.
const BOX: &[u8] = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
    vn 1 0 1\nvn 0 1 0\nvn 0 -1 0\nvn -1 0 0\nvn 0 0 -1\n\
    f 5//1 6//1 7//1 8//1\nf 6//1 2//1 3//1 7//1\nf 8//2 7//2 3//2 4//2\nf 1//3 2//3 6//3 5//3\n\
    f 1//4 5//4 8//4 4//4\nf 2//5 1//5 4//5 3//5\n\
    v 1.05 0 0\nv 2 0 0\nv 2 1 0\nv 1.05 1 0\nf 9//5 10//5 11//5 12//5\n";

/// Puts what moves into a folder: a wing, and an avatar with a motion and a pose.
fn put_figures(place: &Workplace) {
    place.put("wing.glb", &npr_scene::testing::wing());
    place.put(
        "avatar.vrm",
        &npr_scene::testing::avatar(npr_scene::testing::Vrm::One),
    );
    let eyes = npr_scene::Eyes::Expressions;
    let puppet = npr_scene::testing::puppet(npr_scene::testing::Vrm::One, eyes);
    place.put("puppet.vrm", &puppet);
    place.put("wave.vrma", &npr_scene::testing::gesture());
    place.put(
        "bow.json",
        br#"{"pose":{"spine":{"rotation":[0.5,0,0,0.8]}}}"#,
    );
}

fn run_all(place: &Workplace, cases: &[Case], common: &[&str]) {
    let mut wrong = Vec::new();
    for (line, option, does) in cases {
        let file = line[line
            .iter()
            .position(|word| *word == "-o")
            .expect("an output")
            + 1];
        let drawn = |words: &[&[&str]]| {
            let outcome = place.npr(&words.concat());
            assert_eq!(outcome.code, Some(0), "{words:?}: {}", outcome.stderr);
            (place.get(file), outcome.stderr)
        };
        let (before, said_before) = drawn(&[line, common]);
        // What stands in the line already is said anew.
        let (after, said) = drawn(&[&without(line, option), &without(common, option), option]);
        let is_right = match does {
            Acts => before != after,
            Told(text) => {
                let is_told_once = said.matches(text).count() == 1;
                before == after && is_told_once && !said_before.contains(text)
            }
        };
        if !is_right {
            wrong.push(format!("{line:?} {option:?}: {said}"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// A command line without an option that `more` gives, and without its value.
fn without<'a>(line: &[&'a str], more: &[&str]) -> Vec<&'a str> {
    match line
        .iter()
        .position(|word| word.starts_with("--") && more.first() == Some(word))
    {
        Some(at) => [&line[..at], &line[at + 2..]].concat(),
        None => line.to_vec(),
    }
}

#[test]
fn options_of_drawings_act_or_are_told() {
    let place = Workplace::new();
    place.put("scene.obj", BOX);
    put_figures(&place);
    run_all(&place, DRAWINGS, &SMALL);
}

#[test]
fn options_of_films_act_or_are_told() {
    let place = Workplace::new();
    place.put("scene.obj", BOX);
    put_figures(&place);
    run_all(&place, ANIMATIONS, &SMALL);
}

#[test]
fn options_of_smoke_act_or_are_told() {
    run_all(&Workplace::new(), SMOKES, &SMALL);
}

#[test]
fn options_of_tracings_act_or_are_told() {
    let place = Workplace::new();
    place.put("blots.png", &blots());
    run_all(&place, TRACINGS, &[]);
}

#[test]
fn every_option_of_every_drawing_command_is_tried() {
    let mut command = npr_cli::command();
    command.build();
    let tried = |name: &str| {
        let cases = DRAWINGS
            .iter()
            .chain(ANIMATIONS)
            .chain(SMOKES)
            .chain(TRACINGS);
        let option = format!("--{}", name.replace('_', "-"));
        cases
            .flat_map(|(_, option, _)| option.iter())
            .any(|word| *word == option)
    };
    let mut missing = Vec::new();
    for name in ["render", "lines", "animate", "smoke", "trace"] {
        let found: &Command = command.find_subcommand(name).expect("a command");
        for option in found
            .get_arguments()
            .filter(|option| !option.is_positional())
        {
            let id = option.get_long().expect("a long name").replace('-', "_");
            let is_excused = EXCEPTIONS.iter().any(|(known, _)| *known == id)
                || ["help", "version"].contains(&id.as_str());
            if !is_excused && !tried(&id) {
                missing.push(format!("{name} --{id}"));
            }
        }
    }
    assert!(missing.is_empty(), "{missing:?}");
}

#[test]
fn brushes_are_told_where_a_file_has_even_ink() {
    let place = Workplace::with_scene();
    let brush = ["--set", "line.brush.tip=chalk", "--set", "paper.size=3px"];
    let said = |more: &[&str]| {
        let line = ["lines", "scene.obj", "--size", "48x32"];
        let outcome = place.npr(&[&line[..], &brush, more].concat());
        assert_eq!(outcome.code, Some(0));
        outcome.stderr
    };
    let wanted = "npr: warning: 'line.brush.tip' is ignored by npr lines: drawings of lines have even ink, \
                  but for --svg stamps\n\
                  npr: warning: 'paper.size' is ignored by npr lines: drawings of lines have no grain, \
                  but for --svg stamps\n";
    assert_eq!(said(&[]), wanted);
    for file in ["a.svg", "a.pdf", "a.png"] {
        assert_eq!(said(&["--svg", "stamps", "-o", file]), "", "{file}");
    }
}

#[test]
fn keys_that_cannot_act_are_told_once_and_by_name() {
    let place = Workplace::with_scene();
    let set = ["--set", "ink.tone=hatch", "--set", "shade.softness=0.2"];
    let outcome = place.npr(&[&["lines", "scene.obj", "--size", "48x32"][..], &set].concat());
    assert_eq!(outcome.code, Some(0));
    let wanted = "npr: warning: 'ink.tone' and 'shade.softness' are ignored by npr lines: \
                  it draws no tones and no hatching\n";
    assert_eq!(outcome.stderr, wanted);
    let quiet = place.npr(
        &[
            &["lines", "scene.obj", "--size", "48x32", "--quiet"][..],
            &set,
        ]
        .concat(),
    );
    quiet.assert_silent_success();
    // A preset wishes nothing.
    place
        .npr(&[
            "lines",
            "scene.obj",
            "--size",
            "48x32",
            "--style",
            "crosshatch",
        ])
        .assert_silent_success();
    place
        .render("scene.obj", &["--set", "ink.tone=hatch"])
        .assert_silent_success();
}
