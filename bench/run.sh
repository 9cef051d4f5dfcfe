#!/usr/bin/env bash
# Builds the benchmarks and prints the tables of one run as markdown: times, ratios to the rivals, how often they fail.
#
#   bench/run.sh [random cases, 200]
set -euo pipefail
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
cgal=OFF
[ -d /usr/include/CGAL ] && cgal=ON
cmake --preset bench -DLEKALO_WITH_CGAL=$cgal > /dev/null
targets=(bench_locate bench_locate_region bench_scan bench_compare bench_compare_regions bench_scene bench_clearance bench_solid_files bench_locate_solid)
[ -f /usr/include/polyclipping/clipper.hpp ] && targets+=(bench_boolean)
cmake --build --preset bench --target "${targets[@]}" > /dev/null
echo "commit $(git rev-parse --short HEAD), $(c++ --version | head -1), $(grep -m1 'model name' /proc/cpuinfo | cut -d: -f2), seed ${LEKALO_SEED:-1}"
echo
build/bench/bench/bench_compare "${1:-200}"
echo
build/bench/bench/bench_compare_regions
echo
build/bench/bench/bench_locate --benchmark_counters_tabular=true
echo
build/bench/bench/bench_locate_region --benchmark_counters_tabular=true
echo
build/bench/bench/bench_scan --benchmark_counters_tabular=true
if [ -n "${LEKALO_SHARED_DATA:-}" ]; then
  echo
  build/bench/bench/bench_scene
  build/bench/bench/bench_scene --scale
fi
echo
build/bench/bench/bench_clearance
echo
build/bench/bench/bench_solid_files
echo
for kind in convex uneven cored turned wavy; do build/bench/bench/bench_locate_solid $kind 10; done
if [ "${targets[-1]}" = bench_boolean ]; then
  echo
  build/bench/bench/bench_boolean
fi
