#!/usr/bin/env bash
# Builds the kernel of the page, and copies it to where the page wants it.
#
#   tools/build_wasm.sh [FOLDER]      build/release/lekalo.wasm, copied into FOLDER
set -euo pipefail
. "$(dirname -- "${BASH_SOURCE[0]}")/common.sh"

"$root/tools/setup.sh" --build
build_preset release --target lekalo_wasm
if [ -n "${1-}" ]; then
  mkdir -p "$1"
  cp "$root/build/release/lekalo.wasm" "$1/lekalo.wasm"
fi
