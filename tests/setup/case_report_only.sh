#!/usr/bin/env bash
# shellcheck source=tests/setup/fixture.sh
source "$(dirname "$0")/fixture.sh"

# FOAM_NO_INSTALL=1 names what is missing and the exact command, and touches nothing.
echo pack-a >"$installed"
export FOAM_NO_INSTALL=1
run_foam version
expect_code 2
expect_out ""
expect_err "1 Debian packages are missing: pack-b"
expect_err "  apt-get install -y --no-install-recommends pack-b"
expect_no_call '^apt-get'
expect_no_call '^cmake'

# With everything there it builds and runs.
echo pack-b >>"$installed"
run_foam version
expect_code 0
expect_out "ran <version>"

# ./foam packages names them, and installs nothing.
: >"$calls"
run_foam packages run tests
expect_code 0
expect_out pack-t
run_foam packages nothing
expect_code 2
expect_err "dependencies.txt has no group nothing; it has: run python bench"
expect_no_call "^apt-get"
