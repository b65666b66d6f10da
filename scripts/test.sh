#!/usr/bin/env bash
# Usage: scripts/test.sh [OPTION OF ctest]...    for example: scripts/test.sh -R solvers
# Installs what is missing, builds, and runs all tests of the release preset; the exit code is that of ctest. The tests
# need more than the program does: R and Python with their readers of results, some 600 MB.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"

if [[ "${1:-}" == -h || "${1:-}" == --help ]]; then
  sed -n '2,4s/^# //p' "${BASH_SOURCE[0]}"
  exit 0
fi

"$root/scripts/build.sh" --test

cd "$root"
export CTEST_PARALLEL_LEVEL="${CTEST_PARALLEL_LEVEL:-$(nproc)}"
exec ctest --preset release --no-tests=error "$@"
