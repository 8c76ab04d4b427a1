#!/usr/bin/env bash
# The Debian packages of this build install in a bare Debian, and a user works with them there.
# FOAM_TEST_DEBIAN: its suite, that of the machine that built (bookworm, trixie); or a folder that debootstrap made of it.
# shellcheck source=tests/sdk/fixture.sh
source "$(dirname "$0")/../sdk/fixture.sh"
[[ -n ${FOAM_TEST_DEBIAN:-} ]] || skip "it loads a Debian; FOAM_TEST_DEBIAN=bookworm runs it"
[[ -z $FOAM_TEST_SANITIZER ]] || skip "nobody packs a build with sanitizers"
[[ $(id -u) == 0 ]] || skip "only root makes a Debian in a folder"
for tool in debootstrap chroot cpack dpkg-shlibdeps; do
    command -v $tool >/dev/null || skip "there is no $tool"
done

debian=$FOAM_TEST_DEBIAN
if [[ ! -d $debian ]]; then
    debian=$room/debian
    quietly debootstrap --variant=minbase "$FOAM_TEST_DEBIAN" "$debian" http://deb.debian.org/debian
fi
# A mount of its own that ends with this script.
mount --bind /proc "$debian/proc"
trap 'umount "$debian/proc"; rm -rf --one-file-system -- "$room"' EXIT
in_debian() { chroot "$debian" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"; }
# as_user COMMAND: of a shell, in a folder of the user's.
as_user() { in_debian runuser -u foam-user -- bash -c "cd && $1"; }

quietly cpack --config "$FOAM_TEST_BUILD/CPackConfig.cmake" -G DEB -B "$room/packages"
rm -rf -- "$debian/packages"
mkdir "$debian/packages"
cp "$room"/packages/*.deb "$debian/packages"
quietly in_debian apt-get update
quietly in_debian bash -c 'apt-get install -y --no-install-recommends --reinstall /packages/*.deb man-db'
in_debian id foam-user >/dev/null 2>&1 || quietly in_debian useradd --create-home foam-user

expect "foam 0." as_user "foam --version"
expect "Written to runs/panda_22: panda_22.urdf" as_user "foam run panda_22"
expect "panda_link0" as_user "cat runs/panda_22/panda_22.urdf"
expect "the run directory cannot be made: Permission denied; remedy: choose another folder with --run-dir" \
    as_user "cd / && ! foam run panda_22"
expect "User Commands" as_user "man foam && man foam-run"
expect "spherize" as_user \
    ". /usr/share/bash-completion/completions/foam && COMP_WORDS=(foam sphe) COMP_CWORD=1 && _foam && echo \"\${COMPREPLY[@]}\""
expect "#compdef foam" as_user "cat /usr/share/zsh/vendor-completions/_foam"
expect "complete -c foam" as_user "cat /usr/share/fish/vendor_completions.d/foam.fish"
expect "# foam" as_user "cat /usr/share/doc/foam/README.md"
expect "# Set-up" as_user "cat /usr/share/doc/foam/docs/guide/setup.md"
for package in "$room"/packages/{foam,foam-dev,foam-plugins-gpl,python3-foam}_*.deb; do
    [[ -f $package ]] || continue
    name=${package##*/} name=${name%%_*}
    expect "License: " as_user "cat /usr/share/doc/$name/copyright"
done
if compgen -G "$room/packages/foam-plugins-gpl_*.deb" >/dev/null; then
    expect "Written: medial.urdf" as_user "foam spherize /usr/share/foam/configs/robots/panda/panda.urdf -n 11 -m medial -o medial.urdf"
fi
if compgen -G "$room/packages/python3-foam_*.deb" >/dev/null; then
    expect "True" as_user \
        "python3 -c 'import foam; print(foam.spherize(\"/usr/share/foam/configs/robots/panda/meshes/link5.obj\", 6).certified)'"
fi
# What an install brought, a removal takes.
quietly in_debian apt-get purge -y foam
! as_user "ls /usr/share/foam" 2>/dev/null || fail "a removal leaves files"
