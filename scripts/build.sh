#!/usr/bin/env bash
# Usage: scripts/build.sh [--test | --all | --quick | --bench | --fuzz | --asan] [--help]
# Installs what is missing (scripts/setup.sh), configures and builds: the program alone into build/release; with --test
# the tests too; with --all the tests and the comparison with other solvers; with --quick the program in the shortest
# time, for this processor alone, into build/quick; with --bench the comparison alone into build/bench; with --fuzz the
# fuzzers into build/fuzz; with --asan the unit tests under address and undefined-behaviour sanitizers into build/asan.
# CMAKE_BUILD_PARALLEL_LEVEL=N: number of compilers at once.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"

preset=release
setup=()
options=()
targets=()
case "${1:-}" in
  "") options=(-DBUILD_TESTING=OFF) targets=(ridgeloc_app) ;;
  --test) setup=(--test) options=(-DBUILD_TESTING=ON) ;;
  --all) setup=(--test --bench) options=(-DBUILD_TESTING=ON -DRIDGELOC_BUILD_BENCHMARKS=ON) ;;
  --quick) preset=quick targets=(ridgeloc_app) ;;
  --bench) preset=bench setup=(--bench) ;;
  --fuzz) preset=fuzz setup=(--fuzz) targets=(read_bytes read_values) ;;
  --asan) preset=asan setup=(--test) targets=(unit_tests) ;;
  -h | --help) sed -n '2,8s/^# //p' "${BASH_SOURCE[0]}"; exit 0 ;;
  *) echo "build: unknown option '$1'; allowed: --test, --all, --quick, --bench, --fuzz, --asan, --help" >&2; exit 2 ;;
esac
if (($# > 1)); then
  echo "build: one option at a time; see scripts/build.sh --help" >&2
  exit 2
fi

# Compiling the heaviest files (Ceres, Eigen, CLI11) takes up to 1.5 GiB each.
kib_per_job=$((3 * 1024 * 1024 / 2))

available_kib() {
  local kib limit
  kib="$(awk '$1 == "MemAvailable:" { print $2 }' /proc/meminfo)"
  limit="$(cat /sys/fs/cgroup/memory.max 2>/dev/null || echo max)"
  if [[ "$limit" != max ]] && ((limit / 1024 < kib)); then kib=$((limit / 1024)); fi
  echo "$kib"
}

jobs="$(nproc)"
by_memory=$(($(available_kib) / kib_per_job))
if ((by_memory < jobs)); then jobs=$((by_memory > 0 ? by_memory : 1)); fi
jobs="${CMAKE_BUILD_PARALLEL_LEVEL:-$jobs}"

"$root/scripts/setup.sh" "${setup[@]}"

# Newer compilers bring new warnings: they stop our own checks, not a newcomer's build. Nor the fuzzers, whose compiler
# warns of what is inside the standard library of another, nor sanitizers: between their checks values seem to come from
# nowhere, and where tests are compiled as one a local variable may shadow a constant of another file.
if [[ "${CI:-}" == true && "$preset" != fuzz && "$preset" != asan ]]; then options+=(-DRIDGELOC_WARNINGS_AS_ERRORS=ON); fi
if command -v ccache >/dev/null; then
  options+=(-DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
fi

cd "$root"
echo "build: configuring build/$preset" >&2
cmake --preset "$preset" "${options[@]}"
echo "build: compiling, $jobs at once" >&2
build=(cmake --build "build/$preset" --parallel "$jobs")
if ((${#targets[@]} > 0)); then build+=(--target "${targets[@]}"); fi
"${build[@]}"
