#!/usr/bin/env python3
"""How much of the ink of files of lines differs from the PNG frame of the same strokes, in other programs.

usage: viewers.py NPR MODELS

Prints the tables of benches/results/viewers.md. Needs resvg, chromium and inkscape on the path, numpy and pillow.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import numpy
from PIL import Image

MODELS = [
    "flight_helmet.glb",
    "godette_vrm1.vrm",
    "kenney_alien.glb",
    "nefertiti_70k.glb",
    "ingenuity_helicopter.glb",
    "bridge_garden_scene.glb",
]
# Chromium takes many minutes for the 69 000 stamps of the last.
STAMPED_MODELS = MODELS[:-1]
SIZE = (1920, 1080)
# How many times as large a picture is drawn before it is averaged down.
FINER = 8

LINES_ALONE = """
background = "#ffffff"
[shade]
mode = "paper"
paper = "#ffffff"
softness = 0.0
ramp = [{ at = 0.0, light = 1.0 }]
[line]
color = "#0b0a0d"
split_angle_deg = 70
[line.width]
base = "3px"
"""
EVEN = "min = 1.0\nmax = 1.0\n"
SWELLING = """source = "projected-curvature"
min = 0.45
max = 1.5
short = 20
[line.width.taper]
start = 30
end = 110
tip = 0.08
"""
STAMPED = SWELLING + '[line.brush]\ntip = "charcoal"\nmapping = "stamps"\n'

Image.MAX_IMAGE_PIXELS = None


def run(*words):
    done = subprocess.run([str(word) for word in words], capture_output=True)
    if done.returncode:
        sys.exit(f"{words[0]} failed: {done.stderr.decode(errors='replace')[-400:]}")


def resvg(svg, png, finer):
    run("resvg", "--zoom", finer, svg, png)


def chromium(svg, png, finer):
    run(
        "chromium", "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
        f"--force-device-scale-factor={finer}", "--window-size=%d,%d" % SIZE, f"--screenshot={png}", svg,
    )


def inkscape(svg, png, finer):
    run("inkscape", svg, "-o", png, "-w", SIZE[0] * finer, "-h", SIZE[1] * finer)


VIEWERS = {"resvg": resvg, "Chromium": chromium, "Inkscape": inkscape}


def darkness(png, finer=1):
    """How dark every pixel of a picture is, 0..1, after it is averaged down."""
    picture = Image.open(png).convert("RGBA")
    if picture.size != (SIZE[0] * finer, SIZE[1] * finer):
        sys.exit(f"{png} has {picture.size} pixels")
    if finer > 1:
        picture = picture.reduce(finer)
    paper = Image.new("RGBA", picture.size, "white")
    paper.alpha_composite(picture)
    return 1.0 - numpy.asarray(paper.convert("L"), dtype=float) / 255.0


def version(words):
    done = subprocess.run(words, capture_output=True, text=True)
    return done.stdout.strip().splitlines()[-1].split(" (")[0].split(" built")[0]


def table(npr, scenes, folder, style, more, cells_of, columns):
    print("| model | ink, px | " + " | ".join(columns) + " |")
    print("|---|" + "---|" * (len(columns) + 1))
    (folder / "style.toml").write_text(LINES_ALONE + style)
    svg, png = folder / "a.svg", folder / "a.png"
    for scene in scenes:
        common = ["--size", "%dx%d" % SIZE, "--style", folder / "style.toml", "--backend", "cpu", "--quiet"]
        run(npr, "lines", scene, "-o", svg, *more, *common)
        run(npr, "render", scene, "-o", png, *common)
        frame = darkness(png)
        cells = []
        for draw in VIEWERS.values():
            cells += cells_of(draw, svg, folder / "b.png", frame)
        print(f"| {scene.stem} | {frame.sum():.0f} | " + " | ".join(cells) + " |", flush=True)
    print()


def percent(value):
    return f"{100 * value:.2f} %"


def apart(draw, svg, png, frame):
    """The difference without the viewer's own antialiasing, with it, and what that alone makes."""
    draw(svg, png, FINER)
    fine = darkness(png, FINER)
    draw(svg, png, 1)
    plain = darkness(png)
    differences = [fine - frame, plain - frame, plain - fine]
    return [percent(abs(difference).sum() / frame.sum()) for difference in differences]


def in_all(draw, svg, png, frame):
    """How much more ink there is in all."""
    draw(svg, png, 1)
    return [f"{100 * (darkness(png).sum() / frame.sum() - 1):+.2f} %"]


def main():
    npr, models = sys.argv[1], Path(sys.argv[2])
    shown = [version([program, "--version"]) for program in ["resvg", "chromium", "inkscape"]]
    commit = version(["git", "-C", str(Path(__file__).parent), "rev-parse", "--short", "HEAD"])
    print("# Files of lines in viewers\n")
    print(f"- code: {commit}")
    print(f"- viewers: resvg {shown[0]}, {shown[1]}, {shown[2]}")
    print("- lines 3 pixels wide on white, frames of 1920x1080 on the processor\n")
    print("Sum of the differences of darkness, pixel by pixel, of the SVG file in a viewer and the PNG frame of the same")
    print("strokes, as a share of the frame's ink. `exact`: the viewer draws 8 times as large, and the picture is")
    print("averaged down, so that its own antialiasing plays no part. `at size`: it draws the frame's size. `its own`:")
    print("its two pictures of the same file beside each other, no frame among them: what its antialiasing makes.\n")
    names = [f"{name}, {what}" for name in VIEWERS for what in ["exact", "at size", "its own"]]
    scenes = [models / name for name in MODELS]
    stamped = [models / name for name in STAMPED_MODELS]
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        print("## Even lines\n")
        table(npr, scenes, folder, EVEN, [], apart, names)
        print("## Lines that swell and thin out\n")
        table(npr, scenes, folder, SWELLING, [], apart, names)
        print("## Stamps of charcoal\n")
        print("`--svg stamps`; how much more or less ink there is in all. Chromium takes many minutes for the 69 000")
        print("stamps of bridge_garden_scene, which is left out.\n")
        table(npr, stamped, folder, STAMPED, ["--svg", "stamps"], in_all, list(VIEWERS))


main()
