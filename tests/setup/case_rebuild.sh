#!/usr/bin/env bash
# shellcheck source=tests/setup/fixture.sh
source "$(dirname "$0")/fixture.sh"

printf '%s\n' pack-a pack-b >"$installed"
run_foam version
expect_calls ninja 1
# Nothing changed: no tool is started.
run_foam version
expect_calls ninja 1
expect_calls dpkg-query 1
# A changed, a new and a removed file, and a changed package list, each build again, and only once.
builds=1
# shellcheck disable=SC2016  # evaluated below
for change in 'touch "$clone/CMakeLists.txt"' 'touch "$clone/core/new.cpp"' 'rm "$clone/core/new.cpp"' \
    'touch "$clone/dependencies.txt"' 'mkdir "$clone/plugins/new"'; do
    sleep 0.02
    eval "$change"
    builds=$((builds + 1))
    run_foam version
    expect_calls ninja $builds
    run_foam version
    expect_calls ninja $builds
done
expect_calls cmake 1
# A moved clone is configured from scratch.
mv "$clone" "$room/moved"
clone=$room/moved
run_foam version
expect_code 0
expect_call "cmake --fresh"
