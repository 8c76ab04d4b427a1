#!/usr/bin/env bash
# What each component holds, and that the program says what is not installed.
# shellcheck source=tests/sdk/fixture.sh
source "$(dirname "$0")/fixture.sh"

install_foam "$room/runtime" runtime
foam=$room/runtime/bin/foam
[[ -f $foam && -f $room/runtime/share/foam/configs/panda_22.yaml ]] || fail "program or recipes are missing"
[[ ! -e $room/runtime/include ]] || fail "headers are installed with the program"
licences=$("$foam" plugins)
[[ $licences == *spherize_octree* && $licences != *GPL* ]] || fail "a plugin under the GPL in the runtime: $licences"
code=0
message=$("$foam" sdk 2>&1) || code=$?
[[ $code == 2 && $message == "foam: error: the SDK is not installed: there is no $room/runtime/lib"*"/cmake/foam/foamConfig.cmake; remedy: install the package foam-dev, or \`cmake --install\` with the component sdk" ]] ||
    fail "exit code $code: $message"

install_foam "$room/sdk" sdk
[[ -f $room/sdk/include/foam/sdk/plugin.hpp && ! -e $room/sdk/bin ]] || fail "the sdk is not just headers and CMake files"

# All of the GPL component is under the GPL.
install_foam "$room/gpl" gpl
shopt -s nullglob globstar
for plugin in "$room"/gpl/**/*.so; do
    expect "GPL" "$foam" plugins --plugin "$plugin"
done
