#!/usr/bin/env bash
# The example in Rust, built by cargo against an installed SDK.
export RUSTUP_HOME=${RUSTUP_HOME:-$HOME/.rustup} # rustup's cargo looks there, and the test has a home of its own
# shellcheck source=tests/sdk/fixture.sh
source "$(dirname "$0")/fixture.sh"
[[ -z $FOAM_TEST_SANITIZER ]] || skip "the library of a sanitizer would have to be loaded first"
command -v pkg-config >/dev/null || skip "there is no pkg-config"
if ! command -v cargo >/dev/null || ! cargo --version >/dev/null 2>&1; then
    [[ -z ${CI:-} ]] || fail "there is no cargo"
    skip "there is no cargo"
fi

install_foam "$room/foam" runtime sdk
libraries=$(dirname "$(find "$room/foam" -name libfoam-c.so)")
export PKG_CONFIG_PATH=$libraries/pkgconfig
cp -r "$FOAM_TEST_SOURCE/docs/examples/rust" "$room/rust"
quietly cargo build --quiet --offline --manifest-path "$room/rust/Cargo.toml" --target-dir "$room/target"
said=$("$room/target/debug/box-by-spheres" | sed 's/at \[.*\]:/at P:/') || fail "the example fails: $said"
[[ $said == "foam $("$room/foam/bin/foam" version | sed -n 's/^foam *//p')
8 of kind 1, the first at P: covered true
2 of kind 2, the first at P: covered true
1 of kind 8, the first at P: covered true
triangle 2 has the corner 5, but there are 5 vertices; remedy: indices from 0 to vertex_count - 1" ]] || fail "the example prints: $said"
