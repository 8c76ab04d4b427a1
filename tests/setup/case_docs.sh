#!/usr/bin/env bash
# shellcheck source=tests/setup/fixture.sh
source "$(dirname "$0")/fixture.sh"

# ./foam docs installs what it needs for that and no more, builds no program, and says where the pages are.
run_foam docs
expect_code 0
expect_out "$clone/build/docs/index.html"
expect_call "install -y --no-install-recommends pack-d"
expect_no_call "^apt-get.*pack-[abt]"
expect_call "--config-file $clone/mkdocs.yml --site-dir $clone/build/docs"
expect_calls cmake 0
expect_calls ninja 0

# What mkdocs finds wrong is shown.
export mkdocs_fails=1
run_foam docs
expect_code 1
expect_out ""
expect_err "WARNING - no such page"
expect_err "the documentation could not be built (whole log: $clone/build/docs.log)"

# Where packages cannot be looked at, the tool that is missing is named.
rm "$tools/apt-get" "$tools/mkdocs"
run_foam docs
expect_code 2
expect_err "  pack-d"
expect_err "mkdocs is not there: stopping."
