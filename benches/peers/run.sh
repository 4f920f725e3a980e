#!/bin/sh
# run.sh HARNESS WORK [mesh ...]: our lines beside Blender's Line Art, on the same meshes and in the same minutes.
#
# HARNESS  folder of the comparison: make_meshes.py, visref, compare_lines.py, blender_lineart.py, peer_common.py
# WORK     folder for meshes, references and pictures; what is there already is used
# Needs    python3 with numpy, scipy and pillow as PY (to make meshes also trimesh, networkx, cadquery), python3 with
#          bpy 4.5 as BPY, and rsvg-convert. ROUNDS (default 3) is how often the two take turns. All other programs are run
#          by others.sh afterwards; OTHERS="" leaves them out and keeps what an earlier run found.
# Writes   WORK/out/*.svg and *.png, WORK/*.jsonl, and benches/results/lines_peers.md.
set -eu
[ $# -ge 2 ] || { sed -n '2,10p' "$0" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
harness=$(cd "$1" && pwd)
mkdir -p "$2"
work=$(cd "$2" && pwd)
shift 2
[ $# -gt 0 ] || set -- suzanne_1k cad_part towers_1728 ico_20k suzanne_63k ico_80k bumpy_80k knot_100k suzanne_252k ico_320k bumpy_320k
PY=${PY:-python3}
BPY=${BPY:-python3}
ROUNDS=${ROUNDS:-3}
target=${CARGO_TARGET_DIR:-$root/target}
mkdir -p "$work/out" "$work/meshes" "$work/ref"

(cd "$root" && cargo build -q --release -p npr-cli -p npr-benches --bins)
[ -f "$work/meshes/meshes.json" ] || "$PY" "$harness/make_meshes.py" "$work/meshes" --bpy-python "$(command -v "$BPY")"

# The benchmark's eye: 3.5 units from the origin towards (0.6, 0.45, 1).
eye=1.68,1.26,2.8

judge() { "$PY" "$harness/compare_lines.py" "$work/ref/$1.csv" "$2" | sed -n 's/^PEER //p' >>"$work/judged.jsonl"; }

: >"$work/judged.jsonl"
: >"$work/race.jsonl"
: >"$work/covered.jsonl"
for mesh; do
    obj=$work/meshes/$mesh.obj
    if [ ! -s "$work/ref/$mesh.csv" ]; then
        (cd "$harness/visref" && CARGO_TARGET_DIR="$work/visref" cargo build -q --release)
        "$work/visref/release/visref" "$obj" "$work/ref/$mesh.svg" "$work/ref/$mesh.csv" >/dev/null
    fi

    # Take turns, so that whatever else the machine does touches both alike.
    round=0
    while [ "$round" -lt "$ROUNDS" ]; do
        round=$((round + 1))
        echo "$mesh: round $round of $ROUNDS" >&2
        "$BPY" "$harness/blender_lineart.py" "$obj" "$work/out/lineart_$mesh.svg" 5 2>/dev/null | sed -n 's/^PEER //p' >>"$work/race.jsonl"
        "$target/release/lines_race" "$obj" 7 | sed -n 's/^PEER //p' >>"$work/race.jsonl"
    done

    "$target/release/npr" lines "$obj" -o "$work/out/npr_$mesh.svg" --quiet --eye $eye --target 0,0,0 --fov 35 \
        --size 1920x1080 --crease 45.57 --crease-from faces --kinds contour,boundary,crease --method edges --smooth off
    for program in lineart npr; do
        rsvg-convert "$work/out/${program}_$mesh.svg" -b white -o "$work/out/${program}_$mesh.png"
        judge "$mesh" "$work/out/${program}_$mesh.png"
    done
    "$PY" "$here/covered.py" "$mesh" "$work/out/npr_$mesh.png" "$work/out/lineart_$mesh.png" >>"$work/covered.jsonl"
done

# Programs that draw something else or slowly stand alone: they are compared by what they draw, their times roughly.
PY=$PY BPY=$BPY "$here/others.sh" "$harness" "$work" "$@"

"$PY" "$here/table.py" "$work" "$root/benches/results/lines_peers.md" "$root"
