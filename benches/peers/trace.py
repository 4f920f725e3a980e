#!/usr/bin/env python3
"""Our tracings beside those of other programs, as tables in Markdown; run by `cargo xtask measure trace`.

Usage: trace.py NPR [--made FOLDER] FOLDER [FOLDER ..]
NPR is the command, built in release. FOLDER holds bitmaps as PNG; --made one that make_bitmaps.py filled, for the race with vtracer
and OpenCV, which is left out without it. Needs potrace, resvg and GNU time, and numpy and pillow of Python; vtracer and opencv-python where raced.
All programs read the same PBM, and their times take turns: the least of some rounds counts. Output goes to standard output, so no disk is timed.
Outlines are alike where, traced as polygons without joining, all corners lie within 0.03 px of each other's; nodes are those of the
default options. Pixels are compared at four times the size.
"""
import os, platform, re, resource, subprocess, sys, tempfile, time
import numpy as np
from PIL import Image

POLICIES = ["black", "white", "minority", "majority"]
SCALE = 4
# Larger pictures are compared at their own size.
LARGEST_SCALED = 2048
ROUNDS = 7
# Enlarged to 4096 pixels a side for the clock.
ENLARGED = "halftone_dots_512"


def pbm(image, folder):
    """An image, or booleans of ink, as a packed PBM, and its size."""
    ink = image if isinstance(image, np.ndarray) else np.asarray(image.convert("L")) < 128
    out = os.path.join(folder, "bitmap.pbm")
    with open(out, "wb") as file:
        file.write(b"P4\n%d %d\n" % (ink.shape[1], ink.shape[0]))
        file.write(np.packbits(ink, axis=1).tobytes())
    return out, ink.shape[::-1]


def outlines(svg, height=None):
    """Every closed path as its points (ends and control points), in pixels, y down; potrace writes hundredths, y up."""
    found = []
    for data in re.findall(r'<path d="([^"]*)"', open(svg).read()):
        at, points, letter = np.zeros(2), [], ""
        tokens = re.findall(r"[A-Za-z]|-?[0-9.]+", data)
        i = 0
        while i < len(tokens):
            if tokens[i].isalpha():
                letter, i = tokens[i], i + 1
                if letter in "zZ":
                    found.append(points)
                    at, points = points[0][1], []
                continue
            pairs = 3 if letter in "cC" else 1
            numbers = np.array(tokens[i : i + 2 * pairs], float).reshape(-1, 2)
            i += 2 * pairs
            places = numbers if letter.isupper() else numbers + at
            points += [(letter.lower(), place) for place in places]
            at = places[-1]
            if letter in "mM":
                letter = "l" if letter == "m" else "L"
    if height is None:
        return [[place for _, place in points] for points in found]
    turned = [[place / 100 for _, place in points] for points in found]
    return [[np.array([x, height - y]) for x, y in points] for points in turned]


def alike(ours, theirs):
    """How many outlines of one list have a partner in the other with the same corners."""
    def key(points):
        return tuple(np.concatenate([np.min(points, 0), np.max(points, 0)]))
    left = {}
    for points in ours:
        left.setdefault(len(points), []).append((key(points), points))
    count = 0
    for points in theirs:
        wanted = key(points)
        for place, (box, other) in enumerate(left.get(len(points), [])):
            if np.abs(np.subtract(box, wanted)).max() > 0.03:
                continue
            distance = [np.abs(np.array(other) - p).max(1).min() for p in points]
            if max(distance) <= 0.03:
                left[len(points)].pop(place)
                count += 1
                break
    return count


def ink_drawn(svg, size, folder):
    """The pixels that a picture of the file covers by more than half."""
    scale = SCALE if max(size) <= LARGEST_SCALED else 1
    png = os.path.join(folder, "drawn.png")
    width, height = (str(side * scale) for side in size)
    subprocess.run(["resvg", "-w", width, "-h", height, svg, png], check=True)
    return np.asarray(Image.open(png))[:, :, 3] > 127


def run_once(command, threads=1):
    """Processor time and wall time in ms of one run; its output is thrown away."""
    start = time.perf_counter()
    env = {**os.environ, "RAYON_NUM_THREADS": str(threads)}
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL, env=env)
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    wall = (time.perf_counter() - start) * 1e3
    if child.returncode:
        raise subprocess.CalledProcessError(child.returncode, command)
    return [(usage.ru_utime + usage.ru_stime) * 1e3, wall]


