#!/usr/bin/env bash
# What the first `./foam run` builds compiles: libraries and plugins whose sources are compiled together (FOAM_UNITY).
# Without optimisation: names that clash are all that can go wrong here.
set -euo pipefail
source=$(cd "$(dirname "$0")/../.." && pwd)
room=$(mktemp -d)
trap 'rm -rf "$room"' EXIT
cmake -S "$source" -B "$room" -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O0 -DFOAM_TESTS=OFF -DFOAM_UNITY=ON > "$room/log" ||
    { cat "$room/log"; exit 1; }
cmake --build "$room" -j "${FOAM_JOBS:-1}" --target core/all plugins/all apps/foam/all >> "$room/log" || { grep -a "error" "$room/log" | head -20; exit 1; }
echo "it compiles"
