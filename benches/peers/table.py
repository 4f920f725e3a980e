#!/usr/bin/env python3
"""table.py WORK OUT.md ROOT: times and agreement of all programs whose results lie in WORK.

Times are the median over all rounds of each round's median; `min` is the least time of any run. Where a program could not be
run, `published.json` has what it took on another machine of two cores."""
import json
import os
import statistics
import subprocess
import sys
import tempfile


def rows(path):
    if not os.path.exists(path):
        return []
    with open(path) as file:
        return [json.loads(line) for line in file if line.strip()]


def median(found):
    return statistics.median(f["median_ms"] for f in found)


def least(found):
    return min(f["min_ms"] for f in found)


def both(found):
    return f"{median(found):.1f} ({least(found):.1f})" if found else "-"


def first_line(*command, cwd=None):
    done = subprocess.run(command, cwd=cwd, capture_output=True, text=True)
    return (done.stdout.splitlines() or [""])[0]


def race_table(race):
    meshes = list(dict.fromkeys(r["mesh"] for r in race))
    yield "| mesh | triangles | Line Art, whole | ours, whole | faster | ours, model kept | faster | strokes: Line Art / ours | points: Line Art / ours | peak MB: Line Art / ours |"
    yield "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|"
    for mesh in meshes:
        theirs = [r for r in race if r["mesh"] == mesh and r["peer"] == "blender-lineart"]
        ours = [r for r in race if r["mesh"] == mesh and r["peer"] == "npr"]
        if not theirs or not ours:
            continue
        la = [r["evaluate"] for r in theirs]
        whole, view = ([r[part] for r in ours] for part in ("whole", "view"))
        pair = lambda key, unit="": f"{theirs[-1][key]:.0f} / {ours[-1][key] or 0:.0f}"
        cells = [
            mesh.removesuffix(".obj"), str(ours[0]["triangles"]), both(la), both(whole),
            f"{median(la) / median(whole):.2f}x", both(view), f"{median(la) / median(view):.2f}x",
            pair("strokes"), pair("points"), pair("peak_rss_mb"),
        ]
        yield "| " + " | ".join(cells) + " |"


def drawn_by(judged):
    """What was judged, by program and mesh."""
    return {tuple(r["drawing"].removesuffix(".png").split("_", 1)): r for r in judged}


def judged_table(judged, covered):
    at = drawn_by(judged)
    ink = {r["mesh"]: r for r in covered}
    yield "| mesh | recall: Line Art | ours | precision: Line Art | ours | missing pieces: Line Art | ours | false px: Line Art | ours | Line Art's ink within 2 px of ours |"
    yield "|---|" + "---:|" * 9
    for mesh in dict.fromkeys(mesh for _, mesh in at):
        pair = [at.get((program, mesh)) for program in ("lineart", "npr")]
        if None in pair:
            continue
        cells = [mesh]
        for key, form in (("recall", "{:.5f}"), ("precision", "{:.5f}"), ("missing_pieces", "{}"), ("false_px", "{}")):
            cells += [form.format(r[key]) for r in pair]
        found = ink.get(mesh)
        # One is said only of all.
        cells.append(f"{int((1 - found['uncovered_px'] / max(found['ink_px'], 1)) * 1e5) / 1e5:.5f}" if found else "-")
        yield "| " + " | ".join(cells) + " |"


def freestyle(r):
    return r["line_cpu_ms"], r["strokes"]


def larnt(r):
    return r["edges_ms"] + r["bvh_ms"] + r["render_ms"], r["visible_paths"]


def three_svg(r):
    return r["time"]["cpu_median_ms"] + r["bvh_and_copy_ms"], r["svg_paths"]


def vtk_frame(r):
    # Its threads wait for one another: beside other work its times say nothing.
    return (r["time"]["median_ms"], "-") if "time" in r and r["load1"] < 4 else None


def occ(r):
    return r["time"]["cpu_median_ms"], sum(r["edges"].get(k, 0) for k in ("VCompound", "OutLineVCompound"))


# Name in the results, name here, name of its pictures, and how to read its time and its number of lines.
OTHERS = [
    ("blender-freestyle", "Freestyle, line part, CPU time", "freestyle", freestyle),
    ("three-svg-renderer", "three-svg-renderer, CPU time", "tsr", three_svg),
    ("larnt", "larnt, tree and rays", "larnt", larnt),
    ("vtk-frame", "VTK, a frame", "vtk", vtk_frame),
    ("occ-hlr-exact", "OpenCascade exact, CPU time", "occ", occ),
    ("occ-hlr-poly", "OpenCascade polygons, CPU time", "occ-poly", occ),
]


