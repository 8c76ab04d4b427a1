#!/usr/bin/env bash
# tests/fuzz/brief.sh FOLDER [SECONDS]: every fuzzer for some seconds. Exit code 77 (skipped) unless FOAM_TEST_FUZZ=1 and clang++
# can fuzz.
set -euo pipefail
folder=$1 seconds=${2:-10}
[[ ${FOAM_TEST_FUZZ:-} == 1 ]] || { echo "skipped: FOAM_TEST_FUZZ=1 is not set"; exit 77; }
mkdir -p "$folder"
echo 'extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }' > "$folder/probe.cpp"
clang++ -fsanitize=fuzzer,address "$folder/probe.cpp" -o "$folder/probe" 2>/dev/null ||
  { echo "skipped: there is no clang++ with libFuzzer"; exit 77; }
export FOAM_FUZZ_BUILD=$folder/build
for seeds in "$(dirname "$0")"/seeds/*; do
  "$(dirname "$0")/run.sh" "$(basename "$seeds")" "$seconds" "$folder/corpus"
done
