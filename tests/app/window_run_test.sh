#!/bin/bash
# SPDX-License-Identifier: MIT
# A run in a window, on a virtual display of its own: COMMAND SCENE [OPTION...]. It ends after --frames, and whole on SIGINT. Exit 77: no Xvfb here.
set -euo pipefail
command=$1
scene=$2
more=("${@:3}")
command -v Xvfb > /dev/null || exit 77
work=$(mktemp -d)
mkfifo "$work/display"
Xvfb -displayfd 3 -screen 0 800x600x24 -nolisten tcp 3> "$work/display" 2> "$work/xvfb.log" &
xvfb=$!
trap 'kill $xvfb; rm -rf "$work"' EXIT
read -r -t 30 number < "$work/display"
export DISPLAY=:$number

# Drivers of windows are unloaded before the leak sanitizer looks, which then cannot tell whose memory it sees.
export ASAN_OPTIONS=${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0
run=("$command" run "$scene" --particles 2000 --size 160x120 "${more[@]}")
"${run[@]}" --frames 5 --stats "$work/stats.json" > "$work/out"
grep -q '5 frames' "$work/out"
grep -q '"platform": "GLFW"' "$work/stats.json"

"${run[@]}" --stats "$work/interrupted.json" > "$work/out" &
pid=$!
sleep 3
kill -INT $pid
code=0
wait $pid || code=$?
[[ $code == 130 ]] || { echo "exit code $code, not 130"; cat "$work/out"; exit 1; }
grep -q '"interrupted": true' "$work/interrupted.json"
echo "all well"
