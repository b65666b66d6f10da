// Any text as a formula of K: what compiles has a value for whatever a trial may bring.

#include <limits>

#include "solvers/estimators/formula_compiler.hpp"
#include "solvers/estimators/formula_value.hpp"
#include "tests/fuzz/refused.hpp"

using namespace ridgeloc;
using namespace ridgeloc::solvers;

namespace {

/// Keeps the compiler from leaving a value out.
volatile double seen;

template <std::size_t P>
void evaluate(const KFormula& formula, double quantity) {
  const SolverOptions options;
  const auto all = every<P>(quantity);
  KContext<double, P> context{{}, all, quantity, quantity, all, all, all, quantity, P, nullptr, options};
  for (const double value : formula_value<double, P>(formula, context, {all, all})) seen = value;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  KFormula formula;
  const std::string text = tests::text_of(data, size);
  try {
    formula = compile_k(text);
  } catch (const FormulaError&) {
    return 0;
  }
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double quantity : {0.0, 1.5, -1e300, infinity, std::numeric_limits<double>::quiet_NaN()}) {
    evaluate<2>(formula, quantity);
    evaluate<4>(formula, quantity);
  }
  return 0;
}
