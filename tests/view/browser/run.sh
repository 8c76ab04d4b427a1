#!/bin/sh
# run.sh SCRIPT FOLDER CHROMIUM FOAM SOURCE: runs a script of FOLDER in headless Chromium. Exit code 77: something is missing.
script=$1 folder=$2 chromium=$3
shift 3
[ -x "$chromium" ] || { echo "skipped: chromium is missing"; exit 77; }
command -v node >/dev/null || { echo "skipped: node is missing"; exit 77; }
[ -d "$folder/node_modules/playwright-core" ] || {
  echo "skipped: npm packages are missing; remedy: npm ci --ignore-scripts --prefix $folder"; exit 77; }
room=$(mktemp -d)
trap 'rm -rf "$room"' EXIT
cd "$room" && HOME="$room" XDG_CACHE_HOME="$room/cache" node "$folder/$script.mjs" "$chromium" "$@"
