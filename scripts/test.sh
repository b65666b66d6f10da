#!/usr/bin/env bash
# Usage: scripts/test.sh [OPTION OF ctest]...    for example: scripts/test.sh -R solvers
# Sets up, builds and runs all tests of the release preset; the exit code is that of ctest.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"

if [[ "${1:-}" == -h || "${1:-}" == --help ]]; then
  sed -n '2,3s/^# //p' "${BASH_SOURCE[0]}"
  exit 0
fi

"$root/scripts/build.sh"

cd "$root"
export CTEST_PARALLEL_LEVEL="${CTEST_PARALLEL_LEVEL:-$(nproc)}"
exec ctest --preset release --no-tests=error "$@"
