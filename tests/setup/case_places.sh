#!/usr/bin/env bash
# shellcheck source=tests/setup/fixture.sh
source "$(dirname "$0")/fixture.sh"

# Through symbolic links, from any folder, into another build folder.
printf '%s\n' pack-a pack-b >"$installed"
mkdir "$room/bin dir"
ln -s "$clone/foam" "$room/first link"
ln -s "../first link" "$room/bin dir/foam"
cd /
entry="$room/bin dir/foam" run_foam version
expect_code 0
expect_out "ran <version>"
expect_call "-S $clone -B $clone/build/release"
cd "$room"
export FOAM_BUILD_DIR="other build"
run_foam version
expect_code 0
expect_call "-B $room/other build"
