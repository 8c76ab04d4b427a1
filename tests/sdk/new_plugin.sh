#!/usr/bin/env bash
# new_plugin.sh STAGE: the project that `foam new-plugin STAGE` writes configures, builds and passes its own tests at once, against
# the build folder; the program lists the plugin and its recipes run.
# shellcheck source=tests/sdk/fixture.sh
source "$(dirname "$0")/fixture.sh"
stage=$1 plugin=${1/./_}
foam=$FOAM_TEST_BUILD/bin/foam

cd "$room"
expect "$plugin is written. Next:" "$foam" new-plugin "$stage"
build_project "$room/$plugin" "$room/$plugin/build" -DCMAKE_PREFIX_PATH="$("$foam" sdk)"
quietly ctest --test-dir "$plugin/build" --output-on-failure --no-tests=error
! grep -rn '@[a-z]*@' "$plugin" --include='*.cpp' --include='*.md' --include='*.yaml' --include=CMakeLists.txt --exclude-dir=build ||
    fail "a placeholder is left"

cd "$plugin"
expect "$stage" "$foam" plugins --plugin-dir build
FOAM_PLUGIN_PATH=$PWD/build expect "$stage" "$foam" plugins
expect "plugin $plugin 0.1" "$foam" describe "$stage" --plugin-dir build
if [[ -f recipe.yaml ]]; then
    expect "Proved" "$foam" run recipe.yaml --plugin-dir build
else
    expect "mine" "$foam" evaluate robot.urdf part.mine --plugin-dir build
    expect "Certified" "$foam" certify robot.urdf part.mine --plugin-dir build
fi
if [[ -f compare.yaml ]]; then
    expect "valid, 2 runs" "$foam" check compare.yaml --plugin-dir build
fi
