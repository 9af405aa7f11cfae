#!/bin/sh
# Are all C++ files in the layout of .clang-format?  sh tests/format.sh [--fix]
set -eu
cd "$(dirname "$0")/.."

command -v clang-format-14 >/dev/null || sh app/setup.sh format

if files=$(git ls-files -- '*.cpp' '*.h' 2>/dev/null) && [ -n "$files" ]; then
  :
else  # an unpacked archive
  files=$(find app assets render sim tests -name '*.cpp' -o -name '*.h')
fi
# No file name here has a space in it.
if [ "${1:-}" = --fix ]; then
  clang-format-14 -i $files
  exit
fi
# One line for each file: its first place.
if clang-format-14 --dry-run $files 2>&1 | grep 'clang-format-violations' | awk -F: '!seen[$1]++ { print } END { exit NR == 0 }'; then
  echo "format: sh tests/format.sh --fix puts them right"
  exit 1
fi
echo "format: every file is in the layout of .clang-format"
