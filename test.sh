#!/usr/bin/env bash
# Set-up, build and tests.
#
#   ./test.sh          the quick suite on the dev preset
#   ./test.sh --full [STEP...]   the long counts, every preset, the fuzz programs; everything logged in test-out/
#                      (steps: dev clang builds-agree asan tsan fuzz coverage mutation bench demo; all of them
#                      without names)
#
# LEKALO_SEED=N chooses the seed of the random cases; a failing test prints the one it used.
set -euo pipefail
. "$(dirname -- "${BASH_SOURCE[0]}")/tools/common.sh"

jobs=$(nproc)

# run_ctest PRESET [ctest arguments...]: without the lines that only say that a test starts.
run_ctest() {
  local preset=$1
  shift
  (cd "$root" && ctest --preset "$preset" -j "$jobs" --no-tests=error "$@") 2>&1 | sed -u '/^ *Start /d'
}

quick() {
  "$root/tools/setup.sh"
  build_preset dev
  say "== test dev"
  run_ctest dev
}

case "${1-}" in
  "") quick ;;
  --full) shift; . "$root/tools/full.sh" ;;
  *) fail "test.sh: unknown argument '$1'; it takes --full or nothing." ;;
esac
