#include "studies/solving/solver_settings.hpp"

#include <algorithm>
#include <array>
#include <functional>

#include "solvers/estimators/formula_compiler.hpp"
#include "solvers/solver.hpp"
#include "studies/study/setting_builders.hpp"

namespace ridgeloc::studies {

namespace {

using solvers::SolverOptions;

/// A setting and where its value goes.
struct Option {
  Setting setting;
  std::function<void(SolverOptions&, const Value&)> assign;
};

/// Pseudoranges alone read it.
const Condition for_pseudoranges{"model", {"pseudorange"}};

const Section solver("solver");

Option number(const char* name, double SolverOptions::*member, Interval bounds, const char* unit,
              const char* description) {
  return {solver.real(name, SolverOptions{}.*member, bounds, unit, description),
          [member](SolverOptions& options, const Value& value) { options.*member = std::get<double>(value); }};
}

Option integer(const char* name, int SolverOptions::*member, Interval bounds, const char* description) {
  return {solver.integer(name, SolverOptions{}.*member, bounds, description),
          [member](SolverOptions& options, const Value& value) {
            options.*member = static_cast<int>(std::get<std::int64_t>(value));
          }};
}

Option one_of(const char* name, const std::vector<std::string>& choices, std::size_t standard, const char* description,
              const std::function<void(SolverOptions&, std::size_t)>& assign) {
  return {solver.choice(name, choices, choices[standard], description),
          [choices, assign](SolverOptions& options, const Value& value) {
            const auto found = std::ranges::find(choices, std::get<std::string>(value));
            assign(options, static_cast<std::size_t>(found - choices.begin()));
          }};
}

/// An enumeration, whose names are listed in the order of its values.
template <class Enum, std::size_t N>
Option choice(const char* name, Enum SolverOptions::*member, const std::array<std::string_view, N>& values,
              const char* description) {
  return one_of(name, {values.begin(), values.end()}, static_cast<std::size_t>(SolverOptions{}.*member), description,
                [member](SolverOptions& options, std::size_t i) { options.*member = static_cast<Enum>(i); });
}

/// An entry of a registry, by index.
template <class Registry>
Option entry(const char* name, std::size_t SolverOptions::*member, const Registry& registry, const char* description) {
  return one_of(name, names_of(registry), SolverOptions{}.*member, description,
                [member](SolverOptions& options, std::size_t i) { options.*member = i; });
}

/// What is wrong with a formula of K, or nothing.
std::string complaint_about_formula(const std::string& text) {
  try {
    solvers::compile_k(text);
    return {};
  } catch (const solvers::FormulaError& error) {
    std::string what = error.what();
    if (error.unknown.empty()) return what;
    const std::string nearest = nearest_name(error.unknown, error.candidates);
    if (!nearest.empty()) return what + " (did you mean \"" + nearest + "\"?)";
    for (std::size_t i = 0; i < error.candidates.size(); ++i)
      what += (i == 0 ? " (allowed: " : ", ") + error.candidates[i];
    return what + ")";
  }
}

/// The formula of k = "expr", which methods choose for themselves.
Option formula(const char* name, const char* description) {
  Setting setting = read_if({"k", {"expr"}}, solver.text(name, "", description));
  setting.complaint = complaint_about_formula;
  return {setting, [](SolverOptions& options, const Value& value) {
            const auto& text = std::get<std::string>(value);
            if (!text.empty()) options.k_formula = solvers::compile_k(text);
          }};
}

Option only_for_pseudoranges(Option option) {
  option.setting = read_if(for_pseudoranges, std::move(option.setting));
  return option;
}

std::vector<Option> make_options() {
  using O = SolverOptions;
  namespace s = solvers;
  return {
      integer("max_iterations", &O::max_iterations, {1, 1e6}, "steps after which a trial has failed"),
      number("step_tolerance_m", &O::step_tolerance_m, {1e-15, 1e3}, "m", "converged when a step is shorter"),
      choice("start", &O::start, s::start_names, "first iterate: the scene's start, or a closed form"),
      choice("score_power", &O::score_power, s::score_power_names,
             "power of scores in weights: as printed, 2 but 1 in rrr's robust weights, or one for all"),
      choice("jacobian", &O::jacobian, s::jacobian_names, "rows of the Jacobian: exact, or eq. 6 as printed"),
      number("sigma_prior_m", &O::sigma_prior_m, {1e-9, 1e6}, "m",
             "range error taken as known, by priors and sigma2_source = prior"),
      only_for_pseudoranges(
          choice("v_mode", &O::v_mode, s::v_mode_names, "image distance: an unknown, known, or known to 0.5 %")),
      only_for_pseudoranges(choice("col_scale", &O::column_scale, s::column_scale_names,
                                   "scale of the unknowns: norms of their columns at the start, or none")),
      only_for_pseudoranges(choice("residual", &O::residual, s::residual_names,
                                   "residual of a pseudorange: in range, or the quotient over 2 r")),
      choice("lm_variant", &O::lm_variant, s::lm_variant_names,
             "damping of lm: after a rejected step, always, or MINPACK's"),
      number("trust_radius_m", &O::trust_radius_m, {1e-6, 1e6}, "m", "longest first step of dogleg, in the unknowns"),
      entry("weight", &O::weight, s::weight_registry(), "robust weight of irls"),
      number("tuning", &O::tuning, {0, 1e6}, "1", "tuning constant of that weight; 0 is its own"),
      choice("scale", &O::scale, s::scale_names, "scale of irls: 1.4826 median |e|, or scale_m"),
      number("scale_m", &O::scale_m, {1e-9, 1e6}, "m", "the constant of scale = fixed"),
      number("theta_m", &O::theta_m, {1e-12, 1e6}, "m", "robust weights of rrr: s / max(theta, |e|)"),
      choice("irls_residual", &O::irls_residual, s::irls_residual_names,
             "residuals in these weights: at the iterate, or after the least-squares step"),
      integer("irls_min_n", &O::irls_min_n, {0, 1000},
              "number of points from which on rrr weighs; 0: more than unknowns"),
      choice("normalize_weights", &O::normalize_weights, s::normalize_weights_names,
             "scale the weights of rrr to a mean of 1"),
      entry("k", &O::k, s::k_estimator_registry(), "estimator of the ridge parameter K"),
      number("k_fixed", &O::k_fixed, {0, 1e12}, "1", "the constant of k = \"fixed\""),
      formula("k_expr", "formula of K"),
      choice("sigma2_source", &O::sigma2_source, s::sigma2_source_names,
             "variance in K: mean square after the least-squares step, linear over n - p, or sigma_prior_m"),
      choice("ridge_coords", &O::ridge_coordinates, s::ridge_coordinates_names,
             "coordinates of K: the unknowns, or eigenvectors of J'WJ"),
      choice("ridge_anchor", &O::ridge_anchor, s::ridge_anchor_names,
             "what the ridge pulls to: the iterate, or the start"),
      choice("ols_mode", &O::ols_mode, s::ols_mode_names, "least squares before K: one step, or to the end"),
      number("similarity", &O::similarity, {1e-6, 1}, "1", "similarity of the oracles' K to the true K"),
      choice("k_error", &O::k_error, s::k_error_names,
             "signs of the error that brings the oracles' K to that similarity"),
      choice("k_error_draw", &O::k_error_draw, s::k_error_draw_names, "how often the direction of that error is drawn"),
      choice("ktrue", &O::k_true, s::k_true_names, "true K that eta refers to: by component, or their geometric mean"),
      choice("eta", &O::eta, s::eta_names,
             "distance in eta: root of the sum of squares, or of the absolute sum as printed"),
  };
}

const std::vector<Option>& all_options() {
  static const std::vector<Option> options = make_options();
  return options;
}

/// What every solver reads.
const std::vector<std::string>& common_solver_settings() {
  static const std::vector<std::string> names = {"max_iterations", "step_tolerance_m", "start",
                                                 "score_power",    "jacobian",         "sigma_prior_m",
                                                 "v_mode",         "col_scale",        "residual"};
  return names;
}

}  // namespace

std::vector<Setting> solver_settings() {
  std::vector<Setting> settings;
  for (const Option& option : all_options()) settings.push_back(per_method(option.setting));
  return settings;
}

std::vector<std::string> solver_names() {
  return names_of(solvers::solver_registry());
}

std::vector<std::string> settings_read_by(std::string_view solver) {
  std::vector<std::string> names = common_solver_settings();
  const auto own = solvers::solver_named(solver).options;
  names.insert(names.end(), own.begin(), own.end());
  return names;
}

solvers::SolverOptions solver_options(const Values& cell, const Values& given) {
  solvers::SolverOptions options;
  for (const Option& option : all_options()) {
    const auto own = given.find(option.setting.name);
    const auto shared = cell.find(option.setting.name);
    if (own != given.end()) {
      option.assign(options, own->second);
    } else if (shared != cell.end()) {
      option.assign(options, shared->second);
    }
  }
  // What is known of the height belongs to the scene, since the start has to have it.
  const auto& height = std::get<std::string>(cell.find("z_mode")->second);
  const auto found = std::ranges::find(solvers::z_mode_names, height);
  options.z_mode = static_cast<solvers::ZMode>(found - solvers::z_mode_names.begin());
  return options;
}

}  // namespace ridgeloc::studies
