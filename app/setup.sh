#!/bin/sh
# Installs what is missing of a group of app/packages.txt:  sh app/setup.sh [build|test|format]
# Asks nothing. When nothing is missing, apt is not called.
set -eu
group=${1:-build}
list=$(dirname "$0")/packages.txt

fail() {
  printf 'setup: %s\n' "$@" >&2
  exit 3
}

packages=$(awk -v group="$group" '$1 == group { print $2 }' "$list")
[ -n "$packages" ] || fail "there is no group '$group' in $list"
if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  fail "this script knows Debian 12 and its relatives only, and there is no apt-get here." \
       "The packages it would install: $(echo $packages)" \
       "With your system's names for them in place, build by hand: cmake --preset release && cmake --build --preset release"
fi

missing=
for package in $packages; do
  status=$(dpkg-query -W -f '${db:Status-Status} ' "$package" 2>/dev/null || true)
  case " $status" in
    *" installed "*) ;;
    *) missing="$missing $package" ;;
  esac
done
[ -n "$missing" ] || exit 0

if [ "$(id -u)" = 0 ]; then
  as_root=
elif command -v sudo >/dev/null; then
  as_root=sudo
else
  fail "packages are missing, and installing them takes root or sudo." \
       "As root: apt-get install --no-install-recommends$missing"
fi

apt() {
  $as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=120 "$@"
}
echo "setup: installing$missing"
apt update || fail "apt-get update failed; is there a network?"
apt install -y --no-install-recommends $missing ||
  fail "apt-get could not install the packages above; softreel is made for Debian 12 (bookworm)"
