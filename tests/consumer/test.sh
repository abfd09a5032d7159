#!/bin/bash
# SPDX-License-Identifier: MIT
# Installs this build into a fresh prefix, builds the consumer against it, and runs both programs from there.
set -euo pipefail
source=$1
build=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

DESTDIR='' cmake --install "$build" --prefix "$work/prefix" > "$work/install.log"
generator=$(sed -n 's/^CMAKE_GENERATOR:INTERNAL=//p' "$build/CMakeCache.txt")
compiler=$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt")
cmake -S "$source/tests/consumer" -B "$work/build" -G "$generator" -DCMAKE_CXX_COMPILER="$compiler" \
    -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Release
cmake --build "$work/build"

cd "$work"
scene=$work/prefix/share/spindrift/scenes/sheet.toml
"$work/build/consumer" "$scene"
"$work/prefix/bin/spindrift" run sheet --headless --particles 1000 --steps 3 --hash
"$work/prefix/bin/spindrift" run "$scene" --headless --particles 1000 --steps 3 --hash
