#!/usr/bin/env bash
# The scripts of the repository are free of what shellcheck finds.
set -euo pipefail
command -v shellcheck >/dev/null || exit 77
cd -- "$1"
shellcheck -x foam .ci/run tests/setup/*.sh tests/embedded/*.sh
