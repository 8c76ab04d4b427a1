#!/usr/bin/env bash
# shellcheck source=tests/setup/fixture.sh
source "$(dirname "$0")/fixture.sh"

# As root: apt-get update, then install, then configure and build; arguments reach the program as they are.
run_foam run "a b.yaml" --set 'x=*'
expect_code 0
expect_out 'ran <run> <a b.yaml> <--set> <x=*>'
expect_err "2 Debian packages are missing: pack-a pack-b"
expect_call "apt-get -o DPkg::Lock::Timeout=600 update"
expect_call "apt-get -o DPkg::Lock::Timeout=600 install -y --no-install-recommends pack-a pack-b"
expect_no_call '^sudo'
expect_call "-DCMAKE_BUILD_TYPE=Release -DFOAM_TESTS=OFF"

# As another user: by sudo; without sudo the command is named.
rm -r "$clone/build"
: >"$installed"
export user_id=1000
run_foam version
expect_code 0
expect_call "sudo apt-get -o DPkg::Lock::Timeout=600 update"
rm -r "$clone/build" "$tools/sudo"
: >"$installed"
export user_id=1000
run_foam version
expect_code 2
expect_err "apt-get update && apt-get install -y --no-install-recommends pack-a pack-b"

# apt-get's own words are shown when it fails.
unset user_id
export apt_fails=1
run_foam version
expect_code 2
expect_err "E: no network"
expect_err "could not install the packages"
