#!/usr/bin/env bash
# tools/same_bytes.sh must find nothing between a program and itself, and every difference planted by a program
# that changes one thing.
#
#   same_bytes_test.sh LEKALO FOLDER      FOLDER is emptied and used
set -euo pipefail
lekalo=$1 folder=$2
compare=$(realpath "$(dirname -- "${BASH_SOURCE[0]}")/../../tools/same_bytes.sh")
rm -rf "$folder"
mkdir -p "$folder/tmp"
cd "$folder"
export TMPDIR=$folder/tmp LEKALO_SHARED_DATA=$folder/nothing

cat >list.txt <<'END'
# A comment, and an empty line.

locate: lekalo locate --part examples/localisation/example-1-part.csv --blank examples/localisation/example-1-blank.csv -o r.json --json && lekalo verify r.json --json
nest: lekalo nest corpus/data/hides/small.json --work 1 -o n.json
refused: lekalo check nowhere.json
elsewhere: lekalo check data/nowhere.json
END

# plant NAME CODE: a program that does as lekalo does and then runs CODE, with the exit status in $status.
plant() {
  printf '#!/usr/bin/env bash\nstatus=0\n"%s" "$@" 2>%s/said || status=$?\n%s\n' "$lekalo" '$LEKALO_FOLDER' "$2" >"$1"
  chmod +x "$1"
}
tell='cat "$LEKALO_FOLDER/said" >&2; rm "$LEKALO_FOLDER/said"; '
plant same "$tell"'exit $status'
plant status "$tell"'[ $status -ne 3 ] || status=2; exit $status'
plant digit "$tell"'[ ! -f n.json ] || sed -i "0,/1/s//2/" n.json; exit $status'
plant silent 'sed 1d "$LEKALO_FOLDER/said" >&2; rm "$LEKALO_FOLDER/said"; exit $status'
plant more "$tell"'touch more.txt; exit $status'
plant fewer "$tell"'rm -f r.json; exit $status'
plant talkative "$tell"'echo; exit $status'

# compared EXPECTED-STATUS NEW LINES [ARGUMENTS...]: the output has to be LINES; digits and folders apart.
compared() {
  local wanted=$1 new=$2 lines=$3 status=0 out
  shift 3
  out=$("$compare" "$lekalo" "$new" --list list.txt "$@" 2>&1) || status=$?
  out=$(sed -E 's/ differs: .*/ differs/; s/ \(in .*//; s/ of [0-9]+ steps//; s/ without .*//' <<<"$out")
  if [ "$status" -ne "$wanted" ] || [ "$out" != "$lines" ]; then
    printf '%s %s: exit status %s, not %s; it says\n%s\nand not\n%s\n' "$new" "$*" "$status" "$wanted" "$out" "$lines"
    exit 1
  fi
}

compared 0 "$folder/same" '3 command lines, 0 differ, 1 left out'
[ -z "$(ls tmp)" ] || { echo "folders are kept although nothing differs"; exit 1; }
compared 1 "$folder/status" 'refused: statuses differs
3 command lines, 1 differ, 1 left out'
compared 1 "$folder/digit" 'nest: files/n.json differs
1 command lines, 1 differ' --only nest
compared 1 "$folder/silent" 'refused: stderr differs
1 command lines, 1 differ' --only refused
compared 1 "$folder/more" 'refused: files/more.txt is new
1 command lines, 1 differ' --only refused
compared 1 "$folder/fewer" 'locate: files/r.json is missing
locate: statuses differs
locate: stderr differs
locate: stdout differs
1 command lines, 1 differ' --only locate
compared 1 "$folder/talkative" 'refused: stdout differs
1 command lines, 1 differ' --only refused

# A difference that is stated has to be there, and excuses no other.
echo 'refused the exit status says more' >expected.txt
compared 0 "$folder/status" 'refused: differs as expected: the exit status says more
1 command lines, 0 differ, 1 as expected' --expected expected.txt --only refused
compared 1 "$folder/same" 'refused: was expected to differ and does not: the exit status says more
1 command lines, 1 differ' --expected expected.txt --only refused
compared 1 "$folder/digit" 'nest: files/n.json differs
1 command lines, 1 differ' --expected expected.txt --only nest

# What cannot be compared is no agreement.
compared 2 "$folder/nothing" "same_bytes.sh: $folder/nothing cannot be run"
compared 2 "$folder/same" 'same_bytes.sh: no line of list.txt has a name that matches nobody' --only nobody
