# Sourced by the scripts of the project: where the tree is, and how steps talk.

root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)

say() { printf '%s\n' "$*"; }
fail() {
  printf '%s\n' "$*" >&2
  exit 1
}

# quietly LOG COMMAND...: at a terminal the command speaks for itself; otherwise it fills LOG, of which only
# the end is shown, and only when the command fails.
quietly() {
  local log=$1 status=0
  shift
  if [ -t 1 ]; then
    "$@" || return
  else
    "$@" >"$log" 2>&1 || status=$?
    if [ "$status" -ne 0 ]; then
      {
        printf '%s\n' "failed ($status): $*"
        tail -n 60 "$log"
        printf '%s\n' "the whole output: $log"
      } >&2
      return "$status"
    fi
  fi
}

# build_preset PRESET [cmake --build arguments...]: builds on after a failure, so that the log names them all.
build_preset() {
  local preset=$1
  shift
  mkdir -p "$root/build"
  say "== build $preset"
  (cd "$root" && quietly "build/$preset-configure.log" cmake --preset "$preset") || return
  (cd "$root" && quietly "build/$preset-build.log" cmake --build --preset "$preset" "$@" -- -k 0) || return
}
