#!/usr/bin/env bash
# Usage: scripts/build.sh [--bench] [--help]    (CMAKE_BUILD_PARALLEL_LEVEL=N: number of compilers at once)
# Configures and builds the release preset into build/release, after scripts/setup.sh; with --bench the preset bench.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"

preset=release
case "${1:-}" in
  "") ;;
  --bench) preset=bench ;;
  -h | --help) sed -n '2,3s/^# //p' "${BASH_SOURCE[0]}"; exit 0 ;;
  *) echo "build: unknown argument '$1'; see scripts/build.sh --help" >&2; exit 2 ;;
esac

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

"$root/scripts/setup.sh" "$@"

options=()
# Newer compilers bring new warnings: they stop our own checks, not a newcomer's build.
if [[ "${CI:-}" == true ]]; then options+=(-DRIDGELOC_WARNINGS_AS_ERRORS=ON); fi
if command -v ccache >/dev/null; then
  options+=(-DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
fi

cd "$root"
echo "build: configuring build/$preset" >&2
cmake --preset "$preset" "${options[@]}"
echo "build: compiling, $jobs at once" >&2
cmake --build "build/$preset" --parallel "$jobs"
