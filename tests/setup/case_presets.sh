#!/usr/bin/env bash
# Every preset of CMakePresets.json can be configured; that of the fuzz targets where there is clang.
set -euo pipefail
source_root=$1
room=$(mktemp -d)
trap 'rm -rf -- "$room"' EXIT
cd "$source_root"
for preset in release debug asan tsan no-gpl fuzz; do
    [[ $preset != fuzz ]] || command -v clang++ >/dev/null || continue
    cmake --preset "$preset" -B "$room/$preset" -DFOAM_TESTS=OFF >"$room/log" 2>&1 || {
        tail -n 20 "$room/log"
        echo "FAILED: the preset $preset cannot be configured" >&2
        exit 1
    }
done
