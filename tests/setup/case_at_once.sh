#!/usr/bin/env bash
# shellcheck source=tests/setup/fixture.sh
source "$(dirname "$0")/fixture.sh"

# Three starts at once build once and all run.
printf '%s\n' pack-a pack-b >"$installed"
export ninja_slow=1
for i in 1 2 3; do
    PATH=$tools "$clone/foam" "$i" >"$room/out.$i" 2>/dev/null &
done
wait
for i in 1 2 3; do
    out=$(cat "$room/out.$i")
    expect_out "ran <$i>"
done
expect_calls ninja 1
