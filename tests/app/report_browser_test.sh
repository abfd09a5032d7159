#!/bin/bash
# SPDX-License-Identifier: MIT
# The report in a browser: COMMAND. It lays out its curves, and asks for nothing. Exit 77: no Chromium here.
set -euo pipefail
command=$1
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)
[[ -n $browser ]] || { echo "skipped: no Chromium here"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$command" report -o "$work/report.html" --particles 200 --cells 16 2> "$work/progress"
chrome() { "$browser" --headless --no-sandbox --disable-gpu --user-data-dir="$work/profile" --virtual-time-budget=5000 "$@" 2> "$work/log"; }
chrome --dump-dom "file://$work/report.html" > "$work/dom.html"
for id in advection-time advection-step advection-field solver; do
    grep -q "<svg id=\"$id\"" "$work/dom.html" || { echo "no curve $id"; exit 1; }
done
grep -q 'class="default"' "$work/dom.html"
chrome --window-size=900,2400 --screenshot="$work/report.png" "file://$work/report.html"
[[ $(stat -c %s "$work/report.png") -gt 20000 ]] || { echo "an empty picture"; exit 1; }
echo "all well"
