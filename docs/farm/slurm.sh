#!/bin/sh
# Draws a film by npr as an array job of Slurm: every task draws its share of the frames into the same folder.
#
#   sh slurm.sh LENGTH PARTS SCENE [options of npr animate]
#   sh slurm.sh 240 8 hero.vrm --turntable --style manga -o frames/f_####.png
#
# LENGTH is the number of frames of the whole film, PARTS that of the tasks. OUT must be numbered files, in a folder
# that all machines share. The same line again draws what is missing. CPUS (default 4) are those of a task, NPR the
# program.
set -eu
if [ "$#" -lt 3 ]; then
    echo "usage: sh $0 LENGTH PARTS SCENE [options of npr animate]" >&2
    exit 2
fi
length=$1
parts=$2
shift 2

# Outside of a task, submit the tasks.
if [ -z "${SLURM_ARRAY_TASK_ID:-}" ]; then
    sbatch --job-name=npr --cpus-per-task="${CPUS:-4}" --array="0-$((parts - 1))" "$0" "$length" "$parts" "$@"
    exit
fi

# Inside, draw the frames of the task.
first=$((length * SLURM_ARRAY_TASK_ID / parts))
last=$((length * (SLURM_ARRAY_TASK_ID + 1) / parts - 1))
if [ "$first" -gt "$last" ]; then
    exit 0
fi
exec "${NPR:-npr}" animate "$@" --length "$length" --frames "$first..$last" --resume --quiet
