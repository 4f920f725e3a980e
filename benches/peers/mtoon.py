#!/usr/bin/env python3
"""How far figures in the preset mtoon are from those that three-vrm draws.

usage: mtoon.py NPR MODELS PICTURE

Prints the table of benches/results/mtoon.md, and writes pairs of pictures side by side to PICTURE. Needs chromium and
npm on the path, numpy and pillow; npm fetches three and three-vrm.
"""

import http.server
import io
import json
import math
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

import numpy
from PIL import Image

MODELS = ["godette_vrm0.vrm", "godette_vrm1.vrm", "debug_robot_vrm1.vrm", "mtoon_uv_animation_vrm1.vrm"]
# Turn of the eye about the figure, and its height above the middle, in degrees.
VIEWS = {"front": (0, 0), "left": (40, 15), "behind": (160, 5)}
PACKAGES = ["three@0.180.0", "@pixiv/three-vrm@3.5.5"]
SIZE = (480, 640)
FOV = 30
LIGHT = (1, 1, 1)
# Moments of the file whose pictures move.
SECONDS = {"mtoon_uv_animation_vrm1.vrm": 0.3}
# Width of a picture in the sheet of pairs.
SMALL = 150


def run(*words, **more):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, **more)
    if done.returncode:
        sys.exit(f"{words[0]} failed: {done.stderr[-600:]}")
    return done.stdout


def views_of(npr, models):
    """Every view of every model: the eye round the middle of its bounds."""
    views = []
    for model in MODELS:
        bounds = json.loads(run(npr, "info", models / model, "--json"))["bounds"]
        low, high = (numpy.array(bounds[side]) for side in ["min", "max"])
        middle, radius = (low + high) / 2, numpy.linalg.norm(high - low) / 2
        distance = radius / math.sin(math.radians(FOV / 2))
        for name, (turn, height) in VIEWS.items():
            turn, height = math.radians(turn), math.radians(height)
            way = [math.sin(turn) * math.cos(height), math.sin(height), math.cos(turn) * math.cos(height)]
            views.append({
                "name": f"{Path(model).stem}-{name}", "url": f"/models/{model}", "model": model, "view": name,
                "eye": (middle + distance * numpy.array(way)).tolist(), "target": middle.tolist(),
                "fov": FOV, "size": SIZE, "light": LIGHT, "seconds": SECONDS.get(model, 0),
            })
    return views


def drawn_by_three(views, models, work):
    """The pictures of three-vrm, by name, and its version."""
    run("npm", "install", "--silent", "--no-audit", "--no-fund", *PACKAGES, cwd=work)
    pictures, told, ended = {}, {}, threading.Event()

    class Handler(http.server.BaseHTTPRequestHandler):
        def do_GET(self):
            path = self.path.split("?")[0]
            if path == "/views.json":
                body = json.dumps(views).encode()
            elif path.startswith("/models/"):
                body = (models / Path(path).name).read_bytes()
            elif path == "/":
                body = Path(__file__).with_name("mtoon.html").read_bytes()
            elif path.startswith("/node_modules/") and ".." not in path and (work / path[1:]).is_file():
                body = (work / path[1:]).read_bytes()
            else:
                return self.send_error(404)
            kind = {".js": "text/javascript", "": "text/html"}.get(Path(path).suffix, "application/octet-stream")
            self.send_response(200)
            self.send_header("Content-Type", kind)
            self.end_headers()
            self.wfile.write(body)

        def do_POST(self):
            body = self.rfile.read(int(self.headers["Content-Length"]))
            if self.path.startswith("/drawn/"):
                pictures[self.path[len("/drawn/"):]] = Image.open(io.BytesIO(body)).convert("RGBA")
            else:
                told[self.path] = body.decode()
                ended.set()
            self.send_response(200)
            self.end_headers()

        def log_message(self, *_):
            pass

    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    browser = subprocess.Popen(
        ["chromium", "--headless", "--no-sandbox", "--hide-scrollbars", "--use-angle=swiftshader",
         "--enable-unsafe-swiftshader", "--remote-debugging-port=0", f"--user-data-dir={work / 'profile'}",
         f"http://127.0.0.1:{server.server_port}/"],
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )
    is_told = ended.wait(600)
    browser.terminate()
    browser.wait(20)
    if not is_told or "/failed" in told:
        sys.exit(f"three-vrm drew nothing: {told.get('/failed', 'no answer')}")
    return pictures, told["/done"]


def drawn_by_npr(npr, models, work, view):
    png = work / "drawn.png"
    point = ",".join
    run(
        npr, "render", models / view["model"], "-o", png, "--style", "mtoon", "--background", "transparent",
        "--size", "%dx%d" % SIZE, "--fov", FOV, "--eye", point(map(str, view["eye"])),
        "--target", point(map(str, view["target"])), "--time", view["seconds"], "--backend", "cpu", "--quiet",
    )
    return Image.open(png).convert("RGBA")


def lab(picture):
    """CIELAB of the pixels of a picture, D65."""
    rgb = numpy.asarray(picture, dtype=float)[..., :3] / 255
    linear = numpy.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    matrix = numpy.array([[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750],
                          [0.0193339, 0.1191920, 0.9503041]])
    xyz = linear @ matrix.T / numpy.array([0.95047, 1.0, 1.08883])
    f = numpy.where(xyz > 216 / 24389, numpy.cbrt(xyz), (24389 / 27 * xyz + 16) / 116)
    return numpy.stack([116 * f[..., 1] - 16, 500 * (f[..., 0] - f[..., 1]), 200 * (f[..., 1] - f[..., 2])], -1)


