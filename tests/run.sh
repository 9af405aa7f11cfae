#!/bin/sh
# Installs what is missing, builds, runs the tests:  sh tests/run.sh [arguments of ctest]
#   sh tests/run.sh -R cantilever     only tests with this in their name
#   sh tests/run.sh -L render         only tests of a folder
# Benchmarks are left out: ctest --test-dir build/release -L bench -V
# SOFTREEL_WERROR=ON makes warnings errors; PRESET=asan tests another preset.
set -eu
cd "$(dirname "$0")/.."
preset=${PRESET:-release}

sh app/setup.sh build
sh app/setup.sh test
cmake --preset "$preset" ${SOFTREEL_WERROR:+-DSOFTREEL_WERROR="$SOFTREEL_WERROR"}
cmake --build --preset "$preset" --parallel "$(nproc)"
ctest --test-dir "build/$preset" --output-on-failure --parallel "$(nproc)" -LE '^bench$' "$@"
