#!/usr/bin/env bash
# Runs every fuzz program of the preset `fuzz` for a while, beginning with fuzz/corpus/NAME if it exists.
#
#   fuzz/run.sh SECONDS [NAME...]
#
# New inputs are kept in build/fuzz/corpus/NAME, what broke a program in build/fuzz/found/NAME.
set -euo pipefail
. "$(dirname -- "${BASH_SOURCE[0]}")/../tools/common.sh"

[[ ${1-} =~ ^[1-9][0-9]*$ ]] || fail "usage: fuzz/run.sh SECONDS [NAME...]"
seconds=$1
shift

programs=()
if [ "$#" -gt 0 ]; then
  for name in "$@"; do programs+=("$root/build/fuzz/fuzz/fuzz_$name"); done
else
  for source in "$root"/fuzz/*_fuzz.cpp; do
    [ -e "$source" ] || fail "fuzz/run.sh: there is no fuzz/*_fuzz.cpp"
    programs+=("$root/build/fuzz/fuzz/fuzz_$(basename -- "$source" _fuzz.cpp)")
  done
fi

status=0
for program in "${programs[@]}"; do
  [ -x "$program" ] || fail "fuzz/run.sh: $program is not built; run 'cmake --preset fuzz && cmake --build --preset fuzz'."
  name=$(basename -- "$program")
  name=${name#fuzz_}
  grown=$root/build/fuzz/corpus/$name
  found=$root/build/fuzz/found/$name
  log=$root/build/fuzz/$name.log
  mkdir -p "$grown" "$found"
  folders=("$grown")
  [ ! -d "$root/fuzz/corpus/$name" ] || folders+=("$root/fuzz/corpus/$name")
  if "$program" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=4096 -seed="${LEKALO_SEED:-1}" \
    -print_final_stats=1 -artifact_prefix="$found/" "${folders[@]}" >"$log" 2>&1 </dev/null; then
    runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
    say "fuzz $name: ok, $runs inputs"
  else
    say "fuzz $name: FAILED, input in $found, log in $log"
    tail -n 40 "$log"
    status=1
  fi
done
exit "$status"
