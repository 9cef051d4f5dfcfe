#!/usr/bin/env bash
# How this folder was written, by lekalo 0.1 (commit 0a00c8d). It is not to be written again: what 0.1 wrote has to
# be read for good. tests/e2e/written_before_test.cpp holds what later versions have to say of it.
#
#   ./make.sh LEKALO      LEKALO: the program; python3 plays the page that fills the store of `lekalo serve`
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")"
root=../../../.. lekalo=$1
find . -type f ! -name make.sh ! -name fill_store.py ! -name README.md ! -name answers.txt -delete
may_say_no() { "$@" || [ $? -eq 1 ]; }

# What is read.
cp "$root"/examples/localisation/example-{1,2,4,5}-{part,blank}.csv .
cp "$root"/examples/localisation/part.nc "$root"/examples/regions/{bracket,casting,bracket-features}.json .
cp "$root"/examples/regions/bracket.nc .
cp "$root"/examples/layouts/shoes.{json,commands} "$root"/examples/orders/{begun,bags}.json .
cp "$root"/tests/corpus/data/layouts/order.json "$root"/tests/corpus/data/hides/small.{json,commands} .
cp "$root"/tests/corpus/pockets/L.json pocket.json
printf '0 0\n80 0\n80 40\n0 40\n' >plate.csv
printf '100 100\n145 100.03\n190 100\n190 150\n100 150\n' >dented.csv
sed 's/46,155/46.2,155/' example-1-blank.csv >example-1-again.csv
printf '{"units": "mm", "shape": {"difference": [{"rounded_rectangle": {"size": [40, 20], "radius": 4}}, {"circle": {"radius": 5}}]}}\n' >tree-part.json
printf '{"units": "mm", "shape": {"union": [{"rectangle": {"size": [46, 24]}}, {"circle": {"centre": [20, 0], "radius": 13}}]}}\n' >tree-blank.json
python3 - >scan.csv <<'END'
for k in range(40): print(2.0 * k, 0)
for k in range(30): print(80, 2.0 * k)
for k in range(40): print(80 - 2.0 * k, 60)
for k in range(30): print(0, 60 - 2.0 * k)
END

# Results of convex contours.
convex() { may_say_no "$lekalo" locate --part "example-$1-part.csv" --blank "example-$1-blank.csv" "${@:2}"; }
convex 1 -o convex.json --nc part.nc --nc-out convex.nc
convex 2 -o convex-file.json --certificate convex-file.certificate.json
convex 4 -o alternatives.json --alternatives 0.5 --min-allowance 0.3
convex 1 -o infeasible.json --min-allowance 2
convex 1 -o window.json --window -5 5 --gap 1e-6
convex 5 -o stopped.json --work 1
convex 2 -o ipopt.json --method ipopt --starts 3 --seed 7
convex 5 -o icp.json --method icp
"$lekalo" locate --part plate.csv --blank dented.csv --trim 0.05 -o trim.json --deviations trim.csv
"$lekalo" locate --part example-1-part.csv --blank example-1-again.csv --compare convex.json -o compared.json

# Results of regions, trees, scans, drawings.
bracket() { may_say_no "$lekalo" locate --part bracket.json --blank casting.json "${@:2}" -o "$1.json"; }
bracket region --drawing placed.dxf --nc bracket.nc --nc-out region.nc
bracket region-file --certificate region-file.certificate.json
bracket region-mirrored --mirror yes --gap 0.05 --drawing placed.svg
bracket region-infeasible --min-allowance 9
bracket region-stopped --work 50
bracket region-locked --lock-x 211 --lock-y 95
bracket region-features --features bracket-features.json
bracket region-largest --criterion largest --give-up 0.1 --trade-off 2 --gap 0.1
bracket region-even --criterion even --give-up 0.2 --gap 0.2
"$lekalo" locate --part tree-part.json --blank tree-blank.json --window 0 40 --gap 0.1 -o tree.json
for kind in dxf svg; do
  may_say_no "$lekalo" locate --part "placed.$kind" --part-layers PART --blank "placed.$kind" --blank-layers BLANK \
    --window -2 2 --gap 0.05 -o "drawn-$kind.json"
