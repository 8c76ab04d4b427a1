#!/usr/bin/env bash
# foam::search alone, with the libraries below it: static on one thread, then shared on several; both installed, moved and found by a
# project of others, whose program has the same spheres from both. Packages that nobody needs are hidden.
# shellcheck source=tests/sdk/fixture.sh
source "$(dirname "$0")/fixture.sh"
[[ -z $FOAM_TEST_SANITIZER ]] || skip "one build with sanitizers is enough"
build=(-S "$FOAM_TEST_SOURCE" -B "$room/foam" -G "$FOAM_TEST_GENERATOR" -DCMAKE_BUILD_TYPE=Debug "-DCMAKE_CXX_FLAGS_DEBUG=-O0 -fpch-preprocess")

# without PACKAGE...: options by which find_package() fails for them.
without() { printf -- '-DCMAKE_DISABLE_FIND_PACKAGE_%s=ON ' "$@"; }
# make_foam FOLDER OPTION...: installed there, built as little as need be.
make_foam() {
    quietly "$FOAM_TEST_CMAKE" "${build[@]}" "${@:2}"
    quietly "$FOAM_TEST_CMAKE" --build "$room/foam" -j 1
    quietly "$FOAM_TEST_CMAKE" --install "$room/foam" --prefix "$room/first"
    mv "$room/first" "$1"
}
refused() {
    local wanted=$1 output
    shift
    ! output=$("$@" 2>&1) || fail "accepted: $*"
    output=$(tr -s ' \n' ' ' <<<"$output") # CMake breaks lines
    [[ $output == *"$wanted"* ]] || fail "'$wanted' expected of: $*"$'\n'"$output"
}

mkdir "$room/project"
cat >"$room/project/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required(VERSION 3.25)
project(spheres LANGUAGES CXX)
find_package(foam REQUIRED COMPONENTS ${COMPONENT})
add_executable(spheres main.cpp)
target_link_libraries(spheres PRIVATE foam::search)
CMAKE
cat >"$room/project/main.cpp" <<'CPP'
#include <foam/search/spherize.hpp>
#include <cstdio>

int main() {
    foam::Mesh box;
    for (int i = 0; i < 8; ++i) {
        box.vertices.push_back({i & 1 ? 0.03 : -0.03, i & 2 ? 0.02 : -0.02, i & 4 ? 0.1 : -0.1});
    }
    box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                     {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    const foam::SphereCover cover = foam::spherize(box, 8, {.effort = foam::Effort::fast});
    for (const foam::Sphere& s : cover.spheres) {
        std::printf("%a %a %a %a\n", s.center.x, s.center.y, s.center.z, s.radius);
    }
    return cover.spheres.size() == 8 && cover.certificate.holds ? 0 : 1;
}
CPP
# spheres_of PREFIX FILE OPTION...
spheres_of() {
    build_project "$room/project" "$2.build" -DCMAKE_PREFIX_PATH="$1" -DCMAKE_BUILD_TYPE=Release -DCOMPONENT=search "${@:3}"
    "$2.build/spheres" >"$2" || fail "no proof"
}

refused "foam has no library serch; remedy: some of base, geometry" "$FOAM_TEST_CMAKE" "${build[@]}" -DFOAM_LIBRARIES=serch
refused "remedy: BUILD_SHARED_LIBS=OFF only with FOAM_LIBRARIES" "$FOAM_TEST_CMAKE" "${build[@]}" -DFOAM_LIBRARIES= -DBUILD_SHARED_LIBS=OFF

read -ra hidden <<<"$(without yaml-cpp EXPAT nlohmann_json GTest CLI11)"
read -ra serial <<<"$(without TBB)"
make_foam "$room/a static one" -DFOAM_LIBRARIES=search -DBUILD_SHARED_LIBS=OFF -DFOAM_TBB=OFF "${hidden[@]}" "${serial[@]}"
[[ -z $(find "$room/a static one" -name '*.so*' -o -name bin) ]] || fail "there is more than libraries: $(find "$room/a static one")"
read -ra hidden_here <<<"$(without Eigen3 TBB yaml-cpp EXPAT nlohmann_json)"
spheres_of "$room/a static one" "$room/static" "${hidden_here[@]}"
refused "foam has no library view; it was built with base, geometry, search" \
    "$FOAM_TEST_CMAKE" -S "$room/project" -B "$room/none" -G "$FOAM_TEST_GENERATOR" -DCMAKE_PREFIX_PATH="$room/a static one" -DCOMPONENT=view
read -ra missing <<<"$(without fmt)"
refused "module fmt called with REQUIRED" \
    "$FOAM_TEST_CMAKE" -S "$room/project" -B "$room/none" -G "$FOAM_TEST_GENERATOR" -DCMAKE_PREFIX_PATH="$room/a static one" -DCOMPONENT=search "${missing[@]}"

# In the same folder: only the scheduler is compiled again.
make_foam "$room/a shared one" -DBUILD_SHARED_LIBS=ON -DFOAM_TBB=ON -DCMAKE_DISABLE_FIND_PACKAGE_TBB=OFF
read -ra hidden_here <<<"$(without fmt Threads PkgConfig Eigen3 TBB yaml-cpp EXPAT nlohmann_json)"
spheres_of "$room/a shared one" "$room/shared" "${hidden_here[@]}"
cmp "$room/static" "$room/shared" || fail "one thread has other spheres than several"
# The soname of versions 0.x has their second number.
config=$(find "$room/a shared one" -name foamConfigVersion.cmake)
version=$(sed -n 's/^set(PACKAGE_VERSION "\([0-9]*\.[0-9]*\)\..*/\1/p' "$config")
if [[ $version == 0.* ]] && command -v readelf >/dev/null; then
    expect "libfoam-search.so.$version]" readelf -d "$(find "$room/a shared one" -name libfoam-search.so)"
fi
