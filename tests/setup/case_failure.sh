#!/usr/bin/env bash
# shellcheck source=tests/setup/fixture.sh
source "$(dirname "$0")/fixture.sh"

# A failed build shows the compiler's message and where the log is, runs nothing, and is tried again the next time.
printf '%s\n' pack-a pack-b >"$installed"
export ninja_fails=1
run_foam version
expect_code 1
expect_out ""
expect_err "thing.cpp:3: error: no"
expect_err "the build failed (whole log: $clone/build/release/build.log)"
unset ninja_fails
run_foam version
expect_code 0
expect_out "ran <version>"

# The program's exit code is handed on.
printf '%s\n' '#!/bin/sh' 'exit 4' >"$clone/build/release/bin/foam"
run_foam version
expect_code 4
