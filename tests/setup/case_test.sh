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
expect_no_call "pack-o" # which Debian 13 does not have
# The program is then up to date, and stays configured with tests.
run_foam version
expect_calls ninja 2
expect_calls cmake 2

# Packages of consumers and of npm are installed, too; without them the tests go on.
expect_call "install -y --no-install-recommends pack-p pack-e pack-q pack-c"
node=$clone/build/release/tests/consumers/node
mkdir -p "$node"
touch "$node/package-lock.json"
stand_in npm <<'END'
[[ -z ${npm_fails:-} ]] || { echo "npm error network"; exit 1; }
mkdir -p "${!#}/node_modules"
touch "${!#}/node_modules/.package-lock.json"
END
npm_fails=1 run_foam test
expect_code 0
expect_err "npm could not install the packages for tests, which are skipped"
FOAM_NO_INSTALL=1 run_foam test
expect_code 0
expect_err "npm ci --ignore-scripts --no-audit --no-fund --fetch-retries=1 --prefix $node"
expect_calls npm 1
touch -d '1 hour ago' "$node/package-lock.json"
run_foam test
expect_calls npm 2
run_foam test
expect_calls npm 2
# The folder of the browser's packages is another.
browser=$clone/build/release/tests/view/browser
mkdir -p "$browser"
touch -d '1 hour ago' "$browser/package-lock.json"
run_foam test
expect_call "--prefix $browser"
expect_calls npm 3
: >"$installed"
printf '%s\n' pack-a pack-b pack-t >"$installed"
FOAM_NO_INSTALL=1 run_foam test
expect_code 0
expect_err "the tests that need these packages are skipped"

# A group for Debian 12 alone belongs to its group there.
printf '%s\n' 'VERSION_ID="12"' >"$FOAM_OS_RELEASE"
run_foam test
expect_code 0
expect_call "install -y --no-install-recommends pack-p pack-e pack-q pack-c pack-o"
