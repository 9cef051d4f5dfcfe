#!/usr/bin/env bash
# Compares two builds of the command `lekalo` over many command lines: exit status, stdout, stderr, and the
# name and bytes of every file written.
#
#   tools/same_bytes.sh OLD NEW [--only REGEX] [--list FILE] [--expected FILE]
#
# OLD, NEW         the two programs.
# --only REGEX     runs only the lines whose name matches.
# --list FILE      the command lines; without it tools/same_bytes.txt, whose first lines say how they are written.
# --expected FILE  differences that are wanted, a line each: the name of a command line, then the reason. Each of
#                  them has to be there, and only others count.
#
# Every line runs once with each program, both at the same time, each in a folder of its own with fresh copies of
# examples/ and tests/corpus/ (as `corpus`) and a link `data` to the data outside the project (LEKALO_SHARED_DATA,
# else ../shared/data; lines that name it are left out where it is missing).
#
# Two things differ from run to run and are emptied before the comparison, files after each step, so that what
# later steps write of their digests is the same: the member `run` of JSON, and the number in "in 1.2 s of
# processor time". Folders of lines that differ are kept. The exit status is 1 when any line differs, and 2 when
# the comparison could not be made.
set -euo pipefail
. "$(dirname -- "${BASH_SOURCE[0]}")/common.sh"

cannot() {
  printf 'same_bytes.sh: %s\n' "$*" >&2
  exit 2
}

only=. list=$root/tools/same_bytes.txt expected=/dev/null programs=()
while [ $# -gt 0 ]; do
  case $1 in
    --only | --list | --expected)
      [ $# -ge 2 ] || cannot "$1 needs a value"
      declare "${1#--}=$2"
      shift 2
      ;;
    -*) cannot "unknown option $1" ;;
    *)
      programs+=("$1")
      shift
      ;;
  esac