def others_tables(race, others, judged):
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "published.json")) as file:
        published = json.load(file)
    meshes = list(dict.fromkeys(r["mesh"].rsplit(".", 1)[0] for r in race))
    found = {(r["peer"], r["mesh"].rsplit(".", 1)[0]): r for r in others}
    at = drawn_by(judged)
    ours = {m: median([r["whole"] for r in race if r["peer"] == "npr" and r["mesh"].startswith(m + ".")]) for m in meshes}
    yield "| mesh | ours, whole | " + " | ".join(name for _, name, _, _ in OTHERS) + " |"
    yield "|---|---:|" + "---:|" * len(OTHERS)
    for mesh in meshes:
        cells = [mesh, f"{ours[mesh]:.1f}"]
        for peer, _, _, read in OTHERS:
            result = found.get((peer, mesh))
            result = read(result) if result else None
            if result:
                cells.append(f"{result[0]:.1f} / {result[1]}")
            else:
                stands = published[peer].get(mesh)
                cells.append(f"({stands})" if stands else "-")
        yield "| " + " | ".join(cells) + " |"
    programs = [("npr", "ours"), ("lineart", "Line Art")] + [(p, n.split(",")[0]) for _, n, p, _ in OTHERS if not p.startswith("occ")]
    yield ""
    yield "Recall / precision, as above:"
    yield ""
    yield "| mesh | " + " | ".join(name for _, name in programs) + " |"
    yield "|---|" + "---:|" * len(programs)
    for mesh in meshes:
        pairs = (at.get((program, mesh)) for program, _ in programs)
        yield f"| {mesh} | " + " | ".join(f"{r['recall']:.5f} / {r['precision']:.5f}" if r else "-" for r in pairs) + " |"


def processor():
    try:
        with open("/proc/cpuinfo") as file:
            return next(line.split(": ", 1)[1].strip() for line in file if line.startswith("model name"))
    except (OSError, StopIteration):
        return "an unknown processor"


def loads(others):
    found = sorted(r["load1"] for r in others if "load1" in r)
    return f"{found[0]:.1f} to {found[-1]:.1f}" if found else "not known"


def main():
    work, out, root = sys.argv[1:]
    race, judged, covered, others, others_judged = (
        rows(os.path.join(work, name + ".jsonl")) for name in ("race", "judged", "covered", "others", "others_judged")
    )
    version = next((r["version"] for r in race if "version" in r), "")
    lines = [
        "# Visible lines beside Blender's Line Art", "",
        f"- machine: {os.cpu_count()} cores of {processor()}; load average at the end {os.getloadavg()[0]:.2f}",
        f"- code: {first_line('git', 'rev-parse', '--short', 'HEAD', cwd=root)}, measured {first_line('date', '-u', '+%F')}; Line Art of Blender {version}",
        "- both programs take turns on the same mesh; ms, median of the rounds and, in brackets, the least of all runs",
        "- whole: mesh in, visible chained strokes out, nothing kept; model kept: the same mesh from a camera that has moved",
        "- file reading and start-up are outside of the clock of both; contours, boundaries, creases; 1920x1080", "",
        "## Time", "", *race_table(race), "",
        "## Agreement with the reference", "",
        "Recall: pieces of the reference, half a pixel each, with ink within 2 px. Precision: ink within 2.5 px of a piece.", "",
        "Bar: the last column, which must be 1.", "",
        *judged_table(judged, covered), "",
        "## Other programs", "",
        "ms / visible lines. In brackets: could not be run here, or only beside other work, so taken from an earlier measurement on another machine of two cores. "
        "Each stands alone, not in turns, and does other work: Freestyle's own clock leaves out the frame it draws into; three-svg-renderer has "
        "creases of 80 to 100 degrees and no fills; larnt is given our kinds of edges and tests them by rays; VTK draws pixels, not strokes; "
        "OpenCascade draws cad_part from its exact surfaces, and of other meshes every edge of every triangle. "
        f"Load average while they ran: {loads(others)}.", "",
        *others_tables(race, others, judged + others_judged), "",
    ]
    folder = os.path.dirname(os.path.abspath(out))
    with tempfile.NamedTemporaryFile("w", dir=folder, delete=False) as file:
        file.write("\n".join(lines))
    os.chmod(file.name, 0o644)
    os.replace(file.name, out)


if __name__ == "__main__":
    main()
