#!/usr/bin/env bash
# Every header compiles alone. Usage: check_headers.sh SOURCE_DIR CXX [INCLUDE_FLAG ...]
set -euo pipefail
cd "$1"
compiler=$2
flags=("${@:3}")

compiles_alone() {
  echo "#include \"$1\"" | "${@:2}" -std=c++20 -fsyntax-only -I. -x c++ - || echo "$1: does not compile alone" >&2
}
export -f compiles_alone
complaints=$(find core sim solvers results studies app bench -name '*.hpp' |
  xargs -P "$(nproc)" -I{} bash -c 'compiles_alone "$@"' _ {} "$compiler" "${flags[@]}" 2>&1)
if [[ -n "$complaints" ]]; then
  echo "$complaints" >&2
  exit 1
fi
echo "every header compiles alone"
