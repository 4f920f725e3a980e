//! Options of commands that draw a scene once.

use super::case::Does::{Acts, Told};
use super::case::{Case, NORMALS_ALONE};

pub const DRAWINGS: &[Case] = &[
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
