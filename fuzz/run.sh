#!/usr/bin/env bash
# Runs every fuzz program of the preset `asan` for a while, beginning with fuzz/corpus/NAME.
#
#   fuzz/run.sh SECONDS [NAME...]
#
# All new inputs stay in build/fuzz/corpus/NAME. Those that reach an edge of the program which no input of
# fuzz/corpus/NAME reaches are added there, the smallest for each: commit them. What broke a program is in
# build/fuzz/found/NAME.
set -euo pipefail
. "$(dirname -- "${BASH_SOURCE[0]}")/../tools/common.sh"

[[ ${1-} =~ ^[1-9][0-9]*$ ]] || fail "usage: fuzz/run.sh SECONDS [NAME...]"
seconds=$1
shift
longest_kept=4096 # bytes

programs=()
if [ "$#" -gt 0 ]; then
  for name in "$@"; do programs+=("$root/build/asan/fuzz/fuzz_$name"); done
else
  for source in "$root"/fuzz/*_fuzz.cpp; do
    [ -e "$source" ] || fail "fuzz/run.sh: there is no fuzz/*_fuzz.cpp"
    programs+=("$root/build/asan/fuzz/fuzz_$(basename -- "$source" _fuzz.cpp)")
  done
fi

# One after the other would leave all processors but one without work.
fuzz() {
  local program=$1 name grown found log kept runs added
  name=$(basename -- "$program")
  name=${name#fuzz_}
  grown=$root/build/fuzz/corpus/$name
  found=$root/build/fuzz/found/$name
  log=$root/build/fuzz/$name.log
  kept=$root/fuzz/corpus/$name
  mkdir -p "$grown" "$found" "$kept"
  if "$program" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=4096 -seed="${LEKALO_SEED:-1}" \
    -print_final_stats=1 -artifact_prefix="$found/" "$grown" "$kept" >"$log" 2>&1 </dev/null &&
    # Edges alone: with how often each was taken, hundreds of inputs would differ.
    "$program" -merge=1 -use_counters=0 -max_len="$longest_kept" -timeout=20 -rss_limit_mb=4096 \
      "$kept" "$grown" >>"$log" 2>&1 </dev/null; then
    runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
    added=$(sed -n 's/^MERGE-OUTER: \([0-9]*\) new files.*/\1/p' "$log" | tail -n 1)
    say "fuzz $name: ok, $runs inputs, ${added:-0} of them kept"
  else
    printf '%s\n' "fuzz $name: FAILED, input in $found, log in $log" "$(tail -n 40 "$log")"
    return 1
  fi
}

for program in "${programs[@]}"; do
  [ -x "$program" ] || fail "fuzz/run.sh: $program is not built; run 'cmake --preset asan && cmake --build --preset asan --target fuzz'."
done
status=0 running=0 most=$(nproc)
for program in "${programs[@]}"; do
  if [ "$running" -ge "$most" ]; then
    wait -n || status=1
  else
    running=$((running + 1))
  fi
  fuzz "$program" &
done
for (( ; running > 0; running--)); do wait -n || status=1; done
exit "$status"
