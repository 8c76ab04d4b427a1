#!/usr/bin/env bash
# wheel.sh PYTHON: the wheels, installed without network into a new environment and imported from another folder.
# shellcheck source=tests/sdk/fixture.sh
source "$(dirname "$0")/../sdk/fixture.sh"
python=$1
command -v patchelf >/dev/null || skip "there is no patchelf"
"$python" -c 'import ensurepip, numpy, pip, tomllib, venv' 2>/dev/null || skip "a module is missing: ensurepip, numpy, pip, tomllib or venv"
[[ -z $FOAM_TEST_SANITIZER ]] || skip "nobody packs a build with sanitizers"
export PYTHONDONTWRITEBYTECODE=1

quietly "$python" "$FOAM_TEST_SOURCE/python/wheel/foam_wheel.py" "$FOAM_TEST_BUILD" "$room/wheels"
version=$("$FOAM_TEST_BUILD/bin/foam" version | sed -n 's/^foam *//p')
tag=$("$python" -c 'import sys; print("cp%d%d" % sys.version_info[:2])')
tag=$tag-$tag-linux_$(uname -m)
main=$room/wheels/foam_spheres-$version-$tag.whl gpl=$room/wheels/foam_spheres_gpl-$version-$tag.whl
[[ -f $main ]] || fail "no wheel $main: $(ls "$room/wheels")"
inside() { "$python" -c 'import sys, zipfile; print(zipfile.ZipFile(sys.argv[1]).read(sys.argv[2]).decode())' "$@"; }
expect "Root-Is-Purelib: false" inside "$main" "foam_spheres-$version.dist-info/WHEEL"
expect "Tag: $tag" inside "$main" "foam_spheres-$version.dist-info/WHEEL"
expect "Requires-Dist: numpy" inside "$main" "foam_spheres-$version.dist-info/METADATA"

# pip makes the same wheel, to the last byte.
quietly "$python" -m pip wheel --no-index --no-deps --no-build-isolation --config-settings "build-dir=$FOAM_TEST_BUILD" \
    -w "$room/by_pip" "$FOAM_TEST_SOURCE/python"
cmp "$main" "$room/by_pip/${main##*/}" || fail "pip makes another wheel"

# NumPy is that of the system.
quietly "$python" -m venv --system-site-packages --without-pip "$room/venv"
install() { quietly "$python" -m pip --python "$room/venv/bin/python" install --no-index --no-deps "$1"; }
install "$main"
mkdir "$room/elsewhere" && cd "$room/elsewhere"
write_part part.obj
panda=$FOAM_TEST_SOURCE/configs/panda_22.yaml
clean=(env -i "HOME=$room" PYTHONDONTWRITEBYTECODE=1)
quietly "${clean[@]}" "$room/venv/bin/python" "$FOAM_TEST_SOURCE/tests/python/from_wheel.py" part.obj spheres.bin "$panda"
quietly "${clean[@]}" "PYTHONPATH=$FOAM_TEST_BUILD/python" "$python" -c \
    'import foam; open("clone.bin", "wb").write(foam.spherize("part.obj", 6).spheres.tobytes())'
cmp spheres.bin clone.bin || fail "the wheel has other spheres than the clone"

# The program that comes along, too.
expect "foam           $version" "${clean[@]}" "$room/venv/bin/foam" version
expect "usage: foam-generate-spheres" "${clean[@]}" "$room/venv/bin/foam-generate-spheres" --help
expect "Proved" "${clean[@]}" "$room/venv/bin/foam" spherize part.obj -n 6 -o part.json

# What is under the GPL is in the second wheel alone.
medial=$(find "$room/venv" -name spherize_medial.so)
[[ -z $medial ]] || fail "a plugin under the GPL in the first wheel"
if [[ -f $FOAM_TEST_BUILD/lib/foam/plugins/spherize_medial.so ]]; then
    expect "Requires-Dist: foam-spheres==$version" inside "$gpl" "foam_spheres_gpl-$version.dist-info/METADATA"
    expect "GNU GENERAL PUBLIC LICENSE" inside "$gpl" "foam_spheres_gpl-$version.dist-info/licenses/GPL-3"
    install "$gpl"
    expect "spherize_medial" "${clean[@]}" "$room/venv/bin/python" "$FOAM_TEST_SOURCE/tests/python/from_wheel.py" part.obj spheres.bin "$panda"
fi
