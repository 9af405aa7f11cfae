#!/bin/sh
# From a clone to a clip:  sh app/quickstart.sh
# Installs what is missing, builds, renders assets/scenes/hello.toml. Run again, it does only what is out of date.
set -eu
cd "$(dirname "$0")/.."

sh app/setup.sh build
cmake --preset release
cmake --build --preset release --parallel "$(nproc)" --target softreel
build/release/softreel render assets/scenes/hello.toml -o out/hello --video out/hello/hello.mp4

cat <<END

The clip:          out/hello/hello.mp4
Its frames:        out/hello/frame_0001.png, ...
The scene file:    assets/scenes/hello.toml (change something in it, and run this again)
The program:       build/release/softreel --help
END
