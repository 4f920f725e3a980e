#!/bin/sh
# others.sh HARNESS WORK [mesh ...]: every other program that draws visible lines, each on its own, on the meshes of run.sh.
#
# HARNESS, WORK, PY, BPY  as for run.sh, which makes meshes and references and calls this; PY also needs vtk and cadquery
# Needs    cargo (larnt), node and npm (three-svg-renderer); what cannot be installed or stops is left out
# OTHERS   which ones (default: freestyle larnt vtk occ tsr); RUNS (default 5) is how often each draws a mesh
# Writes   WORK/out/*.png, WORK/others.jsonl and WORK/others_judged.jsonl; lines that are there already for other programs are kept
set -u
[ $# -ge 2 ] || { sed -n '2,8p' "$0" >&2; exit 2; }
harness=$(cd "$1" && pwd)
work=$(cd "$2" && pwd)
shift 2
[ $# -gt 0 ] || set -- suzanne_1k cad_part towers_1728 ico_20k suzanne_63k ico_80k bumpy_80k knot_100k suzanne_252k ico_320k bumpy_320k
PY=${PY:-python3}
BPY=${BPY:-python3}
RUNS=${RUNS:-5}
OTHERS=${OTHERS-freestyle larnt vtk occ tsr}

# Nothing takes longer than ten minutes: what does is left out.
keep() { timeout 600 "$@" 2>>"$work/others.log" | sed -n 's/^PEER //p' >>"$work/others.jsonl"; }
judge() {
    [ -s "$2" ] || return 0
    case $2 in *.svg) rsvg-convert "$2" -b white -o "${2%.*}.png" ;; esac
    "$PY" "$harness/compare_lines.py" "$work/ref/$1.csv" "${2%.*}.png" | sed -n 's/^PEER //p' >>"$work/others_judged.jsonl"
}
forget() { for file in others.jsonl others_judged.jsonl; do [ ! -f "$work/$file" ] || sed -i "/\"\(peer\|drawing\)\": *\"\($1\)/d" "$work/$file"; done; }

for program in $OTHERS; do
    echo "$program" >&2
    case $program in
    freestyle)
        forget 'blender-freestyle\|freestyle_'
        for mesh; do
            keep "$BPY" "$harness/blender_freestyle.py" "$work/meshes/$mesh.obj" "$work/out/freestyle_$mesh.png" "$RUNS"
            judge "$mesh" "$work/out/freestyle_$mesh.png"
        done ;;
    larnt)
        forget larnt
        # Built from a copy: the harness may be read-only, and cargo writes a lock file beside the manifest.
        mkdir -p "$work/larnt_src"
        cp -r "$harness/larnt_bench/." "$work/larnt_src"
        chmod -R u+w "$work/larnt_src"
        (cd "$work/larnt_src" && CARGO_TARGET_DIR="$work/larnt" timeout 600 cargo build -q --release) || continue
        for mesh; do
            keep "$work/larnt/release/larnt_bench" "$work/meshes/$mesh.obj" "$work/out/larnt_$mesh.svg" "$RUNS"
            judge "$mesh" "$work/out/larnt_$mesh.svg"
        done ;;
    vtk)
        forget vtk
        for mesh; do
            keep "$PY" "$harness/vtk_lines.py" "$work/meshes/$mesh.obj" "$work/out/vtk_$mesh.png" "$RUNS"
            judge "$mesh" "$work/out/vtk_$mesh.png"
        done ;;
    occ)
        # On triangles it draws every edge of every triangle, in another projection: times only.
        forget occ
        keep "$PY" "$harness/occ_hlr.py" "$work/meshes/cad_part.step" "$work/out/occ_cad_part.svg" "$RUNS"
        for mesh in suzanne_1k towers_1728; do
            keep "$PY" "$harness/occ_hlr.py" "$work/meshes/$mesh.obj" "$work/out/occ_$mesh.svg" "$RUNS" --exact
        done ;;
    tsr)
        forget 'three-svg-renderer\|tsr_'
        for mesh; do
            keep sh "$harness/three_svg/run.sh" "$work/tsr_work" "$work/meshes/$mesh.obj" "$work/out/tsr_$mesh.svg" "$RUNS"
            judge "$mesh" "$work/out/tsr_$mesh.svg"
        done ;;
    esac
done
