#!/usr/bin/env python3
"""Our tracings beside those of potrace, on every bitmap of a folder and four turn policies; prints tables in Markdown.

Usage: trace.py NPR FOLDER [FOLDER ..]
NPR is the command, built in release. Needs potrace; without resvg the column of pixels is left out, and a line says so.
Both programs read the same PBM and write SVG. Outlines are alike where, traced as polygons without joining, all corners lie
within 0.03 px of each other's; nodes are those of the default options. Pixels are compared at four times the size.
"""
import os, re, resource, shutil, subprocess, sys, tempfile, time
import numpy as np
from PIL import Image

POLICIES = ["black", "white", "minority", "majority"]
SCALE = 4
# Larger pictures are compared at their own size.
LARGEST_SCALED = 2048
TIMED_RUNS = 5


def pbm(path, folder):
    """The bitmap as a packed PBM, and its size."""
    ink = np.asarray(Image.open(path).convert("L")) < 128
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


def least_work(command, threads=1):
    """Least processor time of some runs, and the wall time of that run, in ms."""
    best = (1e9, 1e9)
    for _ in range(TIMED_RUNS):
        before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
        subprocess.run(command, check=True, env={**os.environ, "RAYON_NUM_THREADS": str(threads)})
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        work = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        best = min(best, (work * 1e3, (time.perf_counter() - start) * 1e3))
    return best


def main():
    npr, folders = sys.argv[1], sys.argv[2:]
    files = sorted(
        os.path.join(folder, name) for folder in folders for name in os.listdir(folder) if name.endswith(".png")
    )
    draws = shutil.which("resvg") is not None
    if not draws:
        print("There is no resvg: pixels are not compared.\n")
    times = []
    print("| bitmap | policy | paths, ours / potrace | outlines alike | nodes, ours / potrace | pixels that differ |")
    print("|---|---|---:|---:|---:|---:|")
    with tempfile.TemporaryDirectory() as folder:
        ours, theirs = (os.path.join(folder, name) for name in ("ours.svg", "theirs.svg"))
        for file in files:
            bitmap, size = pbm(file, folder)
            name = os.path.splitext(os.path.basename(file))[0]
            for policy in POLICIES:
                def both(*options):
                    last = ["-z", policy, *options, bitmap, "-o"]
                    subprocess.run([npr, "trace", *last, ours], check=True)
                    subprocess.run(["potrace", "-s", "-u", "100", *last, theirs], check=True)
                    return outlines(ours), outlines(theirs, size[1])
                corners = alike(*both("-a", "0", "-n"))
                mine, potraces = both()
                nodes = [sum(map(len, paths)) for paths in (mine, potraces)]
                share = "-"
                if draws:
                    drawn = [ink_drawn(svg, size, folder) for svg in (ours, theirs)]
                    share = f"{100 * np.mean(drawn[0] != drawn[1]):.4f} %"
                print(f"| {name} | {policy} | {len(mine)} / {len(potraces)} | {corners} | {nodes[0]} / {nodes[1]} | {share} |", flush=True)
            commands = [([npr, "trace", bitmap, "-o", ours], threads) for threads in (1, 2)]
            times.append((name, [least_work(*c) for c in [*commands, (["potrace", "-s", bitmap, "-o", theirs], 1)]]))
    print("\nWhole process, SVG, default options: processor time and wall time of the run with the least, ms.\n")
    print("| bitmap | ours, 1 thread | ours, 2 threads | potrace |")
    print("|---|---:|---:|---:|")
    for name, runs in times:
        print(f"| {name} | " + " | ".join(f"{work:.0f} / {wall:.0f}" for work, wall in runs) + " |")


main()
