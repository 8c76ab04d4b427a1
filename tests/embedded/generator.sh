#!/usr/bin/env bash
# The committed meshes are what the committed generator writes, byte by byte.
set -euo pipefail
robot=$1/configs/robots/panda
command -v python3 >/dev/null || exit 77
folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
LC_ALL=C python3 -B "$robot/generate.py" "$folder"
diff -r "$folder" "$robot/meshes"
