#!/usr/bin/env bash
# shellcheck source=tests/setup/fixture.sh
source "$(dirname "$0")/fixture.sh"

# ./foam python builds the package beside the program and starts Python with it; it needs its own packages, not those of tests.
# shellcheck disable=SC2016  # expanded when it runs
stand_in python3 <<<'echo "path $PYTHONPATH"; printf " <%s>" "$@"'
printf '%s\n' pack-a pack-b >"$installed"
run_foam version
expect_no_call "^apt-get"
run_foam python -c "a b"
expect_code 0
expect_call "install -y --no-install-recommends pack-p"
expect_no_call "^apt-get.*pack-[tqcdwe]"
expect_call "core/all plugins/all apps/foam/all python/all"
expect_out "path $clone/build/release/python
 <-c> <a b>"
# The package is then up to date until one of its files changes; the program is not built for that.
run_foam python
expect_calls ninja 2
sleep 0.02
touch "$clone/python/new.py"
run_foam version
expect_calls ninja 2
run_foam python
expect_calls ninja 3

# ./foam bench needs the modules of experiments and the programs that measure, and starts the program with this Python.
run_foam bench x.yaml
expect_code 0
expect_call "install -y --no-install-recommends pack-e"
expect_call "core/all plugins/all apps/foam/all python/all bench"
expect_out "ran <bench> <x.yaml>"
expect_calls ninja 4

# ./foam wheel installs its tools, builds for the Pythons whose headers are there, and hands the build folder on.
# shellcheck disable=SC2016  # expanded when it runs
stand_in python3 <<'END'
[[ $2 == venv ]] && mkdir -p "$4/bin" && cp "$0" "$4/bin/python"
case " $* " in
*" pip "*) [[ -z ${pip_fails:-} ]] || { echo "no network"; exit 1; } ;;
*pybind11*) echo "headers of pybind11" ;;
*) printf " <%s>" "$@" ;;
esac
END
pip_fails=1 run_foam wheel
expect_code 2
expect_err "pip could not install the tools for wheels"
export FOAM_PYTHONS="/python/3.10 /python/3.14"
run_foam wheel
expect_code 0
expect_call "install -y --no-install-recommends pack-w"
expect_call "-DFOAM_WHEEL=ON -DFOAM_WHEEL_PYTHONS=/python/3.10;/python/3.14 -DFOAM_WHEEL_PYBIND11=headers of pybind11"
expect_out " <-B> <$clone/python/wheel/foam_wheel.py> <$clone/build/release> <$clone/build/release/wheels>"
pip_fails=1 run_foam wheel "$room/a folder"
expect_out " <-B> <$clone/python/wheel/foam_wheel.py> <$clone/build/release> <$room/a folder>"
# Continuous integration tests wheels, too.
CI=true run_foam test
expect_code 0
expect_call "-DFOAM_TESTS=ON -DFOAM_WHEEL=ON"