done
may_say_no "$lekalo" locate --part plate.csv --blank scan.csv --uncertainty 0.01 --max-dip 0.2 --window -5 5 \
  --gap 0.1 -o scan-infeasible.json
printf '0 0\n70 0\n70 40\n0 40\n' >small-plate.csv
may_say_no "$lekalo" locate --part small-plate.csv --blank scan.csv --uncertainty 0.01 --max-dip 0.2 --window -5 5 \
  --gap 0.1 -o scan.json

# Layouts and what is exported from them.
"$lekalo" edit shoes.json --commands shoes.commands -o shoes-edited.json
"$lekalo" edit small.json --commands small.commands -o small-edited.json
printf 'lekalo-commands/1\nfit tongue hide 0\nfit tongue hide 0\nmode free\nmove 1 by 0 -900\n' >free.commands
printf 'lekalo-commands/1\nslide 1 towards 1 0\n' >slide.commands
may_say_no "$lekalo" edit shoes.json --commands free.commands -o shoes-broken.json
may_say_no "$lekalo" nest begun.json --work 20000 --threads 1 -o begun-nested.json --json >begun-report.json
may_say_no "$lekalo" nest bags.json --work 5000 --threads 1 -o bags-nested.json --json >bags-report.json
may_say_no "$lekalo" nest order.json --work 2000 --threads 1 -o order-nested.json --json >order-report.json
cat >strip.json <<'END'
{"name": "roll", "strip_height": 100, "items": [
 {"id": 0, "demand": 4, "allowed_orientations": [0, 180], "shape": {"type": "simple_polygon", "data": [[0, 0], [30, 0], [30, 20], [10, 20]]}},
 {"id": 1, "demand": 3, "allowed_orientations": [0, 90], "shape": {"type": "simple_polygon", "data": [[0, 0], [25, 0], [0, 25]]}}]}
END
"$lekalo" nest strip.json --work 5000 --threads 1 -o strip-nested.json --json >strip-report.json
"$lekalo" export strip-nested.json --format placements --instance-name strip.json -o strip-placements.json
"$lekalo" export shoes-edited.json --format dxf -o shoes-edited.dxf
"$lekalo" export shoes-edited.json --format svg --only CUT,SHEET -o shoes-edited.svg
"$lekalo" export begun-nested.json --format gcode --kerf 0.3 --feed 2000 --lead-in 1 --sheet rest -o begun.nc
"$lekalo" check shoes-broken.json --json >shoes-check.json || [ $? -eq 1 ]

# Programs of pockets, with arcs and ramps.
"$lekalo" pocket pocket.json --tool 10 --depth 4 --stepdown 2 -o pocket.ngc --json >pocket-report.json
"$lekalo" pocket pocket.json --tool 4 --depth 4 --stepdown 2 --after pocket.ngc:10 -o rest.ngc --json >rest-report.json
cat >slotted.json <<'END'
{"units": "mm", "outer": [
 {"line": {"from": [0, 0], "to": [14, 0]}}, {"line": {"from": [14, 0], "to": [14, 3.95]}}, {"line": {"from": [14, 3.95], "to": [24, 3.95]}},
 {"line": {"from": [24, 3.95], "to": [24, 0]}}, {"line": {"from": [24, 0], "to": [38, 0]}}, {"line": {"from": [38, 0], "to": [38, 14]}},
 {"line": {"from": [38, 14], "to": [24, 14]}}, {"line": {"from": [24, 14], "to": [24, 10.05]}}, {"line": {"from": [24, 10.05], "to": [14, 10.05]}},
 {"line": {"from": [14, 10.05], "to": [14, 14]}}, {"line": {"from": [14, 14], "to": [0, 14]}}, {"line": {"from": [0, 14], "to": [0, 0]}}]}
END
"$lekalo" pocket slotted.json --tool 6 --depth 1 -o slotted.ngc --json >slotted-report.json

# The store of the server.
python3 fill_store.py "$lekalo" shoes-edited.json store.sqlite
