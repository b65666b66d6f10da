#pragma once

#include <string_view>

#include "core/symmetric_eigen.hpp"
#include "solvers/estimators/formula_value.hpp"
#include "solvers/estimators/k_context.hpp"

namespace ridgeloc::solvers {

/// K by a formula of the user's, options.k_formula: by component or one number, in the coordinates that the options
/// say, in canonical ones always if it names eigenvalues. What it asks for, the formula knows.
struct KByFormula : KDefaults {
  static constexpr std::string_view name = "expr";
  static constexpr std::string_view summary = "a formula of your own, given by k_expr";

  /// `Real` only keeps apart what is compiled for different instruction sets.
  template <class Real>
  static KTraits traits(const SolverOptions& options) {
    const KFormula& formula = options.k_formula;
    return {formula.needs_ols_step, formula.needs_squares, formula.needs_eigenvalues,
            !formula.instructions[formula.result].by_component};
  }

  /// In the coordinates of the unknowns.
  template <class Real, std::size_t P>
  core::Vector<Real, P> operator()(const KContext<Real, P>& c) const {
    const FormulaInputs<Real, P> inputs{c.least_squares.gradient, core::diagonal(c.least_squares.matrix)};
    return formula_value(c.options.k_formula, c, inputs);
  }

  /// Along the eigenvectors of J'WJ.
  template <class Real, std::size_t P>
  core::Vector<Real, P> operator()(const KContext<Real, P>& c, const core::SymmetricEigen<Real, P>& eigen) const {
    const FormulaInputs<Real, P> inputs{
        core::make_vector<P>([&](auto i) { return core::dot(eigen.vectors[i], c.least_squares.gradient); }),
        eigen.values};
    return formula_value(c.options.k_formula, c, inputs);
  }
};

}  // namespace ridgeloc::solvers
