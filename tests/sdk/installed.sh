#!/usr/bin/env bash
# installed.sh COMPILER: foam is installed and the installation moved; two of our own plugins and the worked example are built against it out of tree
# by the CMakeLists that build them in tree, give the bytes of the installed ones, and are installed beside them.
# shellcheck source=tests/sdk/fixture.sh
source "$(dirname "$0")/fixture.sh"
compiler=$(command -v "$1") || skip "there is no $1"
[[ -z $FOAM_TEST_SANITIZER || $1 == g++ ]] || skip "sanitizers of different compilers do not mix"

install_foam "$room/first" runtime sdk
mv "$room/first" "$room/a folder"
prefix="$room/a folder"
foam=$prefix/bin/foam
expect "$prefix" "$foam" sdk
expect "loaded from $prefix/lib" "$foam" plugins --why
write_part "$room/part.obj"
quietly "$foam" spherize "$room/part.obj" -n 6 -m octree -o "$room/shipped.json"

# Without the shipped ones, whose stages bear the same names.
mkdir "$room/aside"
for plugin in spherize_octree smooth; do
    mv "$prefix"/lib*/foam/plugins/$plugin.so "$room/aside" 2>/dev/null || mv "$prefix"/lib/*/foam/plugins/$plugin.so "$room/aside"
    build_project "$FOAM_TEST_SOURCE/plugins/$plugin" "$room/build/$plugin" \
        -DCMAKE_PREFIX_PATH="$("$foam" sdk)" -DCMAKE_CXX_COMPILER="$compiler"
    [[ -f $room/build/$plugin/$plugin.so ]] || fail "$plugin.so is not in the build folder"
done
mine=(--plugin "$room/build/spherize_octree/spherize_octree.so" --plugin-dir "$room/build/smooth")
expect "spherize.octree" "$foam" plugins "${mine[@]}"
expect "smooth.humphrey" "$foam" plugins "${mine[@]}"
quietly "$foam" spherize "$room/part.obj" -n 6 -m octree -o "$room/mine.json" "${mine[@]}"
cmp "$room/shipped.json" "$room/mine.json" || fail "the plugins built out of tree by $1 give other bytes"

# The worked example, which is not among the installed ones.
build_project "$FOAM_TEST_SOURCE/docs/examples/spherize_axis_split" "$room/build/example" \
    -DCMAKE_PREFIX_PATH="$("$foam" sdk)" -DCMAKE_CXX_COMPILER="$compiler"
quietly ctest --test-dir "$room/build/example" --output-on-failure --no-tests=error -R contract
expect "Proved" "$foam" spherize "$room/part.obj" -n 6 -m axis_split --plugin-dir "$room/build/example" -o "$room/split.json"

# A program that calls foam.
build_project "$FOAM_TEST_SOURCE/docs/examples/in_the_loop" "$room/build/in_the_loop" \
    -DCMAKE_PREFIX_PATH="$("$foam" sdk)" -DCMAKE_CXX_COMPILER="$compiler"
expect "proved: the box lies inside" "$room/build/in_the_loop/in_the_loop"
loaded=$(ldd "$room/build/in_the_loop/in_the_loop")
[[ $loaded == *libfoam-search* ]] || fail "it does not link foam::search: $loaded"
[[ ! $loaded =~ yaml|expat|json|foam-(robot|sdk|recipe|report|runtime|judge) ]] || fail "foam::search brings more than geometry and base: $loaded"

# Installed beside the others they are found without a word.
quietly "$FOAM_TEST_CMAKE" --install "$room/build/spherize_octree" --prefix "$prefix"
expect "spherize.octree" "$foam" plugins
