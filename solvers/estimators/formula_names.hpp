#pragma once
// Internal to solvers: what formulas of K may name.

#include <array>
#include <cstddef>
#include <string_view>

#include "solvers/estimators/formula_compiler.hpp"
#include "solvers/k_formula.hpp"

namespace ridgeloc::solvers {

/// In the order of KOperation, from Sigma2 on; the last four are by component.
inline constexpr std::array<FormulaName, 10> formula_quantity_table = {{
    {"sigma2", "variance of a residual of weight 1, as sigma2_source says"},
    {"n", "number of observations"},
    {"p", "number of unknowns"},
    {"iteration", "steps taken before this one: 0, 1, ..."},
    {"trace", "trace of J'WJ, the sum of its eigenvalues"},
    {"squares", "e'We at the iterate"},
    {"alpha", "by component: the least-squares step dx_ls, 1e-9 m long at least"},
    {"gradient", "by component: J'We"},
    {"diagonal", "by component: the diagonal of J'WJ"},
    {"eigenvalues", "by component: those of J'WJ; K is in canonical coordinates then, and so are all quantities"},
}};
inline constexpr std::size_t first_formula_vector = 6;

/// How a function is called.
enum class FormulaTakes { One, TwoOrMore, Components, ComponentsOrMore };

struct FormulaFunction {
  FormulaName shown;
  std::string_view name;
  FormulaTakes takes;
  KOperation operation;           ///< of one value, of two, or of components
  KOperation of_two = operation;  ///< of ComponentsOrMore, where there are two values or more
};

inline constexpr std::array<FormulaFunction, 10> formula_function_table = {{
    {{"sqrt(x)", "square root"}, "sqrt", FormulaTakes::One, KOperation::Sqrt},
    {{"log(x)", "natural logarithm"}, "log", FormulaTakes::One, KOperation::Log},
    {{"exp(x)", "exponential function"}, "exp", FormulaTakes::One, KOperation::Exp},
    {{"abs(x)", "absolute value"}, "abs", FormulaTakes::One, KOperation::Abs},
    {{"min(x, y, ...)", "the smallest of several values; min(v): of the components of v"},
     "min",
     FormulaTakes::ComponentsOrMore,
     KOperation::Smallest,
     KOperation::Min},
    {{"max(x, y, ...)", "the largest of several values; max(v): of the components of v"},
     "max",
     FormulaTakes::ComponentsOrMore,
     KOperation::Largest,
     KOperation::Max},
    {{"sum(v)", "sum of the components"}, "sum", FormulaTakes::Components, KOperation::Sum},
    {{"mean(v)", "their arithmetic mean"}, "mean", FormulaTakes::Components, KOperation::Mean},
    {{"geomean(v)", "their geometric mean"}, "geomean", FormulaTakes::Components, KOperation::GeometricMean},
    {{"median(v)", "their median, of an even number the mean of the middle two"},
     "median",
     FormulaTakes::Components,
     KOperation::Median},
}};

}  // namespace ridgeloc::solvers
