#!/bin/sh
# Does assets/SCENE.md say what the program's table of keys says?
#   sh tests/reference.sh [PROGRAM]          (default: build/release/softreel)
#   sh tests/reference.sh --fix [PROGRAM]    writes it anew
set -eu
fix=
if [ "${1:-}" = --fix ]; then
  fix=yes
  shift
fi
root=$(dirname "$0")/..
program=${1:-$root/build/release/softreel}
file=$root/assets/SCENE.md
new=$(mktemp)
trap 'rm -f "$new"' EXIT

list=$("$program" check --list)
{
  cat <<'END'
# The scene file, key by key

Printed by `softreel check --list`; `sh tests/reference.sh --fix` writes this page anew after a change of the table of
keys.

A scene file is [TOML](https://toml.io): `[time]` is a table, `[[soft]]` one more entry of a list. Lengths are in
metres, masses in kilograms, times in seconds, angles in degrees; y points up. File names are relative to the scene
file. What is left out has the default; a key that is not in this list is an error. On the command line, `--set` names a
key by its path, and the entry of a list by its name, its number (from 1) or `*` for all:
`--set soft.bear.material.young=1e5`.

END
  printf '%s\n\n' '## Keys'
  printf '%s\n' "$list" | sed -n '/^### /,$p'
  printf '\n%s\n\n```\n' '## Names to choose from'
  printf '%s\n' "$list" | sed '/^### /,$d' | sed '$d'
  printf '%s\n' '```'
} > "$new"

if [ "$fix" ]; then
  cat "$new" > "$file"
elif ! diff -u "$file" "$new"; then
  echo "reference: assets/SCENE.md is out of date; sh tests/reference.sh --fix writes it anew"
  exit 1
fi
