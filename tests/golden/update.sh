#!/bin/sh
# Renders the golden frames anew: sh tests/golden/update.sh [PROGRAM]
# Look at the pictures and at `git diff --stat` before you commit them.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
program=${1:-$here/../../build/release/softreel}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for scene in "$here"/*.toml; do
  name=$(basename "$scene" .toml)
  "$program" render "$scene" -o "$work/$name" --quiet
  last=$(ls "$work/$name" | grep '^frame_' | tail -1)
  cp "$work/$name/$last" "$here/$name.png"
  echo "$here/$name.png"
done
