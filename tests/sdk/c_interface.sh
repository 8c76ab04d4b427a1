#!/usr/bin/env bash
# foam.h of an installed SDK that was moved: from C by find_package(foam) and by pkg-config, and from Python by ctypes.
# shellcheck source=tests/sdk/fixture.sh
source "$(dirname "$0")/fixture.sh"
compiler=$(command -v cc) || skip "there is no cc"

install_foam "$room/first" runtime sdk
mv "$room/first" "$room/a folder"
prefix="$room/a folder"
library=$(find "$prefix" -name libfoam-c.so)
libraries=$(dirname "$library")

# A project in C alone.
example=$FOAM_TEST_SOURCE/docs/examples/c_interface
quietly "$FOAM_TEST_CMAKE" -S "$example" -B "$room/build" -G "$FOAM_TEST_GENERATOR" -DCMAKE_PREFIX_PATH="$prefix"
quietly "$FOAM_TEST_CMAKE" --build "$room/build"
expect "8 spheres of 0.00106 m3, proved" "$room/build/c_interface"
loaded=$(ldd "$room/build/c_interface")
[[ ! $loaded =~ yaml|expat|json|foam-(robot|sdk|recipe|report|runtime|judge) ]] || fail "foam::c brings more than the search: $loaded"

# The test programs, as strict C99.
if command -v pkg-config >/dev/null; then
    export PKG_CONFIG_PATH=$libraries/pkgconfig
    expect "$("$prefix/bin/foam" version | sed -n 's/^foam *//p')" pkg-config --modversion foam
    flags=(-std=c99 -Wall -Wextra -Wpedantic -Werror ${FOAM_TEST_SANITIZER:+"-fsanitize=$FOAM_TEST_SANITIZER"})
    for program in c_interface_test judge_test; do
        eval "quietly \"$compiler\" \"\${flags[@]}\" -D_POSIX_C_SOURCE=200809L -x c \"$FOAM_TEST_SOURCE/tests/c/$program.c\" \
            -o \"$room/test\" $(pkg-config --cflags --libs foam) -lm -pthread"
        LD_LIBRARY_PATH=$libraries quietly "$room/test"
    done
else
    echo "not tested: there is no pkg-config"
fi

# Python without a module of foam's: the same bytes, and errors with a remedy.
if [[ -z $FOAM_TEST_SANITIZER ]] && command -v python3 >/dev/null; then
    "$room/build/c_interface" | head -8 >"$room/c.txt"
    python3 "$example/spherize.py" "$library" >"$room/python.txt"
    cmp "$room/c.txt" "$room/python.txt" || fail "Python has other spheres than C"
    # A run writes them too, in short decimal numbers.
    python3 - "$example" "$room" <<'PYTHON'
import sys
sys.path.insert(0, sys.argv[1]); sys.dont_write_bytecode = True
import spherize
with open(f"{sys.argv[2]}/box.obj", "w") as file:
    file.writelines("v %r %r %r\n" % vertex for vertex in spherize.VERTICES)
    file.writelines("f %d %d %d\n" % tuple(corner + 1 for corner in triangle) for triangle in spherize.TRIANGLES)
with open(f"{sys.argv[2]}/box.yaml", "w") as file:
    file.write("foam: 1\nname: box\nmesh: [box.obj]\nstages: [spherize.cover: {}]\nbudget: {spheres: 2}\n"
               "guarantee: outer\noutputs: [write.csv: {file: box.csv}]\n")
PYTHON
    quietly "$prefix/bin/foam" run "$room/box.yaml" --run-dir "$room/run"
    PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$example quietly python3 "$FOAM_TEST_SOURCE/tests/c/by_ctypes.py" "$library" "$room/run/box.csv"
fi
