#!/bin/bash
# SPDX-License-Identifier: MIT
# COMMAND none|some: whether the program needs the CUDA runtime or has symbols of it or of our CUDA part. A build without CUDA has none;
# one with it has some, which shows that this test would see them.
set -euo pipefail
command=$1
expected=$2
traces=$({ ldd "$command"; nm -C "$command"; } | grep -E 'libcuda|\bcuda[A-Z][A-Za-z]+|\bspindrift::gpu::' || true)
found=none
[[ -z $traces ]] || found=some
[[ $found == "$expected" ]] || { echo "traces of CUDA: $found, not $expected"; head -20 <<< "$traces"; exit 1; }
