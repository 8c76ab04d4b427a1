#!/usr/bin/env bash
# tests/fuzz/run.sh TARGET SECONDS [FOLDER]: builds a fuzzer and runs it. TARGET: stl, obj, off, ply, dae, gltf, urdf, spheres or
# recipe. FOLDER (build/fuzz_corpus) keeps what was learned, in FOLDER/TARGET, and findings, in FOLDER/findings/TARGET. Seeds: the
# committed ones, and with FOAM_SHARED=PATH the small files of that folder. Needs clang++ with libFuzzer.
set -euo pipefail
cd "$(dirname "$0")/../.."
target=$1 seconds=$2 folder=${3:-build/fuzz_corpus}
build=${FOAM_FUZZ_BUILD:-build/fuzz}

[[ -e tests/fuzz/seeds/$target ]] || { echo "unknown target '$target': one of $(ls tests/fuzz/seeds | xargs)" >&2; exit 2; }
[[ -e $build/build.ninja ]] || cmake --preset fuzz -B "$build" >/dev/null
cmake --build "$build" --target "fuzz_$target"

seeds=("tests/fuzz/seeds/$target")
[[ -e tests/fuzz/corpus/$target ]] && seeds+=("tests/fuzz/corpus/$target")
[[ $target == recipe ]] && seeds+=(tests/recipes configs)
[[ $target == urdf ]] && seeds+=(configs/robots)
mkdir -p "$folder/$target" "$folder/findings/$target"
if [[ -n ${FOAM_SHARED:-} ]]; then
  shared=$folder/shared/$target
  mkdir -p "$shared"
  case $target in
    gltf) endings='gltf|glb' ;;
    spheres) endings='spher[a-z_0-9]*\.urdf|ya?ml|spheres\.json' ;;
    *) endings=$target ;;
  esac
  find "$FOAM_SHARED" -type f -regextype posix-extended -iregex ".*($endings)" -size -64k -exec cp -n {} "$shared/" \;
  seeds+=("$shared")
fi
exec "$build/bin/fuzz_$target" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=2048 -max_len=65536 -use_value_profile=1 \
  -print_final_stats=1 -dict="tests/fuzz/dictionaries/$target.dict" -artifact_prefix="$folder/findings/$target/" \
  "$folder/$target" "${seeds[@]}"
