#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "solvers/estimators/k_registry.hpp"
#include "solvers/kernels/kernels.hpp"
#include "solvers/solver.hpp"

namespace ridgeloc::solvers {

namespace {

/// The kernels of an instruction set, none where the processor lacks it: even the function that lists them is compiled
/// for that instruction set. The baseline is served by the double path where it has none of its own.
template <core::Isa isa>
Kernels kernels_of_program() {
  if constexpr (core::has_kernels(isa)) {
    return core::is_supported(isa) ? kernels<isa>() : Kernels{};
  } else if constexpr (isa == core::Isa::Baseline) {
    return kernels_over<double>();
  } else {
    return Kernels{};
  }
}

/// In the order of core::Isa.
const std::array<Kernels, core::isa_count>& kernels_by_isa() {
  static const std::array<Kernels, core::isa_count> by_isa = {kernels_of_program<core::Isa::Baseline>(),
                                                              kernels_of_program<core::Isa::Avx2>(),
                                                              kernels_of_program<core::Isa::Avx512>()};
  return by_isa;
}

template <std::size_t I>
SolverEntry make_entry() {
  using Class = std::tuple_element_t<I, Methods>;
  const auto& by_isa = kernels_by_isa();
  return {.name = Class::name,
          .summary = Class::summary,
          .options = Class::option_names,
          .has_k = HasK<Class>,
          .is_least_squares = Class::is_least_squares,
          .adjust = Class::adjust,
          .objective = Class::objective,
          .solve = solve<double, I>,
          .kernels = {by_isa[0].solvers[I], by_isa[1].solvers[I], by_isa[2].solvers[I]}};
}

template <std::size_t... I>
std::array<SolverEntry, sizeof...(I)> make_registry(std::index_sequence<I...>) {
  return {make_entry<I>()...};
}

}  // namespace

std::span<const SolverEntry> solver_registry() {
  static const auto registry = make_registry(std::make_index_sequence<std::tuple_size_v<Methods>>{});
  return registry;
}

GeometryKernel geometry_kernel(core::Isa isa) {
  return kernels_by_isa()[static_cast<std::size_t>(isa)].geometry;
}

const SolverEntry* find_solver(std::string_view name) {
  const auto registry = solver_registry();
  const auto found = std::ranges::find(registry, name, &SolverEntry::name);
  return found == registry.end() ? nullptr : &*found;
}

const SolverEntry& solver_named(std::string_view name) {
  const SolverEntry* const entry = find_solver(name);
  if (entry != nullptr) return *entry;
  std::string known;
  for (const SolverEntry& other : solver_registry()) {
    known += known.empty() ? "" : ", ";
    known += other.name;
  }
  throw core::InputError("there is no solver \"" + std::string(name) + "\"; one of: " + known);
}

std::span<const KEstimatorEntry> k_estimator_registry() {
  static constexpr auto registry = []<std::size_t... I>(std::index_sequence<I...>) {
    return std::array{KEstimatorEntry{
        std::tuple_element_t<I, KEstimators>::name, std::tuple_element_t<I, KEstimators>::summary,
        std::tuple_element_t<I, KEstimators>::needs_ols_step, std::tuple_element_t<I, KEstimators>::needs_oracle}...};
  }
  (std::make_index_sequence<std::tuple_size_v<KEstimators>>{});
  return registry;
}

std::span<const WeightEntry> weight_registry() {
  static constexpr auto registry = []<std::size_t... I>(std::index_sequence<I...>) {
    return std::array{
        WeightEntry{std::tuple_element_t<I, RobustWeights>::name, std::tuple_element_t<I, RobustWeights>::summary}...};
  }
  (std::make_index_sequence<std::tuple_size_v<RobustWeights>>{});
  return registry;
}

std::optional<std::size_t> find_k_estimator(std::string_view name) {
  const auto registry = k_estimator_registry();
  const auto found = std::ranges::find(registry, name, &KEstimatorEntry::name);
  if (found == registry.end()) return std::nullopt;
  return static_cast<std::size_t>(found - registry.begin());
}

}  // namespace ridgeloc::solvers
