#!/usr/bin/env bash
# changed_library.sh LIBRARY: the cache keeps results of two builds of a library apart; the manifest names the builds.
# shellcheck source=tests/sdk/fixture.sh
source "$(dirname "$0")/../sdk/fixture.sh"
foam=$FOAM_TEST_BUILD/bin/foam
write_part "$room/part.obj"
cat >"$room/part.yaml" <<'YAML'
foam: 1
mesh: part.obj
stages: [spherize.cover: {effort: fast}]
budget: {spheres: 4}
outputs: [write.json: {file: spheres.json}]
YAML
cd "$room"

# made NAME [VARIABLE=VALUE]: runs the recipe.
made() {
    quietly env "${@:2}" "$foam" run part.yaml --run-dir "$1"
}
made one
made one_again
cmp one/spheres.json one_again/spheres.json || fail "the same build gives other spheres"
grep -q '"cached": true' one_again/manifest.json || fail "the same build does not use the cache"

made other "LD_PRELOAD=$1"
if cmp -s one/spheres.json other/spheres.json; then
    fail "the changed library gives the spheres of the old one"
fi
made other_again "LD_PRELOAD=$1"
cmp other/spheres.json other_again/spheres.json || fail "the changed library gives other spheres the second time"
made one_more
cmp one/spheres.json one_more/spheres.json || fail "the old library gives spheres of the changed one"

build_of() {
    sed -n 's/.*"foam_build": "\(.*\)",/\1/p' "$1/manifest.json"
}
[[ $(build_of one) == *"libfoam-search.so"* ]] || fail "no build in the manifest: $(build_of one)"
[[ $(build_of one) == "$(build_of one_more)" ]] || fail "one build has two names"
[[ $(build_of one) != "$(build_of other)" ]] || fail "two builds have one name"
