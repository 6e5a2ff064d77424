#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# Builds the benchmarks, also on a bare Debian 12, runs them and prints one table of rates and
# ratios. If Embree's path tracer (package embree-tools) is installed, both trace the same scenes
# alternately. Run nothing else at the same time.
#
# usage: benchmark.sh [MESH...]    meshes (.ply or .obj) to trace besides the Cornell box;
#                                  the dragon of the tests by default
# CSLF_RUNS says how often each is measured (default 5); medians are printed. CSLF_FOLDER is where
# the files go, build/benchmark/results by default.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

build="$source/build/benchmark"
folder="${CSLF_FOLDER:-$build/results}"
runs="${CSLF_RUNS:-5}"
meshes=("$@")
if [ "${#meshes[@]}" -eq 0 ]; then
  meshes=("$source/Testing/Data/dragon.ply")
fi
size=512
samples=4
frames=32
depth=8

cslf_install "${cslf_packages[@]}" libbenchmark-dev
mkdir -p "$folder"
(cd "$source" && cmake --preset benchmark && cmake --build --preset benchmark)

cslf="$build/bin/cslf"
"$build/bin/cslfBenchmarks" --benchmark_repetitions="$runs" \
  --benchmark_report_aggregates_only=true \
  --benchmark_out="$folder/benchmarks.json" --benchmark_out_format=json "${meshes[@]}" \
  > "$folder/benchmarks.txt"

# The tool's default camera of an OBJ file, for both: the eye and the focal point.
find_camera()
{
  awk '$1 == "v" {
      for (i = 1; i <= 3; ++i) {
        x = $(i + 1)
        if (!seen || x < low[i]) low[i] = x
        if (!seen || x > high[i]) high[i] = x
      }
      seen = 1
    }
    END {
      for (i = 1; i <= 3; ++i) {
        center[i] = (low[i] + high[i]) / 2
        if (high[i] - low[i] > longest) longest = high[i] - low[i]
      }
      printf "%.9g %.9g %.9g %.9g %.9g %.9g\n", center[1], center[2], center[3] + 2.2 * longest,
        center[1], center[2], center[3]
    }' "$1"
}

# compare_with_peer NAME SCENE: million rays per second of both, one line per run, in NAME.rates.
# The OBJ has no materials, so the peer uses white surfaces, and the tool is set to these. The peer
# draws frames of few samples, without counting the first two; the tool draws one picture with as
# many samples.
compare_with_peer()
{
  local name="$1" object="$folder/$1.obj" run rates
  local -a camera
  "$cslf" export "$2" -o "$object" > "$folder/log.txt"
  read -r -a camera < <(find_camera "$object")
  : > "$folder/$name.rates"
  for ((run = 0; run < runs; ++run)); do
    "$cslf" trace "$object" -o "$folder/$name.png" --json --environment white --base-color 1 1 1 \
      --position "${camera[@]:0:3}" --focal-point "${camera[@]:3:3}" --view-up 0 1 0 \
      --view-angle 40 --size "$size" "$size" --spp "$((samples * frames))" \
      --max-depth "$depth" \
      > "$folder/$name.json"
    xvfb-run --auto-servernum pathtracer -i "$object" --ambientlight 1 1 1 \
      --vp "${camera[@]:0:3}" --vi "${camera[@]:3:3}" --vu 0 1 0 --fov 40 \
      --size "$size" "$size" --spp "$samples" --max-path-length "$depth" --benchmark 2 "$frames" \
      > "$folder/$name.peer.txt" 2>&1
    rates="$(awk '$1 == "BENCHMARK_RENDER_MRAYPS_AVG" { print $2 }' "$folder/$name.peer.txt")"
    python3 -c 'import json, sys
cost = json.load(open(sys.argv[1]))
print(cost["rays"] / cost["render_seconds"] / 1e6, sys.argv[2])' "$folder/$name.json" "$rates" \
      >> "$folder/$name.rates"
  done
}

rm -f "$folder"/*.rates
if command -v pathtracer > /dev/null; then
  compare_with_peer cornell-box cornell-box
  for mesh in "${meshes[@]}"; do
    name="$(basename "${mesh%.*}")"
    compare_with_peer "$name" "$mesh"
  done
else
  echo "Embree's path tracer is not installed (package embree-tools): no comparison with it."
fi

python3 - "$folder" << 'PYTHON'
import glob
import json
import os
import statistics
import sys

folder = sys.argv[1]
row = "{:44} {:>12} {:>12} {:>8}"
print(row.format("million rays/s, medians", "CSLF", "peer", "ratio"))
with open(os.path.join(folder, "benchmarks.json")) as file:
    benchmarks = json.load(file)["benchmarks"]
for benchmark in benchmarks:
    if benchmark.get("aggregate_name", "median") != "median":
        continue
    name = benchmark["run_name"].split("/manual_time")[0].split("/repeats")[0]
    if "ratio" in benchmark:
        rates = [benchmark[side + "_rays_per_second"] / 1e6 for side in ("cached", "bare")]
        print(row.format(name + ", bare queries", *("%.2f" % rate for rate in rates),
                         "%.3f" % benchmark["ratio"]))
    else:
        print(row.format(name, "%.2f" % (benchmark["rays_per_second"] / 1e6), "", ""))
for path in sorted(glob.glob(os.path.join(folder, "*.rates"))):
    with open(path) as file:
        runs = [[float(word) for word in line.split()] for line in file]
    name = os.path.splitext(os.path.basename(path))[0] + ", Embree's path tracer"
    medians = [statistics.median(column) for column in zip(*runs)]
    ratio = statistics.median(own / peer for own, peer in runs)
    print(row.format(name, *("%.2f" % rate for rate in medians), "%.3f" % ratio))
PYTHON
