#!/usr/bin/env bash
# shellcheck source=tests/setup/fixture.sh
source "$(dirname "$0")/fixture.sh"

# Without apt-get the packages are listed; the build is tried if the tools for it are there.
rm "$tools/apt-get"
run_foam version
expect_code 0
expect_out "ran <version>"
expect_err "this is not Debian"
expect_err "  pack-a pack-b"
run_foam test
expect_code 0
[[ $err != *pack-c* ]] || fail "packages that tests can do without are not asked for"
rm -r "$clone/build" "$tools/ninja"
run_foam version
expect_code 2
expect_err "ninja is not there: stopping."
