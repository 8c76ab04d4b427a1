#!/usr/bin/env bash
# wheel.sh PYTHON: the wheels: what they need of the system, and installed for each Python that is there, into environments without
# anything else, and used from another folder.
# shellcheck source=tests/sdk/fixture.sh
source "$(dirname "$0")/../sdk/fixture.sh"
python=$1
tools=$FOAM_TEST_BUILD/wheel-tools/bin
without() { # in continuous integration nothing may be left out
    [[ -z ${CI:-} ]] || fail "$1"
    skip "$1"
}
[[ -z $FOAM_TEST_SANITIZER ]] || skip "nobody packs a build with sanitizers"
pythons=$(sed -n 's/^FOAM_WHEEL_PYTHONS:[A-Z]*=//p' "$FOAM_TEST_BUILD/CMakeCache.txt")
[[ -x $tools/auditwheel && -n $pythons ]] || without "the build is not for wheels: ./foam wheel makes it so"
export PYTHONDONTWRITEBYTECODE=1

PATH=$tools:$PATH quietly "$tools/python" "$FOAM_TEST_SOURCE/python/wheel/foam_wheel.py" "$FOAM_TEST_BUILD" "$room/wheels"
version=$("$FOAM_TEST_BUILD/bin/foam" version | sed -n 's/^foam *//p')
wheel() { printf '%s\n' "$room/wheels/foam_spheres$1-$version-py3-none-$2.whl"; }
main=$(wheel "" manylinux_2_34_x86_64)
[[ -f $main ]] || fail "no wheel $main: $(ls "$room/wheels")"

# What docs/dev/releasing.md says of it.
expect "py3-none-manylinux_2_34_x86_64" cat "$FOAM_TEST_SOURCE/docs/dev/releasing.md"
(($(stat -c %s "$main") <= 15000000)) || fail "more than 15 MB: $(stat -c %s "$main")"
"$tools/python" - "$main" <<'PYTHON' || fail "symbols that glibc 2.34 or g++ 11's libstdc++ does not have"
"""Every symbol that a file of the wheel needs, against the versions of manylinux_2_34: by pyelftools, not by auditwheel."""
import io, re, sys, zipfile
from elftools.elf.elffile import ELFFile
from elftools.elf.gnuversions import GNUVerNeedSection
MOST = {"GLIBC": (2, 34), "GLIBCXX": (3, 4, 29), "CXXABI": (1, 3, 13), "GCC": (12, 0)}
newer, files = [], 0
archive = zipfile.ZipFile(sys.argv[1])
for name in archive.namelist():
    data = archive.read(name)
    if data[:4] != b"\x7fELF":
        continue
    files += 1
    for section in ELFFile(io.BytesIO(data)).iter_sections():
        if isinstance(section, GNUVerNeedSection):
            for _, versions in section.iter_versions():
                for needed in versions:
                    family, _, number = needed.name.partition("_")
                    if family in MOST and tuple(map(int, re.findall(r"\d+", number))) > MOST[family]:
                        newer.append(f"{name}: {needed.name}")
print(*newer, sep="\n")
sys.exit(bool(newer) or files < 40)
PYTHON
inside() { "$python" -c 'import sys, zipfile; print(zipfile.ZipFile(sys.argv[1]).read(sys.argv[2]).decode())' "$@"; }
expect "Root-Is-Purelib: false" inside "$main" "foam_spheres-$version.dist-info/WHEEL"
expect "Requires-Dist: numpy" inside "$main" "foam_spheres-$version.dist-info/METADATA"
expect "Requires-Python: >=3.10" inside "$main" "foam_spheres-$version.dist-info/METADATA"
for package in libexpat1-dev libarchive-dev libzip-dev libcpp-httplib-dev; do
    expect "Copyright" inside "$main" "foam_spheres-$version.dist-info/licenses/$package.txt"
done

mkdir "$room/elsewhere" && cd "$room/elsewhere"
write_part part.obj
clean=(env -i "HOME=$room" PYTHONDONTWRITEBYTECODE=1)
quietly "${clean[@]}" "PYTHONPATH=$FOAM_TEST_BUILD/python" "$python" -c \
    'import foam; open("clone.bin", "wb").write(foam.spherize("part.obj", 6).spheres.tobytes())'
panda=$FOAM_TEST_SOURCE/configs/panda_22.yaml
# environment PYTHON: one with NumPy alone, kept for the next time.
environment() {
    local folder
    folder=$FOAM_TEST_BUILD/tests/wheel/$("$1" -c 'import sys; print("%d.%d" % sys.version_info[:2])')
    if ! cmp -s "$FOAM_TEST_SOURCE/tests/python/numpy.txt" "$folder/numpy.txt"; then
        "$1" -m venv --clear "$folder" && "$folder/bin/python" -m pip install --quiet --disable-pip-version-check --no-deps \
            --only-binary=:all: --require-hashes --requirement="$FOAM_TEST_SOURCE/tests/python/numpy.txt" || return
        cp "$FOAM_TEST_SOURCE/tests/python/numpy.txt" "$folder/"
    fi >&2
    printf '%s\n' "$folder"
}
install() { quietly "$tools/python" -m pip --python "$venv/bin/python" install --no-index --no-deps --force-reinstall "$1"; }
plugins() { expect "$1" "${clean[@]}" "$venv/bin/python" "$FOAM_TEST_SOURCE/tests/python/from_wheel.py" part.obj spheres.bin "${@:2}"; }

