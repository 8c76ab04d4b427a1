# shellcheck shell=bash
# A small clone of foam in a folder with a space in its name, and a PATH that holds only basic tools and stand-ins.
# The stand-ins note their calls in $calls; what dpkg-query calls installed is in $installed.
set -euo pipefail
source_root=$1
room=$(mktemp -d)
trap 'rm -rf -- "$room"' EXIT
clone="$room/a clone"
tools=$room/tools
unset CI FOAM_PYTHONS # what is set where the tests run
export calls=$room/calls installed=$room/installed FOAM_OS_RELEASE=$room/os-release
printf '%s\n' 'ID=debian' 'VERSION_ID="13"' >"$FOAM_OS_RELEASE"
mkdir -p "$clone"/{core,plugins,apps,python/wheel} "$tools"
echo tools >"$clone/python/wheel/requirements.txt"
touch "$calls" "$installed"
cp -- "$source_root/foam" "$clone/foam"
printf '%s\n' '# No group yet' 'not-one' '## run: what it is' 'pack-a' '# more' 'pack-b   # why' '' '## python: of it' pack-p '## bench: of it' pack-e '## wheel: of it' pack-w '## release: of it' pack-r '## python-tests: of it' pack-q '## tests: of it' pack-t \
    '## consumers: of it' pack-c '## docs: of it' pack-d '## consumers-12: of it on Debian 12' pack-o >"$clone/dependencies.txt"
touch "$clone/CMakeLists.txt"
for tool in bash cat chmod cmp cp dirname env find flock grep id mkdir mv nproc paste readlink rm sed sleep tail touch; do
    ln -s "$(command -v "$tool")" "$tools/$tool"
done

# stand_in NAME < script
stand_in() {
    rm -f -- "${tools:?}/$1"
    {
        printf '#!%s\n' "$(command -v bash)"
        # The stand-in writes its own name and arguments.
        # shellcheck disable=SC2016
        printf '%s\n' 'echo "${0##*/} $*" >>"$calls"'
        cat
    } >"$tools/$1"
    chmod +x "$tools/$1"
}
stand_in dpkg-query <<'END'
for package in "${@:3}"; do
    grep -qx "$package" "$installed" && echo "$package installed"
done
exit 1
END
stand_in apt-get <<'END'
[[ -z ${apt_fails:-} ]] || { echo "E: no network"; exit 100; }
[[ $* != *install* ]] || printf '%s\n' "$@" | grep pack- >>"$installed"
END
stand_in sudo <<<'"$@"'
# shellcheck disable=SC2016  # expanded when it runs
stand_in id <<<'echo "${user_id:-0}"'
stand_in cmake <<'END'
while (($#)); do [[ $1 == -B ]] && build=$2; [[ $1 == -S ]] && source=$2; [[ $1 == -DFOAM_TESTS=* ]] && tests=${1#*=}; shift; done
touch "$build/build.ninja"
printf '%s\n' "CMAKE_HOME_DIRECTORY:INTERNAL=$source" "CMAKE_BUILD_TYPE:STRING=Release" "FOAM_TESTS:BOOL=$tests" >"$build/CMakeCache.txt"
END
stand_in ninja <<'END'
[[ -z ${ninja_slow:-} ]] || sleep 0.3
[[ -z ${ninja_fails:-} ]] || { echo "[1/2] building"; echo "FAILED: thing.o"; echo "thing.cpp:3: error: no"; exit 1; }
echo "[1/2] building"
mkdir -p "$2/bin"
printf '%s\n' "#!$BASH" 'printf "ran"; printf " <%s>" "$@"; echo' >"$2/bin/foam"
chmod +x "$2/bin/foam"
echo "[2/2] linking"
END
stand_in mkdocs <<'END'
[[ -z ${mkdocs_fails:-} ]] || { echo "WARNING - no such page"; exit 1; }
END
stand_in ctest <<<'echo "100% tests passed"'

# run_foam ARGS: sets $out, $err, $code.
run_foam() {
    code=0
    PATH=$tools "${entry:-$clone/foam}" "$@" >"$room/out" 2>"$room/err" || code=$?
    out=$(cat "$room/out") err=$(cat "$room/err")
}
fail() {
    printf 'FAILED: %s\n--- code %s\n--- out\n%s\n--- err\n%s\n--- calls\n' "$1" "${code:-}" "${out:-}" "${err:-}" >&2
    cat "$calls" >&2
    exit 1
}
expect_code() { [[ $code == "$1" ]] || fail "exit code $1 expected"; }
expect_out() { [[ $out == "$1" ]] || fail "stdout expected: $1"; }
expect_err() { [[ $err == *"$1"* ]] || fail "on stderr expected: $1"; }
expect_call() { grep -qF -- "$1" "$calls" || fail "call expected: $1"; }
expect_no_call() { ! grep -q -- "$1" "$calls" || fail "call not expected: $1"; }
expect_calls() { [[ $(grep -c -- "^$1" "$calls" || true) == "$2" ]] || fail "$2 calls of $1 expected"; }
