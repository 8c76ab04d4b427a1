#!/usr/bin/env bash
# shellcheck source=tests/setup/fixture.sh
source "$(dirname "$0")/fixture.sh"

# ./foam release puts source, packages, wheels and their digests into one folder.
printf 'project(foam VERSION 1.2.3 LANGUAGES CXX\n' >"$clone/CMakeLists.txt"
for tool in gzip sha256sum; do
    ln -s "$(command -v "$tool")" "$tools/$tool"
done
# shellcheck disable=SC2016  # expanded when it runs
stand_in git <<'END'
case " $* " in
*" status "*) printf '%s' "${changes:-}" ;;
*" log "*) echo 1700000000 ;;
*" archive "*) echo "source of ${*: -1}" ;;
esac
END
# shellcheck disable=SC2016
stand_in cpack <<'END'
[[ -z ${cpack_fails:-} ]] || { echo "CPack Error"; exit 1; }
mkdir -p "${*: -1}/_CPack_Packages"
echo "epoch $SOURCE_DATE_EPOCH" >"${*: -1}/foam_1.2.3_amd64.deb"
END
# shellcheck disable=SC2016
stand_in python3 <<'END'
[[ $2 == venv ]] && mkdir -p "$4/bin" && cp "$0" "$4/bin/python"
[[ $* != *foam_wheel.py* ]] || echo wheel >"${*: -1}/foam_spheres-1.2.3.whl"
END
export FOAM_PYTHONS=/python/3.11
release=$clone/build/foam-1.2.3
run_foam release
expect_code 0
expect_out "$release/SHA256SUMS
$release/foam-1.2.3.tar.gz
$release/foam_1.2.3_amd64.deb
$release/foam_spheres-1.2.3.whl"
expect_call "pack-r"
expect_call "core/all plugins/all apps/foam/all python/all"
expect_call "archive --format=tar --prefix=foam-1.2.3/ HEAD"
(cd "$release" && sha256sum --quiet -c SHA256SUMS) || fail "wrong digests"
[[ $(wc -l <"$release/SHA256SUMS") == 3 ]] || fail "a file without a digest"
[[ $(gzip -dc "$release/foam-1.2.3.tar.gz") == "source of HEAD" ]] || fail "not the source"
[[ $(cat "$release"/*.deb) == "epoch 1700000000" ]] || fail "packages without the time of the commit"

# A folder that exists is refused, and so is what is not committed.
run_foam release
expect_code 2
expect_err "$release exists: remove it, or name another folder"
changes=" M foam" run_foam release "$room/other"
expect_code 2
expect_err "commit or remove these first, a release is made of a commit:
 M foam"
[[ ! -e $room/other ]] || fail "a folder in spite of changes"
expect_calls cpack 1

# What fails leaves nothing.
cpack_fails=1 run_foam release "$room/other"
expect_code 1
expect_out ""
expect_err "CPack Error"
[[ -z $(find "$room" -name 'other*') ]] || fail "a failure leaves files"
run_foam release "$room/other"
expect_code 0
cmp "$room/other/SHA256SUMS" "$release/SHA256SUMS" || fail "the same commit gives other bytes"
