#!/bin/bash
# SPDX-License-Identifier: MIT
# On a machine with a CUDA device: builds for it, runs every CUDA test, and measures, in one go and under nine minutes. What it
# finds stays in docs/results/: gpu-CARD.json (machine, tests, what was left out) and one gpu-CARD-TOPIC.json a topic.
# Environment:
#   SPINDRIFT_GPU_ARCH=native   CUDA architectures to build for, as CMake takes them
#   SPINDRIFT_GPU_BUDGET_S=530  seconds for everything; topics for which no time is left are named
#   SPINDRIFT_GPU_BUILT=COMMIT  build/gpu holds all programs already, built elsewhere from this commit
#   SPINDRIFT_GPU_SMALL=1       small sizes only, into build/gpu-results/: a rehearsal, its times mean nothing
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

architectures=${SPINDRIFT_GPU_ARCH:-native}
budget_s=${SPINDRIFT_GPU_BUDGET_S:-530}
small=${SPINDRIFT_GPU_SMALL:-}
built=${SPINDRIFT_GPU_BUILT:-}
build=build/gpu
results=docs/results
[[ -z $small ]] || results=build/gpu-results
mkdir -p "$build" "$results"

say() { printf '\n== %s (%d s)\n' "$*" $SECONDS; }
left_s() { echo $((budget_s - SECONDS)); }
plain() { tr -c '[:alnum:].+ \n-' ' ' | tr -s ' ' | sed 's/^ //; s/ $//'; }  # fit for JSON and for --benchmark_context

ask_gpu() { nvidia-smi --id=0 --query-gpu="$1" --format=csv,noheader 2> /dev/null | head -1 | plain || true; }
gpu=$(ask_gpu name)
gpu=${gpu:-unknown GPU}
card=$(tr '[:upper:] ' '[:lower:]-' <<< "$gpu")
driver=$(ask_gpu driver_version)
clocks=$(ask_gpu clocks.max.sm,clocks.max.mem)
cpu=$(sed -n 's/^model name.*: //p' /proc/cpuinfo | head -1 | plain)
toolkit=$(nvcc --version 2> /dev/null | sed -n 's/.*release \([0-9.]*\).*/\1/p')
commit=${built:-$(git rev-parse --short=12 HEAD 2> /dev/null || echo unknown)}
[[ -n $built || -z $(git status --porcelain 2> /dev/null) ]] || commit+="+changes"
left_out=()

build_all()
{
    say "build for $architectures"
    cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DSPINDRIFT_CUDA=ON -DCMAKE_CUDA_ARCHITECTURES="$architectures" \
        > "$build/configure.log" 2>&1 || { cat "$build/configure.log" >&2; exit 1; }
    timeout "$(left_s)" cmake --build "$build" --target cuda_tests spindrift spindrift-bench > "$build/build.log" 2>&1 ||
        { tail -40 "$build/build.log" >&2; exit 1; }
}

# Goes on after a failure: what can be measured is still worth having. The exit code tells at the end.
tests=unknown
failed=0
run_tests()
{
    say "tests"
    local skip='^$'
    [[ -z $built ]] || skip='^Install'  # builds a program: not on a machine that cannot build this one
    SPINDRIFT_REQUIRE_CUDA=1 timeout "$(left_s)" ctest --test-dir "$build" -L cuda -E "$skip" -j "$(nproc)" --output-on-failure \
        > "$build/tests.log" 2>&1 || failed=1
    grep -E '^[0-9]+% tests passed|\*\*\*' "$build/tests.log" || tail -5 "$build/tests.log"
    tests=$(sed -n 's/^\([0-9]*% tests passed.*\)/\1/p' "$build/tests.log" | plain)
}

