# Sourced by test.sh --full: every step runs, whatever became of the one before; the summary says which
# failed. Sizes are those of the tables the project answers for; smaller ones by environment.

out=$root/test-out
summary=$out/summary.txt
failed=()

export LEKALO_SEED=${LEKALO_SEED:-1}
export LEKALO_CASES=${LEKALO_CASES:-10000}
export LEKALO_TIMES=${LEKALO_TIMES:-20}
export LEKALO_SHARED_DATA=${LEKALO_SHARED_DATA:-$root/../shared/data} # required here
fuzz_seconds=${LEKALO_FUZZ_SECONDS:-60}

note() { say "$*" | tee -a "$summary"; }

# Steps by name, or all; the summary of a run of some is added to that of the runs before it.
known=(dev clang builds-agree asan tsan fuzz coverage mutation bench demo)
for name in "$@"; do
  case " ${known[*]} " in
    *" $name "*) ;;
    *) fail "test.sh --full: there is no step '$name'; there are ${known[*]}." ;;
  esac
done
wanted=" ${*:-${known[*]}} "

# step NAME COMMAND...: output to test-out/NAME.log, verdict to the summary.
step() {
  local name=$1 log=$out/$1.log start=$SECONDS status=0
  shift
  case "$wanted" in *" $name "*) ;; *) return 0 ;; esac
  # A subshell of its own, so that `set -e` holds inside the step although its failure is caught here.
  set +e
  (set -e; "$@") >"$log" 2>&1 </dev/null
  status=$?
  set -e
  if [ "$status" -eq 0 ]; then
    note "$(printf '%-22s ok      %6d s' "$name" $((SECONDS - start)))"
  else
    note "$(printf '%-22s FAILED  %6d s   (%s)' "$name" $((SECONDS - start)) "test-out/$name.log")"
    failed+=("$name")
    tail -n 30 "$log" >&2
  fi
  grep -E '^[0-9]+% tests passed|^Total Test time' "$log" | sed 's/^/    /' | tee -a "$summary" || true
}

build_and_test() {
  build_preset "$1"
  run_ctest "$1" --timeout 7200
}

# The quick counts: a sanitizer and another compiler look for what a few cases show as well as many.
quick_suite() {
  unset LEKALO_CASES LEKALO_TIMES
  export UBSAN_OPTIONS=print_stacktrace=1 LSAN_OPTIONS=suppressions=$root/tests/lsan.supp:print_suppressions=0
  # Of each allocation three callers are kept, which a report shows. All thirty cost recursive code half of its time.
  export ASAN_OPTIONS=${ASAN_OPTIONS:-malloc_context_size=3}
  build_and_test "$1"
}

# The tests of what starts threads: share_out, the fields and nests and simulations over it, the server, and the
# commands over them. The others would be built and run for nothing. The limit on the size of files that stands for a
# full disk (serve_disk) ends the sanitizer itself.
threaded() {
  unset LEKALO_CASES LEKALO_TIMES
  local fields='^(unit|property)\.field' targets none='^e2e\.serve_disk$'
  local tests="$fields|^(unit|property|differential|e2e)\.(base_(parallel|stop)|jobs|locate_solid|nest|mill|serve|verify_(simulate|tree|layout)|layout_check|io_files|cli_(nest|order|pocket))"
  (cd "$root" && cmake --preset tsan)
  mapfile -t targets < <(cd "$root" && ctest --preset tsan -N -R "$tests" -E "$none" |
    sed -n 's/^ *Test *#[0-9]*: \([a-z0-9]*\)\./\1_/p')
  [ "${#targets[@]}" -gt 0 ] || fail "no test has threads"
  build_preset tsan --target lekalo "${targets[@]}"
  run_ctest tsan --timeout 7200 -R "$tests" -E "$none"
}

# The long counts. On a machine that does nothing else, the server answers in the time that it is to keep.
long_counts() {
  build_preset dev
  [ -x "$root/build/dev/lekalo-step" ] || fail "there is no OCCT, so STEP files would not be tested; tools/setup.sh --full installs it"
  command -v ccx >/dev/null ||
    fail "there is no CalculiX, so interference fits and heat would not be held against it; tools/setup.sh --full installs it"
  LEKALO_FULL=1 run_ctest dev --timeout 7200
}

