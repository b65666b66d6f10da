#!/usr/bin/env bash
# Usage: scripts/bench.sh [OPTION OF GOOGLE BENCHMARK]...    for example: scripts/bench.sh --benchmark_filter=/5$
# Sets up, builds, checks the peers' answers, compares our solvers with them and prints the table; JSON in out/bench/.
# How it measures and how to read it: bench/README.md.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"

if [[ "${1:-}" == -h || "${1:-}" == --help ]]; then
  sed -n '2,4s/^# //p' "${BASH_SOURCE[0]}"
  exit 0
fi

"$root/scripts/build.sh" --bench >&2

bench="$root/build/bench/bench/ridgeloc_bench"
out="$root/out/bench"
mkdir -p "$out"

# One core for everything, the last that we may use: the first serves more interrupts.
core="$(taskset --cpu-list --pid $$ | grep -oE '[0-9]+$')"
on_one_core=(taskset --cpu-list "$core")

echo "bench: checking the answers of the peers" >&2
"$bench" --check >&2

echo "bench: $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1), core $core" >&2
"${on_one_core[@]}" "$bench" --benchmark_repetitions=21 --benchmark_min_time=0.05 \
  --benchmark_enable_random_interleaving=true --benchmark_out="$out/bench.json" --benchmark_out_format=json "$@" >&2

"${on_one_core[@]}" "$root/build/bench/bench/ridgeloc_bench_coarse" --benchmark_repetitions=9 --benchmark_min_time=0.05 \
  --benchmark_enable_random_interleaving=true --benchmark_out="$out/coarse.json" --benchmark_out_format=json "$@" >&2

# A filter may leave one of them empty.
tables=()
for file in "$out/bench.json" "$out/coarse.json"; do
  if [[ -s $file ]]; then tables+=("$file"); fi
done
for points in 3 4 5 7; do
  # Only beside the rows that were asked for.
  grep -q "\"run_name\": \"[a-z].*/$points\"" "$out/bench.json" || continue
  "$bench" --write-problems "$out/problems-$points.csv" "$points"
  OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 "${on_one_core[@]}" \
    /usr/bin/python3 "$root/bench/scipy_peer.py" "$out/problems-$points.csv" >"$out/scipy-$points.json"
  tables+=("$out/scipy-$points.json")
done

/usr/bin/python3 "$root/bench/table.py" "${tables[@]}"