# measure TOPIC SECONDS FILTER SMALL_FILTER: the rows of spindrift-bench that match, in so many seconds at most
measure()
{
    local topic=$1 seconds=$2 filter=$3 log=$build/bench-$1.log
    [[ -z $small ]] || filter=$4 seconds=$budget_s
    ((seconds < $(left_s))) || seconds=$(left_s)
    local bench=$build/bench/spindrift-bench
    say "bench: $topic"
    if [[ -z $("$bench" --benchmark_list_tests --benchmark_filter="$filter" 2> /dev/null) ]]; then
        left_out+=("$topic: no row matches $filter")
    elif (($(left_s) < 20)); then
        left_out+=("$topic: no time left")
    elif ! timeout "$seconds" "$bench" --benchmark_filter="$filter" --benchmark_out="$build/$topic.json" --benchmark_out_format=json \
        --benchmark_context="gpu=$gpu,driver=$driver,cuda=$toolkit,cpu=$cpu,commit=$commit" > "$log" 2>&1; then
        left_out+=("$topic: failed or ran out of time")
        failed=1
        tail -5 "$log"
    else
        cp "$build/$topic.json" "$results/gpu-$card-$topic.json"
        cat "$log"
    fi
}

# study TOPIC OPTION...: a table of spindrift sorts
study()
{
    local topic=$1
    say "sorts: $topic"
    if (($(left_s) < 20)); then
        left_out+=("$topic: no time left")
    elif ! timeout "$(left_s)" "$build/spindrift" sorts --backend cuda "${@:2}" --out "$build/$topic.json" > "$build/$topic.log" 2>&1; then
        left_out+=("$topic: $(tail -1 "$build/$topic.log" | plain)")
        failed=1
    else
        cp "$build/$topic.json" "$results/gpu-$card-$topic.json"
        cat "$build/$topic.log"
    fi
}

# run TOPIC PARTICLES SIZE OPTION...: statistics of a run that draws
run()
{
    local topic=$1 particles=$2 size=$3 frames=120
    if [[ -n $small ]]; then size=160x90 particles=2000 frames=2; fi
    say "run: $topic"
    if (($(left_s) < 20)); then
        left_out+=("$topic: no time left")
    elif ! timeout "$(left_s)" "$build/spindrift" run scenes/town.toml --headless --particles $particles --size $size --frames $frames \
        --out "$build/$topic.png" --stats "$build/$topic.json" "${@:4}" > "$build/run-$topic.log" 2>&1; then
        left_out+=("$topic: $(tail -1 "$build/run-$topic.log" | plain)")
    else
        cp "$build/$topic.json" "$results/gpu-$card-$topic.json"
        tail -2 "$build/run-$topic.log"
    fi
}

[[ -n $built ]] || build_all
say "machine"
"$build/spindrift" info
run_tests
run town-4M-1080p 4000000 1920x1080 --backend cuda
run town-shared 1000000 1280x720 --backend cuda --interop on
run town-copied 1000000 1280x720 --backend cuda --interop off
run town-cpu 1000000 1280x720 --backend cpu
measure advect 80 '^advect/.*/cuda' '^advect/.*/10K/.*/cuda/(iterations|step/kernel|step/graph/(iterations|reorder-16/))'
measure wind 40 '^wind/.*/cuda' '^wind/size/32K/cuda'
if [[ -z $small ]]; then
    study cliff --sizes 1048576,2097152,2202010,4194304 --patterns random --strategies bitonic,cub-radix,cub-merge --frames 9
    study scene --scene town --particles 1000000 --frames 9
    study table-4-1 --table-4-1 --frames 9
else
    study cliff --sizes 4096,4301 --patterns random --strategies bitonic,cub-radix,cub-merge --frames 2
fi
measure sorts 150 '^sort/(random|camera-sweep)/.*/cuda/' '^sort/(random|camera-sweep)/15K/cuda/'

{
    printf '{\n  "gpu": "%s",\n  "driver": "%s",\n  "max_clocks": "%s",\n  "cuda": "%s",\n' "$gpu" "$driver" "$clocks" "$toolkit"
    printf '  "cpu": "%s",\n  "threads": %d,\n  "commit": "%s",\n  "date": "%s",\n' "$cpu" "$(nproc)" "$commit" "$(date -u +%F)"
    printf '  "architectures": "%s",\n  "tests": "%s",\n  "seconds": %d,\n  "left_out": [' "$architectures" "$tests" $SECONDS
    separator=
    for what in "${left_out[@]}"; do
        printf '%s"%s"' "$separator" "$(plain <<< "$what")"
        separator=', '
    done
    printf ']\n}\n'
} > "$results/gpu-$card.json"
say "done: $results/gpu-$card*.json"
cat "$results/gpu-$card.json"
exit $failed
