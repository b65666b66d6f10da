#!/usr/bin/env bash
# That check_includes.sh refuses what it is for: plants forbidden includes in a copy of the sources, one at a time.
# The same for check_names.sh. Usage: check_refusals.sh SOURCE_DIR
set -euo pipefail
source_dir=$1
check=$source_dir/tests/architecture/check_includes.sh
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
(cd "$source_dir" && find core sim solvers results studies app bench -name '*.[ch]pp' -o -name '*.cpp.in' |
  xargs cp --parents --target-directory="$copy")
failures=0

# refuses FILE INCLUDE MESSAGE: the include, planted at the end of the file, is refused with these words.
refuses() {
  cp "$copy/$1" "$copy/original"
  printf '#include %s\n' "$2" >>"$copy/$1"
  if said=$("$check" "$copy" 2>&1); then
    echo "$1 with #include $2 passes" >&2
    failures=$((failures + 1))
  elif [[ "$said" != *"$3"* ]]; then
    echo "$1 with #include $2: \"$3\" is not said but: $said" >&2
    failures=$((failures + 1))
  fi
  mv "$copy/original" "$copy/$1"
}

"$check" "$copy" >/dev/null
refuses results/tables/csv.cpp '"solvers/solver.hpp"' 'results may not include solvers'
refuses results/tables/csv.cpp '"results/report/report.hpp"' 'results/tables may not include results/report'
refuses studies/study/value.hpp '"studies/run/runner.hpp"' 'studies/study may not include studies/run'
refuses solvers/models/models.hpp '"solvers/methods/ols.hpp"' 'solvers/models may not include solvers/methods'
refuses solvers/reference/reference_loss.hpp '"solvers/models/weight.hpp"' 'solvers/reference may not include solvers/models'
refuses results/tables/csv.hpp '<fmt/format.h>' 'in a public header'
refuses results/tables/csv.cpp '<tbb/parallel_for.h>' 'results may not use tbb'
refuses app/run.cpp '"results/hdf5/hdf5_handle.hpp"' 'which is internal'
mkdir "$copy/results/attic"
cp "$copy/results/util/json.hpp" "$copy/results/attic/json.hpp"
refuses results/util/json.hpp '<string>' 'results/attic: a room that the order of rooms does not name'

# An order of rooms that goes in a circle is refused too.
rm -r "$copy/results/attic"
sed 's|^  \[results/util\]=""$|  [results/util]="tables"|' "$check" >"$copy/circle.sh"
if cmp -s "$check" "$copy/circle.sh"; then
  echo "the order of rooms is no longer written as this test expects" >&2
  failures=$((failures + 1))
elif said=$(bash "$copy/circle.sh" "$copy" 2>&1) || [[ "$said" != *circle* ]]; then
  echo "a circle of rooms passes: $said" >&2
  failures=$((failures + 1))
fi

# So is a name that two anonymous namespaces of a room have, as a function, a type or a constant.
names=$source_dir/tests/architecture/check_names.sh
"$names" "$copy"
for planted in 'int twice(int x) {' 'std::vector<int> twice(double) {' 'struct twice {' 'constexpr int twice = 2;'; do
  for file in results/tables/csv.cpp results/tables/table.cpp; do
    cp "$copy/$file" "$copy/original-${file##*/}"
    printf 'namespace {\n%s\n}  // namespace\n' "$planted" >>"$copy/$file"
  done
  if said=$("$names" "$copy" 2>&1) || [[ "$said" != *"results/tables twice: csv.cpp table.cpp"* ]]; then
    echo "a name that a room has twice passes: $planted: $said" >&2
    failures=$((failures + 1))
  fi
  for file in results/tables/csv.cpp results/tables/table.cpp; do mv "$copy/original-${file##*/}" "$copy/$file"; done
done

((failures == 0)) || exit 1
echo "what is forbidden is refused"
