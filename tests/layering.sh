#!/bin/sh
# Reads the includes of the source folders and fails on an arrow that runs back.
# Allowed: app -> {assets, sim, render}; assets -> sim/mesh.h, sim/catalogue.h (names to choose from), sim/parallel.h (the threads); sim and render include only themselves.
set -eu
cd "${1:-$(dirname "$0")/..}"

bad=0
# check FOLDER REGEX: every quoted project include of FOLDER must match REGEX.
check() {
  found=$(grep -rnE '^[[:space:]]*#[[:space:]]*include[[:space:]]*"' --include='*.h' --include='*.cpp' "$1" |
          grep -vE "\"($2)[^\"]*\"" || true)
  if [ -n "$found" ]; then
    printf 'layering: %s may include only (%s):\n%s\n' "$1" "$2" "$found"
    bad=1
  fi
}
# forbid FOLDER REGEX WHY: no system include of FOLDER may match REGEX.
forbid() {
  found=$(grep -rnE "^[[:space:]]*#[[:space:]]*include[[:space:]]*<($2)" --include='*.h' --include='*.cpp' "$1" || true)
  if [ -n "$found" ]; then
    printf 'layering: %s %s:\n%s\n' "$1" "$3" "$found"
    bad=1
  fi
}
check sim 'sim/'
check render 'render/'
check assets 'assets/|sim/mesh\.h|sim/catalogue\.h|sim/parallel\.h'
check app 'app/|assets/|sim/|render/'
forbid sim 'assimp|tetgen|toml|glm|GL/|fstream|iostream|cstdio|stdio|fmt/|filesystem' 'holds no file, no GL, no printing'
forbid render 'Eigen|assimp|tetgen|toml' 'holds no physics and no mesh import'
forbid assets 'glm|GL/' 'knows no pictures'
[ "$bad" = 0 ] && echo "layering: every include runs the right way"
exit "$bad"
