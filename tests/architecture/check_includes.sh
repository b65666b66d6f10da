#!/usr/bin/env bash
# Who may include whom (docs/architecture.md), and which third-party headers may appear where.
# Usage: check_includes.sh SOURCE_DIR
set -euo pipefail
cd "$1"
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
  [bench]="core sim solvers studies results bench"
)
for folder in "${!allowed[@]}"; do
  while IFS=: read -r file line include; do
    target=${include#*\"}
    target=${target%%/*}
    [[ " ${allowed[$folder]} " == *" $target "* ]] || complain "$file:$line: $folder may not include $target"
  done < <(grep -nHoE '^#include "[a-z_]+/' "$folder"/*.cpp "$folder"/*.hpp)
done

# Third-party libraries that a folder may use at all; what is not named here is the standard library or the system.
declare -A libraries=(
  [core]="xsimd"
  [sim]=""
  [solvers]="ceres Eigen"
  [results]="hdf5 openssl xxhash fmt"
  [studies]="toml++ tbb fmt"
  [app]="CLI fmt"
  [bench]="benchmark ceres Eigen unsupported gsl cminpack"
)
known='Random123|Eigen|xsimd|ceres|hdf5|H5[A-Za-z]*|openssl|xxhash|fmt|toml\+\+|tbb|CLI|spdlog|catch2'
known+='|benchmark|unsupported|gsl|cminpack'
for folder in "${!libraries[@]}"; do
  while IFS=: read -r file line include; do
    library=${include#*<}
    library=${library%%[/.]*}
    [[ " ${libraries[$folder]} " == *" $library "* ]] || complain "$file:$line: $folder may not use $library"
  done < <(grep -nHoE "^#include <($known)[/.]" "$folder"/*.cpp "$folder"/*.hpp)
done

# Internal headers, which no other folder includes, may show a third-party library; public ones may not.
internal="results/hdf5_handle.hpp studies/toml_document.hpp studies/sections.hpp"
while IFS=: read -r file line include; do
  [[ " $internal " == *" $file "* ]] || complain "$file:$line: $include in a public header"
done < <(grep -nHE '#include <(hdf5|H5|tbb/|toml|ceres|fmt|openssl|xxhash|CLI|spdlog|benchmark|gsl|cminpack)' ./*/*.hpp | sed 's|^\./||')
for header in $internal; do
  while IFS=: read -r file line _; do
    [[ ${file%%/*} == "${header%%/*}" ]] || complain "$file:$line: includes $header, which is internal"
  done < <(grep -nH "#include \"$header\"" ./*/*.cpp ./*/*.hpp | sed 's|^\./||')
done

((failures == 0)) || exit 1
echo "includes are in order"
