#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "results/schema/schema.hpp"
#include "studies/study/experiment.hpp"
#include "studies/study/stop_rule.hpp"
#include "studies/study/value.hpp"

namespace ridgeloc::studies {

/// One swept setting and its values.
struct SweepAxis {
  const Setting* setting = nullptr;
  std::vector<Value> values;
};

/// Two methods, by label, that are compared trial by trial: the first minus the second.
using Comparison = std::array<std::string, 2>;

/// A study, read and validated: nothing in it is missing, unknown or out of range.
struct Study {
  std::string name;  ///< of the file without extension, or of the catalog entry
  std::string title;
  std::string aims;  ///< what the study is to find out, for reports; may be empty
  const Experiment* experiment = nullptr;
  std::uint64_t seed = 2018;
  std::uint64_t trials = 100;        ///< per cell
  double audit = 1e-4;               ///< share of the trials that the reference solves again; 0: none at all
  double trial_columns_mib = 256.0;  ///< largest size of the per-trial columns of all cells together
  Values fixed;                      ///< every setting that is not swept
  std::vector<SweepAxis> sweep;
  std::vector<std::vector<std::string>> zip;  ///< axes that move together instead of being crossed
  std::vector<Values> exclude;                ///< cells with all of these values are left out
  std::vector<Method> methods;
  std::vector<Comparison> comparisons;
  std::vector<results::FigureSpec> figures;
  std::optional<StopRule> stop;  ///< without one every cell gets `trials`
};

/// Bounds of the settings that every study has.
inline constexpr std::uint64_t max_trials = 1'000'000'000'000;
inline constexpr std::size_t max_cells = 1'000'000;
inline constexpr std::size_t max_methods = 1'000;
inline constexpr std::size_t max_exclusions = 1'000;

/// Cells times methods, comparisons among them: each such pair has totals of its own.
inline constexpr std::size_t max_totals = 20'000'000;

}  // namespace ridgeloc::studies
