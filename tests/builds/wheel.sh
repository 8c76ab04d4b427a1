#!/usr/bin/env bash
# wheel.sh PYTHON: the wheel works in another Debian with the Python of that, as a user's.
# FOAM_TEST_WHEEL_DEBIAN: its suite (trixie), or a folder that debootstrap made of it, with python3, python3-venv and python3-numpy.
# shellcheck source=tests/sdk/fixture.sh
source "$(dirname "$0")/../sdk/fixture.sh"
[[ -n ${FOAM_TEST_WHEEL_DEBIAN:-} ]] || skip "it loads a Debian; FOAM_TEST_WHEEL_DEBIAN=trixie runs it"
[[ -z $FOAM_TEST_SANITIZER ]] || skip "nobody packs a build with sanitizers"
[[ $(id -u) == 0 ]] || skip "only root makes a Debian in a folder"
tools=$FOAM_TEST_BUILD/wheel-tools/bin
[[ -x $tools/auditwheel ]] || skip "the build is not for wheels: ./foam wheel makes it so"

debian=$FOAM_TEST_WHEEL_DEBIAN
if [[ ! -d $debian ]]; then
    command -v debootstrap >/dev/null || skip "there is no debootstrap"
    debian=$room/debian
    quietly debootstrap --variant=minbase --include=python3,python3-venv,python3-numpy "$FOAM_TEST_WHEEL_DEBIAN" "$debian" \
        http://deb.debian.org/debian
fi
mount --bind /proc "$debian/proc"
trap 'umount "$debian/proc"; rm -rf --one-file-system -- "$room"' EXIT
in_debian() { chroot "$debian" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 HOME=/tried "$@"; }

PATH=$tools:$PATH quietly "$tools/python" "$FOAM_TEST_SOURCE/python/wheel/foam_wheel.py" "$FOAM_TEST_BUILD" "$room/wheels"
rm -rf -- "${debian:?}/tried"
mkdir "$debian/tried"
cp "$room"/wheels/foam_spheres-*.whl "$debian/tried"
write_part "$debian/tried/part.obj"
PYTHONPATH=$FOAM_TEST_BUILD/python "$1" -c \
    "import foam; open('$room/here.bin', 'wb').write(foam.spherize('$debian/tried/part.obj', 6).spheres.tobytes())"
quietly in_debian bash -c "cd /tried && python3 -m venv --system-site-packages venv && venv/bin/pip install --no-index --no-deps *.whl"
expect "True" in_debian bash -c "cd /tried && venv/bin/python -c \"import foam
cover = foam.spherize('part.obj', 6)
open('there.bin', 'wb').write(cover.spheres.tobytes())
print(cover.certified)\""
cmp "$room/here.bin" "$debian/tried/there.bin" || fail "the wheel has other spheres there"
expect "Proved" in_debian bash -c "cd /tried && venv/bin/foam spherize venv/lib/python3*/site-packages/foam/share/foam/configs/robots/panda/panda.urdf -n 20 -o panda.json"
