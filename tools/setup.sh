#!/usr/bin/env bash
# Installs what the build needs and is missing, on Debian 12 and its kin. Asks nothing; running it again
# changes nothing.
#
#   tools/setup.sh --build  compilers, CMake and libraries: enough for demo.sh
#   tools/setup.sh          also the browser and the other programs that test.sh compares with
#   tools/setup.sh --step   also OCCT, for lekalo-step, which makes meshes of STEP files
#   tools/setup.sh --full   all of it, clang and what else test.sh --full needs
set -euo pipefail
. "$(dirname -- "${BASH_SOURCE[0]}")/common.sh"

packages=(
  g++ cmake ninja-build pkg-config ccache
  libexpected-dev libfmt-dev libcli11-dev nlohmann-json3-dev # header libraries and text
  libmpfr-dev libgmp-dev                                     # exact checks
  libpng-dev                                                 # M-images
  libcairo2-dev fonts-dejavu-core                            # PNG pictures; their texts, Cyrillic too
  libqrencode-dev                                            # QR codes of labels (LGPL 2.1, linked as a shared library)
  libexpat1-dev                                              # XML of SVG drawings
  zlib1g-dev                                                 # ZIP of 3MF models
  libboost-dev libsqlite3-dev                                # the server of the editor: HTTP and WebSocket, its store
  # the reference method; its pkg-config file also names libraries that its package does not bring
  coinor-libipopt-dev libblas-dev liblapack-dev libgfortran-12-dev
  # lekalo.wasm, the kernel of the page, and what builds the page
  clang-19 lld-19 wasi-libc libc++-19-dev-wasm32 libclang-rt-19-dev-wasm32 nodejs
  libgtest-dev
)
test_packages=(
  chromium           # shows the page
  python3            # a third opinion on results, written by a stranger
  python3-ezdxf python3-gdal # the same on DXF drawings
  python3-svgelements        # and on SVG
  librsvg2-bin python3-numpy python3-pil # and rasters of both
  poppler-utils zbar-tools   # prints labels and reads their QR codes
  python3-shapely            # a second opinion on layouts
  python3-jsonschema         # the schema of layouts
)
full_packages=(
  calculix-ccx # an oracle of interference fits and of heat, in a process of its own; GPL, and part of nothing that is shipped
  clang libclang-rt-14-dev lld llvm libbenchmark-dev
  occt-misc netgen-doc # solids of others, which lekalo-step reads
  libpolyclipping-dev libcgal-dev # rivals and oracle of Booleans; CGAL is under the GPL and linked by nothing that is shipped
)

step_packages=(
  libocct-data-exchange-dev libocct-modeling-algorithms-dev
)

# Node from elsewhere than Debian brings its own npm, and refuses Debian's.
command -v npm >/dev/null || packages+=(npm)

case "${1-}" in
  --build) ;;
  "") packages+=("${test_packages[@]}") ;;
  --step) packages+=("${test_packages[@]}" "${step_packages[@]}") ;;
  --full) packages+=("${test_packages[@]}" "${full_packages[@]}" "${step_packages[@]}") ;;
  *) fail "tools/setup.sh: unknown argument '$1'; it takes --build, --step, --full or nothing." ;;
esac

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  say "set-up: no apt-get on this system; going on with what is installed (wanted: ${packages[*]})."
  exit 0
fi

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
[ "${#missing[@]}" -gt 0 ] || exit 0

if [ "$(id -u)" -eq 0 ]; then
  as_root=()
elif command -v sudo >/dev/null && { sudo -n true 2>/dev/null || [ -t 0 ]; }; then
  as_root=(sudo)
else
  fail "set-up: missing Debian packages (${missing[*]}): run this as root or with sudo, or install them with 'apt-get install --no-install-recommends ${missing[*]}'."
fi

log=$(mktemp)
trap 'rm -f -- "$log"' EXIT

apt() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=300 "$@" >>"$log" 2>&1
}
# A list that cannot be fetched (someone's third-party source) does not matter if the install succeeds.
install_missing() {
  apt update || true
  apt install -y --no-install-recommends "${missing[@]}"
}

say "set-up: installing ${#missing[@]} Debian packages (${missing[*]})"
if ! install_missing; then
  say "set-up: the package manager failed; once more in 10 seconds"
  sleep 10
  if ! install_missing; then
    tail -n 40 "$log" >&2
    fail "set-up: apt-get could not install ${missing[*]}; its last lines are above."
  fi
fi
say "set-up: done"
