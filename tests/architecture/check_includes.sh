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
# Rooms: subfolders, and which others of the same folder each may include. "root" are the files of the folder itself.
declare -A rooms=(
  [results/util]=""
  [results/schema]=""
  [results/statistics]=""
  [results/hdf5]="util"
  [results/blocks]="schema statistics util"
  [results/pictures]="schema util"
  [results/summary]="blocks schema statistics"
  [results/figures]="pictures summary schema statistics"
  [results/store]="blocks hdf5 summary schema statistics util"
  [results/tables]="blocks summary schema statistics util"
  [results/report]="blocks figures store summary schema statistics util"

  [solvers/root]=""
  [solvers/models]="root"
  [solvers/estimators]="root models"
  [solvers/methods]="root models estimators"
  [solvers/kernels]="root models estimators methods"
  [solvers/coarse]=""
  [solvers/reference]="root"

  [studies/study]=""
  [studies/catalog]=""
  [studies/files]="study catalog"
  [studies/plan]="study files"
  [studies/run]="study plan"
  [studies/solving]="study"
  [studies/ranging]="study solving"
  [studies/photos]="study files solving"
  [studies/building]="study photos solving"
  [studies/detection]="study photos"
  [studies/measured]="study files solving ranging"
  [studies/root]="study catalog files plan run solving ranging photos building detection measured"
)
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

# Sets `room` to that of a file: "results/store", or "results/root" for a file of the folder itself.
find_room() {
  room=${1%/*}
  [[ "$room" == */* ]] || room=$room/root
}

for folder in "${!allowed[@]}"; do
  mapfile -t sources < <(find "$folder" -name '*.cpp' -o -name '*.hpp' -o -name '*.cpp.in' | sort)
  while IFS=: read -r file line include; do
    target=${include#*\"}
    if [[ " ${allowed[$folder]} " != *" ${target%%/*} "* ]]; then
      complain "$file:$line: $folder may not include ${target%%/*}"
      continue
    fi
    [[ "${target%%/*}" == "$folder" ]] || continue
    find_room "$file"
    from=$room
    find_room "$target"
    to=$room
    [[ "$from" == "$to" || " ${rooms[$from]-} " == *" ${to#*/} "* ]] || complain "$file:$line: $from may not include $to"
  done < <(grep -nHoE '^#include "[a-z_]+/[a-z_0-9/]+' "${sources[@]}")
  for room in $(printf '%s\n' "${sources[@]%/*}" | sort -u); do
    [[ "$room" == "$folder" || -v "rooms[$room]" ]] || complain "$room: a room that the order of rooms does not name"
  done
  while IFS=: read -r file line include; do
    library=${include#*<}
    library=${library%%[/.]*}
    [[ " ${libraries[$folder]} " == *" $library "* ]] || complain "$file:$line: $folder may not use $library"
  done < <(grep -nHoE "^#include <($known)[/.]" "${sources[@]}")
done

# The order has no cycle: taking away rooms that include none of those left ends with none.
left=("${!rooms[@]}")
while ((${#left[@]} > 0)); do
  stuck=()
  for room in "${left[@]}"; do
    for other in ${rooms[$room]}; do
      if [[ " ${left[*]} " == *" ${room%%/*}/$other "* ]]; then
        stuck+=("$room")
        break
      fi
    done
  done
  if ((${#stuck[@]} == ${#left[@]})); then
    complain "rooms that include each other in a circle are among: ${stuck[*]}"
    break
  fi
  left=("${stuck[@]}")
done

# Internal headers, which no other folder includes, may show a third-party library; public ones may not.
internal="results/hdf5/hdf5_handle.hpp studies/files/toml_document.hpp studies/files/sections.hpp"
mapfile -t headers < <(find "${!allowed[@]}" -name '*.hpp' | sort)
while IFS=: read -r file line include; do
  [[ " $internal " == *" $file "* ]] || complain "$file:$line: $include in a public header"
done < <(grep -nHE '#include <(hdf5|H5|tbb/|toml|ceres|fmt|openssl|xxhash|CLI|spdlog|benchmark|gsl|cminpack)' "${headers[@]}")
for header in $internal; do
  while IFS=: read -r file line _; do
    [[ ${file%%/*} == "${header%%/*}" ]] || complain "$file:$line: includes $header, which is internal"
  done < <(grep -rnH --include='*.cpp' --include='*.hpp' "#include \"$header\"" "${!allowed[@]}")
done

((failures == 0)) || exit 1
echo "includes are in order"
