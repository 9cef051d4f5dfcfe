#!/usr/bin/env bash
# LinuxCNC's interpreter rs274 as a test oracle. It is unpacked from Debian's packages, not installed, and nothing of
# it enters a build.
#
#   rs274.sh prepare               fetch and unpack it when missing; prints its folder
#   rs274.sh run FOLDER PROGRAM    canonical motions of PROGRAM on stdout, exit status 0 when it is accepted;
#                                  FOLDER is scratch space for the state that LinuxCNC keeps between runs
#
# The cache is $LEKALO_RS274_DIR, or build/rs274 under the source tree.
set -euo pipefail

# Tests run this some thousand times: it starts no program that it can do without.
here=${BASH_SOURCE[0]%/*}
[ "$here" != "${BASH_SOURCE[0]}" ] || here=.
source_root=$here/../..
cache=${LEKALO_RS274_DIR:-$source_root/build/rs274}
case $cache in /*) ;; *) cache=$PWD/$cache ;; esac
root=$cache/root

# The interpreter and the libraries that a bare Debian 12 lacks. Python starts with it and needs its own library.
packages=(linuxcnc-uspace libboost-python1.74.0 libpython3.11 libpython3.11-minimal libpython3.11-stdlib
  libedit2 libtirpc3 libexpat1 libbsd0 libmd0 libtinfo6 zlib1g
  libgssapi-krb5-2 libkrb5-3 libk5crypto3 libkrb5support0 libkeyutils1 libcom-err2)

fail() {
  printf 'rs274.sh: %s\n' "$1" >&2
  exit 5
}

as_root() { if [ "$(id -u)" = 0 ]; then "$@"; else sudo -n "$@"; fi; }

unpack() {
  local work
  work=$(mktemp -d "$cache/unpack.XXXXXX")
  # shellcheck disable=SC2064
  trap "rm -rf '$work'" EXIT
  chmod 755 "$work"
  (cd "$work" && apt-get download -q "${packages[@]}") >"$cache/download.log" 2>&1 ||
    { as_root apt-get update -q >>"$cache/download.log" 2>&1 &&
      (cd "$work" && apt-get download -q "${packages[@]}") >>"$cache/download.log" 2>&1; } ||
    fail "cannot download ${packages[0]} and its libraries from Debian; see $cache/download.log"
  local package
  for package in "$work"/*.deb; do dpkg-deb -x "$package" "$work/root"; done
  # rs274 reads diameters in inches; tool 4 is the one inch tool that some of LinuxCNC's samples ask for.
  local tool diameter
  for tool in {1..20}; do
    diameter=0.25
    [ "$tool" = 4 ] && diameter=1.0
    printf 'T%d P%d D%s Z0\n' "$tool" "$tool" "$diameter"
  done >"$work/root/tool.tbl"
  rm -rf "$root"
  mv "$work/root" "$root"
}

prepare() {
  mkdir -p "$cache"
  exec 9>"$cache/lock"
  flock 9
  [ -e "$root/tool.tbl" ] || unpack
  printf '%s\n' "$root"
}

run() {
  local folder=$1 program=$2 IFS=:
  : >"$folder/rs274.var"
  local libraries=("$root"/usr/lib "$root"/usr/lib/linuxcnc "$root"/usr/lib/*-linux-gnu "$root"/lib/*-linux-gnu)
  # HOME: LinuxCNC maps ~/.tool.mmap, and a second interpreter truncates it beneath the first. Python keeps what it
  # compiles of its library beside it, in the cache.
  HOME=$folder LD_LIBRARY_PATH=${libraries[*]} PYTHONHOME=$root/usr PYTHONDONTWRITEBYTECODE= \
    exec timeout 60 "$root/usr/bin/rs274" -t "$root/tool.tbl" -v "$folder/rs274.var" -g -n 2 "$program" </dev/null
}

case "${1-}" in
  prepare) prepare ;;
  run) [ $# = 3 ] || fail "run takes FOLDER and PROGRAM"; run "$2" "$3" ;;
  *) fail "prepare or run" ;;
esac