def peak(command, threads=1):
    """The most memory of a run, in MB; by GNU time, for what the system tells of a child begins with its parent's."""
    env = {**os.environ, "RAYON_NUM_THREADS": str(threads)}
    timed = ["/usr/bin/time", "-f", "%M", *command]
    run = subprocess.run(timed, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, env=env, check=True)
    return int(run.stderr.split()[-1]) * 1024 / 1e6


def commands(npr, bitmap):
    """Ours in one thread, in two, and potrace."""
    ours = [npr, "trace", bitmap, "-o", "-"]
    return [(ours, 1), (ours, 2), (["potrace", "-s", bitmap, "-o", "-"], 1)]


def race(npr, bitmap):
    """The least of both figures of `run_once`, of all that take turns."""
    runners = commands(npr, bitmap)
    rounds = [[run_once(*runner) for runner in runners] for _ in range(ROUNDS)]
    return np.min(np.array(rounds), axis=0)


def compare(npr, name, image, folder):
    """Prints what is found in a bitmap by both, a line a turn policy."""
    bitmap, size = pbm(image, folder)
    ours, theirs = (os.path.join(folder, name) for name in ("ours.svg", "theirs.svg"))
    for policy in POLICIES:

        def both(*options):
            last = ["-z", policy, *options, bitmap, "-o"]
            subprocess.run([npr, "trace", *last, ours], check=True)
            subprocess.run(["potrace", "-s", "-u", "100", *last, theirs], check=True)
            return outlines(ours), outlines(theirs, size[1])

        polygons = both("-a", "0", "-n")
        same = alike(*polygons)
        mine, potraces = both()
        nodes = [sum(map(len, paths)) for paths in (mine, potraces)]
        ratio = f"{nodes[0] / nodes[1]:.4f}" if nodes[1] else "-"
        drawn = [ink_drawn(svg, size, folder) for svg in (ours, theirs)]
        share = f"{100 * np.mean(drawn[0] != drawn[1]):.4f} %"
        cells = [name, policy, f"{len(mine)} / {len(potraces)}", same, ratio, share]
        print("| " + " | ".join(map(str, cells)) + " |", flush=True)


def print_times(npr, images, folder):
    """Prints a line a bitmap: times, their ratios, memory."""
    print("| bitmap | ours, 1 thread | potrace | ours / potrace | ours, 2 threads | 1 / 2 threads | memory, ours | potrace |")
    print("|---|---:|---:|---:|---:|---:|---:|---:|")
    for name, image in images:
        bitmap, _ = pbm(image, folder)
        (cpu, wall), (_, wall2), (peer_cpu, peer_wall) = race(npr, bitmap)
        *memory, peer_memory = [peak(*runner) for runner in commands(npr, bitmap)]
        cells = [
            name,
            f"{cpu:.0f} / {wall:.0f}",
            f"{peer_cpu:.0f} / {peer_wall:.0f}",
            f"{wall / peer_wall:.2f}",
            f"{wall2:.0f}",
            f"{wall / wall2:.2f}",
            f"{max(memory):.0f}",
            f"{peer_memory:.0f}",
        ]
        print("| " + " | ".join(cells) + " |", flush=True)


def hard_bitmaps():
    """Bitmaps of 3840x2160 pixels with as many edges as can be, by kind."""
    y, x = np.mgrid[0:2160, 0:3840]
    random = np.random.Generator(np.random.PCG64(1))
    yield "chequer of 1 px", (x + y) % 2 == 0
    yield "half noise", random.random(x.shape) < 0.5
    yield "dots of 3 px", (x % 3 < 2) & (y % 3 < 2) & ~((x % 3 == 1) & (y % 3 == 1))
    # A tree of passages two pixels apart: every node goes on to the right or up.
    tree = np.zeros(x.shape, bool)
    rows, columns = 1079, 1919
    right = random.random((rows, columns)) < 0.5
    right[0], right[:, -1] = True, False
    tree[1 : 2 * rows : 2, 1 : 2 * columns : 2] = True
    tree[1 : 2 * rows : 2, 2 : 2 * columns + 1 : 2] |= right
    tree[2 : 2 * rows : 2, 1 : 2 * columns : 2] |= ~right[1:]
    yield "maze, one loop", tree