# Two compilers, the same bytes: results of the examples, but for the field that varies from run to run.
builds_agree() {
  local data=$root/examples build
  for build in dev clang; do
    mkdir -p "$out/agree-$build"
    for n in 1 2 3 4 5 6; do
      (cd "$data/localisation" && "$root/build/$build/lekalo" locate --part "example-$n-part.csv" \
        --blank "example-$n-blank.csv" --json --picture "$out/agree-$build/$n.svg") |
        grep -v '"run":' >"$out/agree-$build/$n.json"
    done
    (cd "$data/regions" && "$root/build/$build/lekalo" locate --part bracket.json --blank casting.json --json \
      --mirror either --picture "$out/agree-$build/bracket.svg") | grep -v '"run":' >"$out/agree-$build/bracket.json"
    (cd "$data/layouts" && "$root/build/$build/lekalo" edit shoes.json --commands shoes.commands \
      -o "$out/agree-$build/shoes.json")
    (cd "$data/pockets" && "$root/build/$build/lekalo" pocket cover.json --tool 6 --stepover 20% --depth 4 \
      --stepdown 2 --feed-max 3000 -o "$out/agree-$build/cover.ngc" --json) |
      grep -v '"path":' >"$out/agree-$build/cover.json"
    # Not all of the kits' pieces have room there (exit status 1).
    (cd "$data/layouts" && "$root/build/$build/lekalo" nest shoes.json --work 300000 \
      -o "$out/agree-$build/nested.json") || [ "$?" -eq 1 ]
    # 200 sessions of 200 commands each: what they did, and replayed, as one number.
    LEKALO_CASES=5000 LEKALO_TIMES=1000 "$root/build/$build/tests/property_layout_commands" --gtest_filter='*Undone*' |
      grep '^digest' >"$out/agree-$build/sessions.txt"
  done
  diff -r "$out/agree-dev" "$out/agree-clang"
}

fuzz_all() {
  build_preset asan --target fuzz
  "$root/fuzz/run.sh" "$fuzz_seconds"
}

# The quick suite, and how much of each module it runs: the table is the end of the log.
coverage() {
  find "$root/build/coverage" -name '*.gcda' -delete 2>/dev/null || true
  unset LEKALO_CASES LEKALO_TIMES
  build_and_test coverage
  "$root/tools/coverage.py" "$root/build/coverage" --files >"$out/coverage-files.txt"
  "$root/tools/coverage.py" "$root/build/coverage" | tee "$out/coverage.txt"
}

# What the tests of the checker would not notice: 0 mutants that nobody has explained. The quick counts, for each
# mutant is a run of its own.
mutation() {
  build_preset mutation
  unset LEKALO_CASES LEKALO_TIMES
  # The rest of the hour that a step may take; a mutant that is not tried by then fails the step.
  "$root/tools/mutants.py" run "$root/build/mutation/tests/mutation/copy" "$root/build/mutation/tests/mutation/mutants" \
    --minutes 45
}

describe_run() {
  local git=(git -C "$root" -c safe.directory='*')
  note "commit    $("${git[@]}" rev-parse HEAD 2>/dev/null || say unknown)$(
    [ -z "$("${git[@]}" status --porcelain 2>/dev/null)" ] || say ' with local changes')"
  note "seed      $LEKALO_SEED"
  note "cases     $LEKALO_CASES, at most $LEKALO_TIMES times the quick count (dev alone; the others run the quick counts), fuzzing $fuzz_seconds s a program"
  note "compilers $(c++ --version | head -n 1); $(clang++ --version | head -n 1)"
  note "machine   $(nproc) processors, $(uname -m), $(date -u +%Y-%m-%dT%H:%M:%SZ)"
  note ""
}

mkdir -p "$out"
[ "$#" -gt 0 ] || : >"$summary"
"$root/tools/setup.sh" --full
describe_run
step dev long_counts
step clang quick_suite clang
step builds-agree builds_agree
step asan quick_suite asan
step tsan threaded
step fuzz fuzz_all
step coverage coverage
step mutation mutation
step bench "$root/bench/run.sh"
step demo "$root/demo.sh"

note ""
if [ "${#failed[@]}" -gt 0 ]; then
  note "failed: ${failed[*]}"
  exit 1
fi
note "all steps passed; logs and this summary are in test-out/"
