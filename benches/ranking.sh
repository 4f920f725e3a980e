#!/bin/sh
# Makes the tables of list ranking and linking: a row for each way, a column for each number of nodes or sides.
#
#   benches/ranking.sh [MOST] > benches/results/ranking.md
#
# MOST is the greatest number, 10000000 unless given. Runs `cargo bench -p npr-vector --bench rank`; takes some minutes.
set -eu
cd "$(dirname "$0")/.."

cpu=$(awk -F': ' '/model name/ { print $2; exit }' /proc/cpuinfo)
printf '# List ranking and linking\n\n'
printf -- '- machine: %s cores of %s, %s; load average %s at the start\n' \
    "$(nproc)" "$cpu" "$(rustc --version | cut -d' ' -f1,2)" "$(cut -d' ' -f1 /proc/loadavg)"
printf -- '- code: the commit after %s\n' "$(git rev-parse --short HEAD)"
printf -- '- millions of nodes or sides a second, by the middle estimate of criterion; "serial walk" runs in one thread\n'

NPR_BENCH_MOST=${1:-10000000} cargo bench -q -p npr-vector --bench rank -- --noplot | awk '
    # A name, and the time that follows it on the same line or the next.
    /^(rank|link) / {
        name = $0
        sub(/ *time:.*/, "", name)
    }
    # Not the change since an earlier run, in percent.
    /thrpt:.*elem/ {
        line = $0
        sub(/.*\[/, "", line)
        split(line, words, " ")
        rate = words[3]
        unit = words[4]
        if (unit ~ /^K/) rate /= 1000
        if (unit ~ /^G/) rate *= 1000
        if (unit ~ /^elem/) rate /= 1000000
        split(name, path, "/")
        if (!(path[1] in seen)) {
            seen[path[1]] = 1
            groups[++group_count] = path[1]
        }
        if (!((path[1], path[2]) in known)) {
            known[path[1], path[2]] = 1
            ways[path[1]] = ways[path[1]] "/" path[2]
        }
        if (!(path[3] in counted)) {
            counted[path[3]] = 1
            counts[++count_count] = path[3]
        }
        rates[path[1], path[2], path[3]] = rate
    }
    END {
        for (g = 1; g <= group_count; g++) {
            group = groups[g]
            printf "\n## %s%s\n\n| way |", toupper(substr(group, 1, 1)), substr(group, 2)
            for (c = 1; c <= count_count; c++) printf " %d |", counts[c]
            printf "\n|---|"
            for (c = 1; c <= count_count; c++) printf "---:|"
            n = split(substr(ways[group], 2), list, "/")
            for (w = 1; w <= n; w++) {
                printf "\n| %s |", list[w]
                for (c = 1; c <= count_count; c++) printf " %.3g |", rates[group, list[w], counts[c]]
            }
            printf "\n"
        }
    }'
