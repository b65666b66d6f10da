#!/usr/bin/env bash
# Who may include whom (docs/architecture.md), which third-party headers may appear where, and that every header
# compiles alone. Usage: check_includes.sh SOURCE_DIR CXX [INCLUDE_FLAG ...]
set -euo pipefail
cd "$1"
compiler=$2
flags=("${@:3}")
failures=0
complain() {
  echo "$1" >&2
  failures=$((failures + 1))
}

declare -A allowed=(
  [core]="core"
  [sim]="core sim"
  [solvers]="core solvers"
  [results]="core results"
  [studies]="core sim solvers results studies"
  [app]="core results studies app"
)
for folder in "${!allowed[@]}"; do
  while IFS=: read -r file line include; do
    target=${include#*\"}
    target=${target%%/*}
    [[ " ${allowed[$folder]} " == *" $target "* ]] || complain "$file:$line: $folder may not include $target"
  done < <(grep -nHoE '^#include "[a-z_]+/' "$folder"/*.cpp "$folder"/*.hpp)
done

# Internal headers, which no other folder includes, may show a third-party library; public ones may not.
internal="results/hdf5_handle.hpp studies/toml_document.hpp studies/sections.hpp"
while IFS=: read -r file line include; do
  [[ " $internal " == *" $file "* ]] || complain "$file:$line: $include in a public header"
done < <(grep -nHE '#include <(hdf5|H5|tbb/|toml|ceres|fmt|openssl|xxhash|CLI|spdlog)' ./*/*.hpp | sed 's|^\./||')
for header in $internal; do
  while IFS=: read -r file line _; do
    [[ ${file%%/*} == "${header%%/*}" ]] || complain "$file:$line: includes $header, which is internal"
  done < <(grep -nH "#include \"$header\"" ./*/*.cpp ./*/*.hpp | sed 's|^\./||')
done

for header in core/*.hpp sim/*.hpp solvers/*.hpp results/*.hpp studies/*.hpp app/*.hpp; do
  echo "#include \"$header\"" | "$compiler" -std=c++20 -fsyntax-only -I. "${flags[@]}" -x c++ - ||
    complain "$header: does not compile alone"
done

((failures == 0)) || exit 1
echo "includes and headers are in order"
