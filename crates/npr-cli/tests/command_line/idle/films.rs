//! Options of films.

use super::case::Does::{Acts, Told};
use super::case::{Case, NORMALS_ALONE};

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

pub const ANIMATIONS: &[Case] = &[
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
