//! Options of smoke and of tracings.

use super::case::Case;
use super::case::Does::{Acts, Told};

pub const SMOKES: &[Case] = &[
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

pub const TRACINGS: &[Case] = &[
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