done
[ ${#programs[@]} -eq 2 ] || cannot "two programs are needed, OLD and NEW"
for program in "${programs[@]}"; do
  [ -f "$program" ] && [ -x "$program" ] || cannot "$program cannot be run"
done
[ -r "$list" ] && [ -r "$expected" ] || cannot "$list or $expected cannot be read"
shared=${LEKALO_SHARED_DATA:-$root/../shared/data}
kept=$(mktemp -d "${TMPDIR:-/tmp}/same-bytes-XXXXXX")

# What a command line calls: runs one step, notes its exit status, and empties the member `run` of files that it
# wrote.
lekalo() {
  local status=0
  touch -d '2 seconds ago' "$LEKALO_FOLDER/step" # clocks of files are coarse
  timeout 120 "$LEKALO_UNDER_TEST" "$@" || status=$?
  printf '%s: lekalo %s\n' "$status" "$*" >>"$LEKALO_FOLDER/statuses"
  find "$LEKALO_FOLDER/files" -type f -newer "$LEKALO_FOLDER/step" -name '*.json' -print0 |
    xargs -0 -r sed -zi 's/"run": {[^{}]*}/"run": {}/'
  return "$status"
}
export -f lekalo

# run_line PROGRAM FOLDER COMMAND-LINE
run_line() {
  mkdir -p "$2/files"
  cp -r --preserve=timestamps "$root/examples" "$root/tests/corpus" "$2/files"
  [ ! -d "$shared" ] || ln -s "$(realpath "$shared")" "$2/files/data"
  : >"$2/statuses"
  (
    cd "$2/files"
    export HOME=$2 LEKALO_FOLDER=$2 LEKALO_UNDER_TEST=$1
    unset XDG_DATA_HOME
    bash -c "$3" >../stdout 2>../stderr </dev/null || true
  )
  rm -f "$2/step"
  sed -zi 's/"run": {[^{}]*}/"run": {}/g' "$2/stdout"
  sed -i -E 's/in [0-9]+\.[0-9] s of processor time/in _ s of processor time/' "$2/stderr"
}

is_text() { [ ! -s "$1" ] || grep -qI '' "$1"; }

# The first place where two files differ.
first_difference() {
  if is_text "$1" && is_text "$2"; then
    local number old new
    number=$(diff --text "$1" "$2" | sed -nE '1s/^([0-9]+).*/\1/p') || true
    old=$(diff --text "$1" "$2" | sed -n '/^< /{s/^< //p;q}') || true
    new=$(diff --text "$1" "$2" | sed -n '/^> /{s/^> //p;q}') || true
    printf 'line %s: "%.120s" became "%.120s"' "$number" "$old" "$new"
  else
    cmp "$1" "$2" | sed 's/.*differ: //' || true
  fi
}

# differences FOLDER: a line for each thing that FOLDER/old and FOLDER/new have not in common.
differences() {
  local path
  diff -rq --no-dereference "$1/old" "$1/new" >"$1/differ" && return
  while IFS= read -r path; do
    if [ ! -e "$1/new/$path" ]; then
      printf '%s is missing\n' "$path"
    elif [ ! -e "$1/old/$path" ]; then
      printf '%s is new\n' "$path"
    elif ! cmp -s "$1/old/$path" "$1/new/$path"; then
      printf '%s differs: %s\n' "$path" "$(first_difference "$1/old/$path" "$1/new/$path")"
    fi
  done < <((cd "$1/old" && find . -type f && cd ../new && find . -type f) | sed 's|^\./||' | sort -u)
}

# The reason why a line is expected to differ; nothing where it is not.
reason_for() { awk -v name="$1" '$1 == name { sub(/^[^ ]+ */, ""); print; exit }' "$expected"; }

lines=0 steps=0 differing=0 wanted=0 without_data=0
old=$(realpath "${programs[0]}") new=$(realpath "${programs[1]}")
while IFS= read -r line; do
  [[ $line =~ ^([A-Za-z0-9_.-]+):\ +(.*)$ ]] || cannot "$list: not a name and a command line: $line"
  name=${BASH_REMATCH[1]} command=${BASH_REMATCH[2]}
  [[ $name =~ $only ]] || continue
  if [[ $command == *data/* && ${command//corpus\/data\//} == *data/* && ! -d $shared ]]; then
    without_data=$((without_data + 1))
    continue
  fi
  lines=$((lines + 1))
  folder=$kept/$name
  [ ! -e "$folder" ] || cannot "$list: two lines are named $name"
  run_line "$old" "$folder/old" "$command" &
  running=$!
  run_line "$new" "$folder/new" "$command" || cannot "$name could not be run with $new"
  wait "$running" || cannot "$name could not be run with $old"
  [ -s "$folder/old/statuses" ] || cannot "$name runs no step with $old"
  steps=$((steps + $(wc -l <"$folder/old/statuses")))
  found=$(differences "$folder")
  reason=$(reason_for "$name")
  if [ -n "$found" ] && [ -n "$reason" ]; then
    wanted=$((wanted + 1))
    say "$name: differs as expected: $reason"
  elif [ -n "$found" ]; then
    differing=$((differing + 1))
    while IFS= read -r one; do say "$name: $one (in $folder/old and new)"; done <<<"$found"
  elif [ -n "$reason" ]; then
    differing=$((differing + 1))
    say "$name: was expected to differ and does not: $reason"
  fi
  [ -n "$found" ] || rm -rf "${folder:?}"/{old,new,differ}
done < <(grep -vE '^[[:space:]]*(#|$)' "$list")

[ "$lines" -gt 0 ] || cannot "no line of $list has a name that matches $only"
note=
[ "$wanted" -eq 0 ] || note+=", $wanted as expected"
[ "$without_data" -eq 0 ] || note+=", $without_data left out without $shared"
say "$lines command lines of $steps steps, $differing differ$note"
[ "$differing" -gt 0 ] || [ "$wanted" -gt 0 ] || rm -rf "$kept"
[ "$differing" -eq 0 ]
