#include "tests/support/all_methods.hpp"

#include "solvers/estimators/formula_compiler.hpp"

namespace ridgeloc::tests {

namespace {

using solvers::SolverOptions;

SolverOptions basic_options() {
  SolverOptions options;
  options.k_fixed = 0.2;
  options.similarity = 0.8;
  options.k_formula = solvers::compile_k("geomean(sigma2 / alpha^2)");
  return options;
}

class List {
 public:
  std::vector<MethodChoice> choices;

  template <class F>
  void add(const char* solver, const std::string& name, F change) {
    SolverOptions options = basic_options();
    change(options);
    choices.push_back({&solvers::solver_named(solver), options, solver + (" " + name)});
  }
};

void add_ridge(List& list, const char* solver) {
  const auto estimators = solvers::k_estimator_registry();
  for (std::size_t k = 0; k < estimators.size(); ++k) {
    if (!estimators[k].needs_ols_step) continue;
    list.add(solver, "canonical " + std::string(estimators[k].name), [k](SolverOptions& o) {
      o.k = k;
      o.ridge_coordinates = solvers::RidgeCoordinates::Canonical;
    });
  }
  // Together they have every quantity and every function.
  for (const char* text :
       {"0.3 * 0.5 ^ iteration * n / p", "min(sigma2 / alpha^2, 1e3) + 1e-3 * abs(gradient) * exp(-diagonal)",
        "median(eigenvalues) * mean(alpha^2) / max(eigenvalues * alpha^-2) + squares^0.7 * log(n)",
        "-max(sqrt(sigma2), 1e-3) * sum(alpha^3) / trace", "geomean(diagonal) * min(gradient^2)"}) {
    list.add(solver, text, [text](SolverOptions& o) {
      o.k = *solvers::find_k_estimator("expr");
      o.k_formula = solvers::compile_k(text);
    });
  }
  list.add(solver, "dof", [](SolverOptions& o) { o.sigma2_source = solvers::Sigma2Source::Dof; });
  list.add(solver, "prior sigma", [](SolverOptions& o) { o.sigma2_source = solvers::Sigma2Source::Prior; });
  list.add(solver, "anchor", [](SolverOptions& o) { o.ridge_anchor = solvers::RidgeAnchor::Prior; });
  list.add(solver, "full", [](SolverOptions& o) { o.ols_mode = solvers::OlsMode::Full; });
  list.add(solver, "all of these", [](SolverOptions& o) {
    o.k = *solvers::find_k_estimator("hk");
    o.ridge_coordinates = solvers::RidgeCoordinates::Canonical;
    o.sigma2_source = solvers::Sigma2Source::Dof;
    o.ridge_anchor = solvers::RidgeAnchor::Prior;
    o.ols_mode = solvers::OlsMode::Full;
    o.irls_residual = solvers::IrlsResidual::Ols;
    o.normalize_weights = solvers::NormalizeWeights::On;
    o.start = solvers::Start::Bancroft;
    o.eta = solvers::Eta::Absolute;
  });
}

}  // namespace

std::vector<MethodChoice> methods_by_k() {
  List list;
  for (const auto& entry : solvers::solver_registry()) {
    const auto estimators = solvers::k_estimator_registry();
    for (std::size_t k = 0; k < (entry.has_k ? estimators.size() : 1); ++k) {
      list.add(entry.name.data(), entry.has_k ? std::string(estimators[k].name) : "", [k](SolverOptions& o) {
        o.k = k;
        o.k_true = k % 2 == 0 ? solvers::KTrue::Elem : solvers::KTrue::Gm;
      });
    }
  }
  return list.choices;
}

std::vector<MethodChoice> methods_by_option() {
  List list;
  for (const char* solver : {"ols", "lm", "dogleg", "rr", "rrr", "irls"}) {
    list.add(solver, "from linear", [](SolverOptions& o) { o.start = solvers::Start::Linear; });
    list.add(solver, "from bancroft", [](SolverOptions& o) { o.start = solvers::Start::Bancroft; });
    list.add(solver, "score", [](SolverOptions& o) { o.score_power = solvers::ScorePower::One; });
    list.add(solver, "squared score", [](SolverOptions& o) { o.score_power = solvers::ScorePower::Two; });
  }
  list.add("ols", "printed", [](SolverOptions& o) { o.jacobian = solvers::Jacobian::Printed; });
  list.add("lm", "marquardt", [](SolverOptions& o) { o.lm_variant = solvers::LmVariant::Marquardt; });
  list.add("lm", "more", [](SolverOptions& o) { o.lm_variant = solvers::LmVariant::More; });
  list.add("dogleg", "half a metre", [](SolverOptions& o) { o.trust_radius_m = 0.5; });
  for (std::size_t weight = 0; weight < solvers::weight_registry().size(); ++weight) {
    list.add("irls", std::string(solvers::weight_registry()[weight].name),
             [weight](SolverOptions& o) { o.weight = weight; });
  }
  list.add("irls", "fixed", [](SolverOptions& o) { o.scale = solvers::Scale::Fixed; });
  list.add("irls", "tuned", [](SolverOptions& o) { o.tuning = 0.7; });
  add_ridge(list, "rr");
  add_ridge(list, "rrr");
  list.add("rrr", "ols residual", [](SolverOptions& o) { o.irls_residual = solvers::IrlsResidual::Ols; });
  list.add("rrr", "min n", [](SolverOptions& o) { o.irls_min_n = 6; });
  list.add("rrr", "normalized", [](SolverOptions& o) { o.normalize_weights = solvers::NormalizeWeights::On; });
  list.add("rr", "positive error", [](SolverOptions& o) {
    o.k = *solvers::find_k_estimator("oracle_elem");
    o.k_error = solvers::KError::Positive;
    o.k_error_draw = solvers::KErrorDraw::PerTrial;
    o.eta = solvers::Eta::Absolute;
  });
  return list.choices;
}

std::vector<ModelChoice> pseudorange_models() {
  std::vector<ModelChoice> models;
  const ModelChoice usual{solvers::ZMode::Free, solvers::VMode::Free, solvers::ColumnScale::Norms,
                          solvers::Residual::Range, solvers::Jacobian::Exact};
  for (const auto z_mode : {solvers::ZMode::Free, solvers::ZMode::Fixed}) {
    for (const auto v_mode : {solvers::VMode::Free, solvers::VMode::Fixed, solvers::VMode::Prior}) {
      models.push_back(usual);
      models.back().z_mode = z_mode;
      models.back().v_mode = v_mode;
    }
  }
  models.push_back(usual);
  models.back().column_scale = solvers::ColumnScale::None;
  models.push_back(usual);
  models.back().residual = solvers::Residual::Quotient;
  models.push_back(usual);
  models.back().jacobian = solvers::Jacobian::Printed;
  return models;
}

void apply(const ModelChoice& model, solvers::SolverOptions& options) {
  options.z_mode = model.z_mode;
  options.v_mode = model.v_mode;
  options.column_scale = model.column_scale;
  options.residual = model.residual;
  options.jacobian = model.jacobian;
}

std::string name_of(const ModelChoice& model) {
  return "z " + std::string(solvers::z_mode_names[static_cast<std::size_t>(model.z_mode)]) + ", v " +
         std::string(solvers::v_mode_names[static_cast<std::size_t>(model.v_mode)]) + ", scale " +
         std::string(solvers::column_scale_names[static_cast<std::size_t>(model.column_scale)]) + ", residual " +
         std::string(solvers::residual_names[static_cast<std::size_t>(model.residual)]) + ", jacobian " +
         std::string(solvers::jacobian_names[static_cast<std::size_t>(model.jacobian)]);
}

}  // namespace ridgeloc::tests
