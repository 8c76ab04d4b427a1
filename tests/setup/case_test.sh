#!/usr/bin/env bash
# shellcheck source=tests/setup/fixture.sh
source "$(dirname "$0")/fixture.sh"

# ./foam test turns the tests on in the same build folder, builds all, and hands its arguments to ctest.
printf '%s\n' pack-a pack-b >"$installed"
run_foam version
expect_call "ninja -C $clone/build/release"
expect_call "core/all plugins/all apps/foam/all"
expect_no_call "^apt-get"
run_foam test -R mesh
expect_code 0
expect_call "install -y --no-install-recommends pack-t"
expect_no_call "^apt-get.*pack-[abd]"
expect_out "100% tests passed"
expect_call "-DFOAM_TESTS=ON"
expect_call "--output-on-failure -R mesh"
# The program is then up to date, and stays configured with tests.
run_foam version
expect_calls ninja 2
expect_calls cmake 2
