#!/usr/bin/env bash
# Set-up, release build, and the main jobs on the example data: where does the part lie in the blank, is there
# a better place, and the NC program for the machine; a cutting layout, corrected, checked, drawn and edited. Everything it writes goes to demo-out/.
set -euo pipefail
. "$(dirname -- "${BASH_SOURCE[0]}")/tools/common.sh"

"$root/tools/setup.sh" --build
build_preset release --target lekalo

# From here on as a person would type it, in the folder of the project.
cd "$root"
lekalo=build/release/lekalo
data=examples/localisation
rm -rf demo-out
mkdir -p demo-out

show() {
  printf '\n$'
  printf ' %q' "$@"
  printf '\n'
  "$@"
}

for n in 1 2 3 4 5 6; do
  program=()
  [ "$n" -ne 1 ] || program=(--nc $data/part.nc --nc-out demo-out/part.nc)
  show "$lekalo" locate --part "$data/example-$n-part.csv" --blank "$data/example-$n-blank.csv" \
    "${program[@]}" --picture "demo-out/example-$n.svg" -o "demo-out/example-$n.json"
  show "$lekalo" verify "demo-out/example-$n.json"
done
show "$lekalo" locate --part $data/example-1-part.csv --blank $data/example-1-blank.csv \
  --picture demo-out/example-1.png

regions=examples/regions
show "$lekalo" locate --part $regions/bracket.json --blank $regions/casting.json --min-allowance 1.5 \
  --nc $regions/bracket.nc --nc-out demo-out/bracket.nc --picture demo-out/bracket.svg -o demo-out/bracket.json
show "$lekalo" verify demo-out/bracket.json

# A part built from primitives by Booleans, in a casting that was probed, its program in the machine's frame.
show "$lekalo" locate --part $regions/flange.json --blank $regions/flange-scan.csv --uncertainty 0.01 --min-radius 4 \
  --min-allowance 1 --nc $regions/flange.nc --nc-out demo-out/flange.nc --picture demo-out/flange.svg \
  --report demo-out/flange.pdf --allowances demo-out/flange.csv -o demo-out/flange.json
show "$lekalo" verify demo-out/flange.json
show "$lekalo" locate --part $regions/flange.json --blank $regions/flange-scan.csv --uncertainty 0.01 --min-radius 4 \
  --min-allowance 1 --picture demo-out/flange.png --report demo-out/flange-report.png

# A housing with a bore in its casting, in space: the best place within 5 mm and 5 degrees, with proof.
solid=examples/solid
show "$lekalo" locate --part $solid/part.stl --blank $solid/casting.stl --min-allowance 1.5 --picture demo-out/housing.png \
  --report demo-out/housing.pdf --certificate demo-out/housing-proof.json -o demo-out/housing.json
show "$lekalo" verify demo-out/housing.json
show "$lekalo" locate --part $solid/part.stl --blank $solid/casting.stl --start demo-out/housing.json --method climb \
  --picture demo-out/housing.html
# Its program of three axes there, and the same place in the words of a control.
show "$lekalo" locate --part $solid/part.stl --blank $solid/casting.stl --freedom c-xyz --min-allowance 1.5 \
  --nc $solid/part.nc --nc-out demo-out/housing.nc --control linuxcnc --offset linuxcnc \
  --offset-out demo-out/housing-offset.txt -o demo-out/housing-nc.json
show "$lekalo" verify demo-out/housing-nc.json

# Such a casting as points that a scanner saw on a table: they become a mesh first, and all that is assumed is told.
stated=(--uncertainty 0.01 --min-radius 5 --underside z=-22.6 --flat 0.05 --min-allowance 1 --gap 0.05)
show "$lekalo" locate --part $solid/part.stl --blank $solid/scan.ply --mesh demo-out/housing-scan.ply "${stated[@]}" \
  --picture demo-out/housing-scan.png --report demo-out/housing-scan.pdf -o demo-out/housing-scan.json
show "$lekalo" verify demo-out/housing-scan.json
show "$lekalo" locate --part $solid/part.stl --blank demo-out/housing-scan.ply "${stated[@]}" --method climb \
  --start demo-out/housing-scan.json --picture demo-out/housing-scan.html

# The same casting, touched by a probe instead of scanned: its mesh is moved to the touches.
show "$lekalo" locate --part $solid/part.stl --blank $solid/touches.xyz --nominal-blank $solid/casting.stl --form 0.1 \
  --ball 3 --uncertainty 0.005 --mesh demo-out/housing-touched.ply --min-allowance 1 --gap 0.05 -o demo-out/housing-touched.json
show "$lekalo" verify demo-out/housing-touched.json

