#pragma once

#include <concepts>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "solvers/objective.hpp"
#include "solvers/options.hpp"

/// What a solver class must say of itself. Nothing here has a default and nothing is looked up by name elsewhere, so
/// that a new solver can be neither audited against the wrong objective nor left unaudited by oversight.
namespace ridgeloc::solvers {

/// `name`, `summary`, and the names of the settings that the solver reads besides the common ones.
template <class Solver>
concept SaysItsName = requires {
  { Solver::name } -> std::convertible_to<std::string_view>;
  { Solver::summary } -> std::convertible_to<std::string_view>;
  { Solver::option_names.size() } -> std::convertible_to<std::size_t>;
};

/// `static Objective objective(const SolverOptions&)`: what the solver minimises with these options, as `adjust` leaves
/// them.
template <class Solver>
concept SaysObjective = requires(const SolverOptions& options) {
  { Solver::objective(options) } -> std::same_as<Objective>;
};

/// `static constexpr bool is_least_squares`: whether a converged estimate is the weighted least-squares minimum, but
/// for where the stop rule ends the way there; then its covariance is that of least squares.
template <class Solver>
concept SaysIfLeastSquares = std::same_as<decltype(Solver::is_least_squares), const bool>;

/// Whether the solver has a ridge parameter: one of its methods does.
template <class... Method>
consteval bool any_has_k(std::type_identity<std::tuple<Method...>>) {
  return (Method::has_k || ...);
}
template <class Solver>
concept HasK = any_has_k(std::type_identity<typename Solver::Variants>{});

template <class Solver>
consteval bool reads_option(std::string_view option) {
  for (const std::string_view name : Solver::option_names) {
    if (name == option) return true;
  }
  return false;
}

/// Does not compile for a class that leaves something unsaid.
template <class Solver>
struct Declared : std::true_type {
  static_assert(SaysItsName<Solver>, "a solver must have `name`, `summary` and `option_names`: docs/extending.md");
  static_assert(SaysObjective<Solver>,
                "a solver must say what it minimises, or that it has no objective and why: "
                "`static Objective objective(const SolverOptions&)`, docs/extending.md");
  static_assert(SaysIfLeastSquares<Solver>,
                "a solver must say whether its estimate is the least-squares minimum: "
                "`static constexpr bool is_least_squares`, docs/extending.md");
  static_assert(HasK<Solver> || !reads_option<Solver>("k"),
                "a solver that reads the setting `k` needs a method with `has_k`: docs/extending.md");
};

template <class... Solver>
consteval bool are_declared(std::type_identity<std::tuple<Solver...>>) {
  return (Declared<Solver>::value && ...);
}

}  // namespace ridgeloc::solvers