def print_memory(npr, folder):
    print("| bitmap | policy | 1 thread | 2 threads | seconds, 2 threads |")
    print("|---|---|---:|---:|---:|")
    for name, ink in hard_bitmaps():
        bitmap, _ = pbm(ink, folder)
        for policy in ("black", "white", "minority", "majority"):
            command = [npr, "trace", "-t", "0", "-z", policy, bitmap, "-o", "-"]
            one, two = peak(command, 1), peak(command, 2)
            _, wall = run_once(command, 2)
            print(f"| {name} | {policy} | {one:.0f} | {two:.0f} | {wall / 1e3:.1f} |", flush=True)


def least(work):
    """Least wall time of some calls, in ms."""
    times = []
    for _ in range(ROUNDS):
        start = time.perf_counter()
        work()
        times.append((time.perf_counter() - start) * 1e3)
    return min(times)


def print_others(npr, made, folder):
    """Prints a line a bitmap of the folder: ours and potrace as processes, vtracer and OpenCV called in this one, from pixels in memory."""
    import io

    import cv2, vtracer

    cv2.setNumThreads(1)
    print("| bitmap | ours, 1 thread | 2 threads | potrace | vtracer | OpenCV, contours only |")
    print("|---|---:|---:|---:|---:|---:|")
    for file in sorted(name for name in os.listdir(made) if name.endswith(".png")):
        image = Image.open(os.path.join(made, file))
        bitmap, _ = pbm(image, folder)
        one, two, potrace = race(npr, bitmap)[:, 1]
        ink = (np.asarray(image.convert("L")) < 128).astype(np.uint8)
        png = io.BytesIO()
        image.convert("RGBA").save(png, "PNG")

        def by_vtracer():
            vtracer.convert_raw_image_to_svg(png.getvalue(), img_format="png", colormode="binary", mode="spline")

        try:
            vector = f"{least(by_vtracer):.0f}"
        except BaseException:  # It panics on some bitmaps.
            vector = "fails"
        contours = least(lambda: cv2.findContours(ink, cv2.RETR_CCOMP, cv2.CHAIN_APPROX_NONE))
        print(f"| {os.path.splitext(file)[0]} | {one:.0f} | {two:.0f} | {potrace:.0f} | {vector} | {contours:.0f} |", flush=True)


def main():
    npr, *rest = sys.argv[1:]
    made = rest[1] if rest[:1] == ["--made"] else None
    folders = rest[2:] if made else rest
    files = sorted((name, folder) for folder in folders for name in os.listdir(folder) if name.endswith(".png"))
    images = [(os.path.splitext(name)[0], Image.open(os.path.join(folder, name))) for name, folder in files]
    version = subprocess.run(["potrace", "--version"], capture_output=True, text=True).stdout.split("\n")[0].split(". ")[0]
    here = os.path.dirname(os.path.abspath(__file__))
    code = subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=here, capture_output=True, text=True).stdout.strip()
    machine = f"{os.cpu_count()} cores, {platform.machine()}, load {os.getloadavg()[0]:.1f}"
    print(f"# Tracings beside potrace\n\n{machine}; {version}; code: {code or 'unknown'}.\n")
    print("## What is found\n")
    print("| bitmap | policy | paths, ours / potrace | outlines alike | nodes, ours / potrace | pixels that differ |")
    print("|---|---|---:|---:|---:|---:|")
    with tempfile.TemporaryDirectory() as folder:
        for name, image in images:
            compare(npr, name, image, folder)
        print(f"\n## Time\n\nWhole process, PBM to SVG, default options, least of {ROUNDS} rounds: processor time / wall time, ms; ratios of wall times; memory in MB.\n")
        larger = [(f"{name} at 4096", image.convert("L").resize((4096, 4096), Image.BICUBIC)) for name, image in images if name == ENLARGED]
        print_times(npr, images + larger, folder)
        print("\n## Most memory at 3840x2160\n\nPeak in MB, without despeckling.\n")
        print_memory(npr, folder)
        if made:
            print(f"\n## Other tracers\n\nWall time, ms, least of {ROUNDS}. vtracer and OpenCV without process and file; OpenCV fits no curves.\n")
            print_others(npr, made, folder)


main()