# Shoes on a hide: pieces put down by commands, checked, drawn.
layouts=examples/layouts
show "$lekalo" edit $layouts/shoes.json --commands $layouts/shoes.commands -o demo-out/shoes.json
show "$lekalo" check demo-out/shoes.json
show "$lekalo" show demo-out/shoes.json --picture demo-out/shoes.svg
show "$lekalo" show demo-out/shoes.json --picture demo-out/shoes.pdf

# Three pairs on the same hide, laid out by the program.
show "$lekalo" nest $layouts/shoes.json --work 4000000 --seed 1 -o demo-out/shoes-nested.json --picture demo-out/shoes-nested.svg

# A pocket with an island: its program, and what that cuts.
show "$lekalo" pocket examples/pockets/cover.json --tool 6 --depth 4 --stepdown 2 --spindle 12000 -o demo-out/cover.ngc --picture demo-out/cover.png --animation demo-out/cover.html
show "$lekalo" simulate demo-out/cover.ngc --pocket examples/pockets/cover.json --tool 6

# By how much its walls are off because they were cut warm, and its program with the finishing passes moved by that: 1 um
# of overcut is allowed, so the figures have to be closely known. What is computed and not proved, verify names (exit
# status 1).
show "$lekalo" heat demo-out/cover.ngc --pocket examples/pockets/cover.json --stock 108x78x16 --tool 6 --teeth 3 --spindle 12000 \
  --material 6061-T6 --share 0.09..0.11 --cutting-force 500 --force-exponent 0.25 --cooling 15..25 --voxel 2.9 \
  -o demo-out/heat.json --corrected demo-out/cover-corrected.ngc --picture demo-out/heat.png \
  --maps demo-out/heat-maps.png --report demo-out/heat.pdf --animation demo-out/heat.html
show "$lekalo" verify demo-out/heat.json || [ $? -eq 1 ]

# A hub pressed on a shaft: what that does to their surfaces. What is computed and not proved, verify names (exit status 1).
show "$lekalo" fit --fit 18H8/z8 --hub-outer 36 --length 18 --shaft-length 54 --material C45 --friction 0.08,0.12 -o demo-out/fit.json \
  --cylindrical outside --profile demo-out/fit.csv --drawing demo-out/fit.dxf --program demo-out/fit.ngc --picture demo-out/fit.svg
show "$lekalo" verify demo-out/fit.json || [ $? -eq 1 ]

# The editor, seen by a browser (tests drive it further: ctest -L browser).
if [ -x "$(command -v chromium)" ] && [ -d web/node_modules ]; then
  show env LEKALO=$lekalo node web/bench/picture.mjs demo-out/shoes.json demo-out/editor.png
fi

say ""
say "Written to $root/demo-out:"
say "  example-1.svg ... example-6.svg    blank, start, result, contacts and allowance; example-1.png the first as PNG"
say "  example-1.json ... example-6.json  pose, clearance, upper bound, contacts and certificate"
say "  part.nc                            $data/part.nc in the machine's frame"
say "  bracket.svg, bracket.json, bracket.nc  a part with arcs, a slot and holes in a cored casting"
say "  flange.svg, flange.pdf, flange.json, flange.nc, flange.csv  a part of primitives in a probed casting: picture,"
say "                                     report, result, program, allowance along the outline; flange.png, flange-report.png"
say "  housing.png, housing.pdf, housing.html, housing.json, housing-proof.json  a housing with a bore in its casting, in space:"
say "                                     picture, report, a page that turns, result and its proof"
say "  housing-scan.png, housing-scan.pdf, housing-scan.html, housing-scan.json  the same in a scan of such a casting"
say "  shoes.json, shoes.svg, shoes.pdf   a pair of shoes on a hide with defects and zones: layout and picture"
say "  shoes-nested.json, shoes-nested.svg  three pairs laid out by lekalo nest"
say "  cover.ngc, cover.png, cover.html   a pocket with an island: the program that clears it, its path by engagement, played"
say "  heat.json, heat.png, heat-maps.png, heat.pdf, heat.html  by how much the walls of that pocket are off because they"
say "                                     were cut warm, with temperature, stress, displacement, a report, and played"
say "  cover-corrected.ngc                that program with its finishing passes moved by what heat does to the walls"
say "  fit.json, fit.svg, fit.csv, fit.dxf, fit.ngc  a hub pressed on a shaft: pressures and growths along the axis, and what to turn"
say "                                     so that its outside is a cylinder afterwards"
say "  editor.png                         the same in the editor, a part in hand over another. To use it:"
say ""
say "    $lekalo serve $layouts/shoes.json"
say ""
say "and open the address that it prints in a browser."
