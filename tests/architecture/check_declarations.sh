#!/usr/bin/env bash
# A solver class that leaves something unsaid does not compile, and the compiler says what is missing.
# Usage: check_declarations.sh SOURCE_DIR CXX
set -euo pipefail
cd "$1"
compiler=$2

complete=$(cat <<'END'
#include "solvers/methods/declaration.hpp"
using namespace ridgeloc::solvers;
struct Method { static constexpr bool has_k = true; };
struct Solver {
  using Variants = std::tuple<Method>;
  static constexpr std::string_view name = "solver";
  static constexpr std::string_view summary = "says all";
  static constexpr std::array<std::string_view, 1> option_names = {"k"};
  static constexpr bool is_least_squares = false;
  static Objective objective(const SolverOptions&) { return Objective::none("a test"); }
};
static_assert(are_declared(std::type_identity<std::tuple<Solver>>{}));
END
)
compile() { "$compiler" -std=c++20 -fsyntax-only -I. -x c++ - 2>&1; }

failures=0
compile <<<"$complete" || { echo "a solver that says all does not compile" >&2; failures=1; }

# refused EDIT MESSAGE: the class changed by a sed command does not compile, and the error has the message.
refused() {
  local output
  if output=$(sed "$1" <<<"$complete" | compile); then
    echo "compiles, but should not: $1" >&2
    failures=$((failures + 1))
  elif ! grep -qF "$2" <<<"$output"; then
    printf '%s: the error lacks "%s":\n%s\n' "$1" "$2" "$output" >&2
    failures=$((failures + 1))
  fi
}
refused '/ objective(/d' 'a solver must say what it minimises'
refused '/ is_least_squares/d' 'a solver must say whether its estimate is the least-squares minimum'
refused '/ summary/d' 'a solver must have'
refused 's/has_k = true/has_k = false/' 'needs a method with `has_k`'

((failures == 0)) || exit 1
echo "solvers must say what they are"