IFS=';' read -ra pythons <<<"$pythons"
for each in "${pythons[@]}"; do
    venv=$(environment "$each") || without "there is no NumPy for $each"
    quietly "$tools/python" -m pip --python "$venv/bin/python" uninstall --yes foam-spheres foam-spheres-gpl foam-spheres-commalab
    install "$main"
    rm -f spheres.bin
    plugins "spherize_cover"
    cmp spheres.bin clone.bin || fail "$each: the wheel has other spheres than the clone"
    expect "foam           $version" "${clean[@]}" "$venv/bin/foam" version
    expect "foam           $version" "${clean[@]}" "$venv/bin/python" -m foam version
done

# The rest with the last of them.
expect "Proved" "${clean[@]}" "$venv/bin/foam" spherize part.obj -n 6 -o part.json
expect "Proved" "${clean[@]}" "$venv/bin/foam" spherize "$("$venv/bin/python" -c 'import foam; print(foam.example("panda"))')" -n 20 -o panda.json
# The libraries that are linked otherwise than in the build: archives, the server of pages; and what is opened late.
"$python" -c 'import tarfile, zipfile
with zipfile.ZipFile("parts.zip", "w", zipfile.ZIP_BZIP2) as archive:
    archive.write("part.obj")
with tarfile.open("parts.tar", "w") as archive:
    archive.add("part.obj")'
for archive in parts.zip parts.tar; do
    expect "1 with spheres, 0 failed" "${clean[@]}" "$venv/bin/foam" batch "$archive" -n 4 --run-dir "of_$archive"
done
if [[ -f $FOAM_TEST_BUILD/lib/foam/plugins/load_sdf/libfoam-sdf-reader.so ]]; then
    expect "upper" "${clean[@]}" "$venv/bin/foam" info "$FOAM_TEST_SOURCE/plugins/load_sdf/samples/arm.sdf"
fi
"${clean[@]}" "$venv/bin/foam" view part.obj --no-open >page.txt 2>&1 &
server=$!
for _ in {1..100}; do
    grep -q "^http:" page.txt && break
    sleep 0.1
done
expect "<!DOCTYPE html>" "$python" -c 'import sys, urllib.request; print(urllib.request.urlopen(sys.argv[1]).read().decode())' \
    "$(grep -m1 "^http:" page.txt)"
kill "$server"
medial=$(find "$venv" -name 'spherize_medial.so' -o -name 'foam-generate-spheres' -o -name external.py -path '*/foam/*')
[[ -z $medial ]] || fail "in the first wheel, and not for it: $medial"
gpl=$(wheel _gpl manylinux_2_34_x86_64)
if [[ -f $FOAM_TEST_BUILD/lib/foam/plugins/spherize_medial.so ]]; then
    expect "Requires-Dist: foam-spheres==$version" inside "$gpl" "foam_spheres_gpl-$version.dist-info/METADATA"
    expect "GNU GENERAL PUBLIC LICENSE" inside "$gpl" "foam_spheres_gpl-$version.dist-info/licenses/GPL-3"
    install "$gpl"
    plugins "spherize_medial" "$panda"
fi
expect "pip install foam-spheres-commalab" "$python" -c "import subprocess, sys
done = subprocess.run([sys.argv[1], '-c', 'import foam; foam.SpherizationHelper'], capture_output=True, text=True)
print(done.stderr)" "$venv/bin/python"
install "$(wheel _commalab any)"
expect "usage: foam-generate-spheres" "${clean[@]}" "$venv/bin/foam-generate-spheres" --help
expect "SpherizationHelper" "${clean[@]}" "$venv/bin/python" -c 'import foam; print(foam.SpherizationHelper)'
# What ran with the clone runs with the wheels: the names and scripts of CoMMALab/foam, and the ten examples.
site=$("$venv/bin/python" -c 'import foam, os; print(os.path.dirname(os.path.dirname(foam.__file__)))')
notebook=$FOAM_TEST_BUILD/tests/consumers/python/beside/notebook
if "$python" -c 'import sys; sys.exit(sys.argv[1] not in sys.argv[2])' "$("$python" -c 'import sys; print("%d%d" % sys.version_info[:2])')" "$(ls "$site/foam")"; then
    mkdir "$room/only"
    ln -s "$site/foam" "$room/only/foam"
    ln -s "$venv/bin" "$room/only/bin"
    quietly env "PYTHONPATH=$room/only" "FOAM_TEST_SOURCE=$FOAM_TEST_SOURCE" "FOAM_TEST_BINARY=$venv/bin/foam" \
        "$python" "$FOAM_TEST_SOURCE/tests/python/run_tests.py" "$FOAM_TEST_SOURCE/tests/python/dropin_test.py"
    mkdir -p "$room/tree/bin"
    ln -s "$site/foam/bin/foam" "$room/tree/bin/foam"
    ln -s "$room/only" "$room/tree/python"
    quietly "$python" "$FOAM_TEST_SOURCE/tests/docs/run_page.py" "$room/tree/bin/foam" "$FOAM_TEST_SOURCE" \
        "$FOAM_TEST_SOURCE/docs/guide/python_examples.md"
    # Jupyter's own kernel executes the notebook.
    if [[ -d $notebook ]]; then
        quietly env "PYTHONPATH=$room/only:$notebook" "HOME=$room" "$python" "$FOAM_TEST_SOURCE/tests/python/notebook_from_wheel.py" \
            "$FOAM_TEST_SOURCE/docs/examples/python/first_picture.ipynb" "$room/elsewhere"
    else
        without "there is no nbclient in $notebook"
    fi
fi
[[ -f $(wheel _pictures linux_x86_64) ]] || fail "no wheel with the painter"
