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
if [[ -f $(package python3-foam) ]]; then
    expect "python3 (<< 3." dpkg-deb -f "$(package python3-foam)" Depends
    expect "python3-numpy" dpkg-deb -f "$(package python3-foam)" Depends
    expect "foam (= " dpkg-deb -f "$(package python3-foam)" Depends
    dpkg-deb -x "$(package python3-foam)" "$room/root"
    if /usr/bin/python3 -c 'import numpy' 2>/dev/null; then
        write_part "$room/part.obj"
        cd "$room"
        expect "$room/root/usr/lib/python3/dist-packages/foam/__init__.py True" \
            env PYTHONPATH="$room/root/usr/lib/python3/dist-packages" /usr/bin/python3 -c \
            'import foam; print(foam.__file__, foam.spherize("part.obj", 6).certified)'
        if /usr/bin/python3 -c 'import pandas, matplotlib, yaml' 2>/dev/null; then
            printf '%s\n' 'foam_experiment: 1' 'name: x' 'kind: time_against_triangles' 'mesh: part.obj' 'triangles: [100]' \
                'figures: {a: [load.mesh]}' >x.yaml
            expect "| load.mesh |" env FOAM_PYTHON=/usr/bin/python3 "$room/root/usr/bin/foam" bench x.yaml
        fi
    fi
fi
