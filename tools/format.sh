#!/usr/bin/env bash
# Formats every C++ file of the project, or with --check only names those that would change.
set -euo pipefail
. "$(dirname -- "${BASH_SOURCE[0]}")/common.sh"
cd "$root"
mode=(-i)
[ "${1-}" != --check ] || mode=(--dry-run --Werror)
git ls-files -z '*.cpp' '*.hpp' | xargs -0 clang-format "${mode[@]}"
