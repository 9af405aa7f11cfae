#!/bin/sh
# A project of three lines that compares frames in its ctest: good, changed, accepted.  sh tests/compare_package.sh PROGRAM
set -eu
here=$(cd "$(dirname "$0")" && pwd)
program=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/reference" "$work/actual"
cp "$here/golden/springs.png" "$work/reference/frame_0001.png"
cp "$here/golden/springs.png" "$work/actual/frame_0001.png"
cat > "$work/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.18)
project(other LANGUAGES NONE)
enable_testing()
find_package(softreel REQUIRED)
softreel_add_compare_test(NAME frames REFERENCE reference ACTUAL actual TOLERANCE driver)
END
cmake -S "$work" -B "$work/build" -Dsoftreel_DIR="$here/../app" -DSOFTREEL_PROGRAM="$program" > "$work/log"
ctest --test-dir "$work/build" > "$work/log" || { cat "$work/log"; exit 1; }

cp "$here/golden/jelly.png" "$work/actual/frame_0001.png"
if ctest --test-dir "$work/build" > "$work/log"; then
  echo "another picture passed"
  exit 1
fi
for file in html json xml; do test -s "$work/build/compare/frames.$file"; done
cmake --build "$work/build" --target frames_update > "$work/log" || { cat "$work/log"; exit 1; }
ctest --test-dir "$work/build" > "$work/log" || { cat "$work/log"; exit 1; }
echo "good, different, accepted"
