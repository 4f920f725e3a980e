#!/usr/bin/env python3
"""table.py RACE.jsonl JUDGED.jsonl OUT.md ROOT: times and agreement of two programs, side by side.

Times are the median over all rounds of each round's median; `min` is the least time of any run."""
import json
import os
import statistics
import subprocess
import sys
import tempfile


def rows(path):
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


def judged_table(judged):
    meshes = list(dict.fromkeys(r["drawing"].removesuffix(".png").split("_", 1)[1] for r in judged))
    at = {tuple(r["drawing"].removesuffix(".png").split("_", 1)): r for r in judged}
    yield "| mesh | recall: Line Art | ours | precision: Line Art | ours | missing pieces: Line Art | ours | false px: Line Art | ours |"
    yield "|---|" + "---:|" * 8
    for mesh in meshes:
        pair = [at.get((program, mesh)) for program in ("lineart", "npr")]
        if None in pair:
            continue
        cells = [mesh]
        for key, form in (("recall", "{:.5f}"), ("precision", "{:.5f}"), ("missing_pieces", "{}"), ("false_px", "{}")):
            cells += [form.format(r[key]) for r in pair]
        yield "| " + " | ".join(cells) + " |"


def processor():
    try:
        with open("/proc/cpuinfo") as file:
            return next(line.split(": ", 1)[1].strip() for line in file if line.startswith("model name"))
    except (OSError, StopIteration):
        return "an unknown processor"


def main():
    race_path, judged_path, out, root = sys.argv[1:]
    race, judged = rows(race_path), rows(judged_path)
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
        *judged_table(judged), "",
    ]
    folder = os.path.dirname(os.path.abspath(out))
    with tempfile.NamedTemporaryFile("w", dir=folder, delete=False) as file:
        file.write("\n".join(lines))
    os.chmod(file.name, 0o644)
    os.replace(file.name, out)


if __name__ == "__main__":
    main()
