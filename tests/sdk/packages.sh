#!/usr/bin/env bash
# The Debian packages: names, contents, dependencies found by dpkg-shlibdeps.
# shellcheck source=tests/sdk/fixture.sh
source "$(dirname "$0")/fixture.sh"
for tool in dpkg-deb dpkg-shlibdeps file cpack; do
    command -v $tool >/dev/null || skip "there is no $tool"
done
[[ -z $FOAM_TEST_SANITIZER ]] || skip "nobody packs a build with sanitizers"

quietly cpack --config "$FOAM_TEST_BUILD/CPackConfig.cmake" -G DEB -B "$room/packages"
package() { printf '%s\n' "$room"/packages/"$1"_*.deb; }
expect "libyaml-cpp" dpkg-deb -f "$(package foam)" Depends
expect "fonts-dejavu-core" dpkg-deb -f "$(package foam)" Depends
expect "foam (= " dpkg-deb -f "$(package foam-dev)" Depends
expect "./usr/include/foam/sdk/plugin.hpp" dpkg-deb -c "$(package foam-dev)"
dpkg-deb -x "$(package foam)" "$room/root"
expect "spherize_octree" "$room/root/usr/bin/foam" plugins
if [[ -f $(package foam-plugins-gpl) ]]; then
    expect "foam (= " dpkg-deb -f "$(package foam-plugins-gpl)" Depends
    expect "spherize_medial.so" dpkg-deb -c "$(package foam-plugins-gpl)"
    dpkg-deb -x "$(package foam-plugins-gpl)" "$room/root"
    expect "GPL-3.0-or-later" "$room/root/usr/bin/foam" plugins
fi
if [[ -x $FOAM_TEST_BUILD/bin/foam-bench ]]; then
    expect "foam (= " dpkg-deb -f "$(package foam-bench)" Depends
    dpkg-deb -x "$(package foam-bench)" "$room/root"
    expect "Measure stages" "$room/root/usr/bin/foam" bench --help
fi