def ciede2000(one, other):
    """Differences of colours [Sharma et al. 2005]."""
    (l1, a1, b1), (l2, a2, b2) = numpy.moveaxis(one, -1, 0), numpy.moveaxis(other, -1, 0)
    mean = (numpy.hypot(a1, b1) + numpy.hypot(a2, b2)) / 2
    stretch = 1.5 - 0.5 * numpy.sqrt(mean**7 / (mean**7 + 25.0**7))
    c1, c2 = numpy.hypot(a1 * stretch, b1), numpy.hypot(a2 * stretch, b2)
    h1, h2 = (numpy.degrees(numpy.arctan2(b, a * stretch)) % 360 for a, b in [(a1, b1), (a2, b2)])
    grey = c1 * c2 == 0
    turn = numpy.where(grey, 0, (h2 - h1 + 180) % 360 - 180)
    dl, dc, dh = l2 - l1, c2 - c1, 2 * numpy.sqrt(c1 * c2) * numpy.sin(numpy.radians(turn / 2))
    l, c = (l1 + l2) / 2, (c1 + c2) / 2
    far = numpy.abs(h1 - h2) > 180
    h = numpy.where(grey, h1 + h2, numpy.where(far, (h1 + h2 + 360) / 2 % 360, (h1 + h2) / 2))
    cos = lambda degrees: numpy.cos(numpy.radians(degrees))
    t = 1 - 0.17 * cos(h - 30) + 0.24 * cos(2 * h) + 0.32 * cos(3 * h + 6) - 0.2 * cos(4 * h - 63)
    sl = 1 + 0.015 * (l - 50) ** 2 / numpy.sqrt(20 + (l - 50) ** 2)
    sc, sh = 1 + 0.045 * c, 1 + 0.015 * c * t
    rt = -numpy.sin(numpy.radians(60 * numpy.exp(-(((h - 275) / 25) ** 2)))) * 2 * numpy.sqrt(
        c**7 / (c**7 + 25.0**7))
    return numpy.sqrt((dl / sl) ** 2 + (dc / sc) ** 2 + (dh / sh) ** 2 + rt * (dc / sc) * (dh / sh))


def inside(*pictures):
    """Where all pictures are opaque."""
    return numpy.logical_and.reduce([numpy.asarray(picture)[..., 3] == 255 for picture in pictures])


def apart(one, other):
    """Mean difference inside both silhouettes, and the share of their union that is in one alone."""
    both = inside(one, other)
    shown = [numpy.asarray(picture)[..., 3] > 127 for picture in [one, other]]
    odd = numpy.logical_xor(*shown).sum() / max(numpy.logical_or(*shown).sum(), 1)
    return ciede2000(lab(one), lab(other))[both].mean(), odd


def sheet(rows):
    """Pairs of pictures in rows, on white."""
    height = SMALL * SIZE[1] // SIZE[0]
    whole = Image.new("RGB", (max(map(len, rows)) * SMALL, len(rows) * height), "white")
    for y, row in enumerate(rows):
        for x, picture in enumerate(row):
            paper = Image.new("RGBA", picture.size, "white")
            paper.alpha_composite(picture)
            whole.paste(paper.convert("RGB").resize((SMALL, height), Image.LANCZOS), (x * SMALL, y * height))
    return whole.quantize(96)


def main():
    npr, models, picture = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        views = views_of(npr, models)
        theirs, version = drawn_by_three(views, models, work)
        ours = {view["name"]: drawn_by_npr(npr, models, work, view) for view in views}
    commit = run("git", "-C", Path(__file__).parent, "rev-parse", "--short", "HEAD").strip()
    print("# Figures of VRM beside three-vrm\n")
    print(f"- code: {commit}, preset mtoon, on the processor")
    print(f"- beside: {PACKAGES[1]} with {version}, in headless Chromium with WebGL in software")
    print("- %dx%d pixels, a lens of %d degrees, one white light from %s, no background\n" % (*SIZE, FOV, LIGHT))
    print("CIEDE2000 of pixels that both pictures cover whole, their mean over each view; people see 1 at the least.")
    print("`edge`: pixels that one figure covers and the other does not, as a share of both; three-vrm draws outlines")
    print("of VRM 1.0 half as wide as its specification has them.\n")
    print("| model | " + " | ".join(VIEWS) + " | mean | worst | edge |")
    print("|---|" + "---|" * (len(VIEWS) + 3))
    rows = []
    for model in MODELS:
        names = [f"{Path(model).stem}-{name}" for name in VIEWS]
        found = [apart(ours[name], theirs[name]) for name in names]
        means, edges = zip(*found)
        cells = [f"{mean:.2f}" for mean in [*means, numpy.mean(means), max(means)]]
        print(f"| {Path(model).stem} | " + " | ".join(cells) + f" | {100 * max(edges):.2f} % |")
        rows.append([image for name in names for image in [ours[name], theirs[name]]])
    pair = [f"godette_vrm{version}-front" for version in [0, 1]]
    print(f"\nBoth Godettes beside each other, from the front: {apart(*(ours[name] for name in pair))[0]:.2f} here,")
    print(f"{apart(*(theirs[name] for name in pair))[0]:.2f} there.\n")
    print(f"![Each pair: here, and in three-vrm]({picture.name})")
    sheet(rows).save(picture)


main()
