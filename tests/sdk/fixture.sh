# shellcheck shell=bash
# A folder of the test's own, and what its steps have in common.
set -euo pipefail
unset FOAM_PLUGIN_PATH FOAM_PACKAGE_PATH CMAKE_PREFIX_PATH foam_DIR DESTDIR CXX CXXFLAGS LDFLAGS
room=$(mktemp -d)
trap 'rm -rf -- "$room"' EXIT
export XDG_CACHE_HOME=$room/cache HOME=$room
# Where there is ccache, what has not changed since the last run of the tests is not compiled again.
if command -v ccache >/dev/null; then
    export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache CCACHE_DIR=$FOAM_TEST_BUILD/tests/ccache \
        CCACHE_BASEDIR=$room CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_MAXSIZE=500M
    unset CCACHE_CONFIGPATH CCACHE_DISABLE CCACHE_READONLY
fi

fail() {
    printf 'FAILED: %s\n' "$*" >&2
    exit 1
}
skip() {
    printf 'skipped: %s\n' "$*"
    exit 77
}
# expect TEXT COMMAND...: the command succeeds and prints TEXT.
expect() {
    local wanted=$1 output
    shift
    output=$("$@" 2>&1) || fail "it failed: $*"$'\n'"$output"
    [[ $output == *"$wanted"* ]] || fail "'$wanted' expected of: $*"$'\n'"$output"
}
# quietly COMMAND...: its output is shown only if it fails.
quietly() {
    local code=0
    "$@" >"$room/log" 2>&1 || code=$?
    [[ $code == 0 ]] || fail "exit code $code of: $*"$'\n'"$(cat "$room/log")"
}
# install_foam FOLDER COMPONENT...
install_foam() {
    local component
    for component in "${@:2}"; do
        quietly "$FOAM_TEST_CMAKE" --install "$FOAM_TEST_BUILD" --prefix "$1" --component "$component"
    done
}
# build_project SOURCE FOLDER OPTION...: optimised as little as gives a usable program.
build_project() {
    quietly "$FOAM_TEST_CMAKE" -S "$1" -B "$2" -G "$FOAM_TEST_GENERATOR" -DCMAKE_CXX_FLAGS_RELEASE=-O1 "${@:3}"
    quietly "$FOAM_TEST_CMAKE" --build "$2" -j 1
}
# A mesh to work on: the L of a bracket is enough to tell methods apart.
write_part() {
    cat >"$1" <<'OBJ'
v 0 0 0
v 0.2 0 0
v 0.2 0 0.05
v 0.05 0 0.05
v 0.05 0 0.15
v 0 0 0.15
v 0 0.1 0
v 0.2 0.1 0
v 0.2 0.1 0.05
v 0.05 0.1 0.05
v 0.05 0.1 0.15
v 0 0.1 0.15
f 1 2 3 4
f 1 4 5 6
f 10 9 8 7
f 12 11 10 7
f 1 7 8 2
f 2 8 9 3
f 3 9 10 4
f 4 10 11 5
f 5 11 12 6
f 6 12 7 1
OBJ
}
