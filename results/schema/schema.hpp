#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace ridgeloc::results {

/// A value of a swept factor as it stands in files, tables and figures.
using FactorValue = std::variant<std::int64_t, double, std::string>;

/// One axis of the sweep grid.
struct Axis {
  std::string name;
  std::string unit;         ///< "1" where there is none
  std::string description;  ///< long name for tables and figure axes
  std::vector<FactorValue> values;
};

/// What a figure may show of the bounds of a cell's metrics (`MetricInfo::bound`).
enum class BoundKind : std::uint8_t {
  None,           ///< they bound nothing here
  Quantiles,      ///< their mean square is infinite, whatever a sample says
  RootMeanSquare  ///< it is finite, and bounds the mean square of the metric
};

/// One point of the sweep grid.
struct CellInfo {
  std::string hash;                   ///< identity: hash of its factor values
  std::vector<std::size_t> indices;   ///< per axis, the index into `Axis::values`
  BoundKind bound = BoundKind::None;  ///< known beforehand, by the experiment
};

/// One solver with its settings.
struct MethodInfo {
  std::string label;
  std::string hash;         ///< identity: hash of its settings
  std::string description;  ///< the settings as text
  /// Not a solver but the difference of two methods on the same trials, the first minus the second, by their numbers.
  std::optional<std::array<std::size_t, 2>> difference = {};
  /// Not a solver but the ratio of the two methods of this difference. Never stored: `with_ratios` adds it to what has
  /// been read.
  std::optional<std::size_t> ratio = {};
};

/// A real-valued quantity measured per trial and method.
///
/// A NaN value means that the trial is not in the metric's population (an error over converged trials, say);
/// an infinite value that it is, and has no finite value.
struct MetricInfo {
  std::string name;
  std::string unit;
  std::string description;
  bool heavy_tailed = false;   ///< tables and figures lead with the median, not the mean
  bool whole_numbers = false;  ///< values are counts: quantiles are whole numbers too
  bool yes_no = false;         ///< values are 0 or 1: their mean is a rate with Wilson's interval, without quantiles
  /// Not empty: a 1 of this yes-or-no metric means that something is wrong. Footnotes of figures say how often, after
  /// this text.
  std::string alarm = {};
  bool is_compared = false;  ///< differences of methods are taken of it, trial by trial
  /// The metric that bounds the root mean square of this one from below for unbiased estimates, trial by trial, in
  /// the same unit; empty: none.
  std::string bound = {};
  /// Degrees of freedom of the chi-square distribution that the values have if the theory behind them holds; 0: none.
  std::uint64_t chi_square = 0;
};

/// A yes-or-no outcome per trial and method; its rate is reported.
struct EventInfo {
  std::string name;
  std::string description;
  bool is_failure = false;  ///< of a status: the trial has no usable answer
};

/// What an experiment measures. The first events are the statuses, in the order of their codes.
struct Schema {
  std::vector<MetricInfo> metrics;
  std::vector<EventInfo> events;
  std::size_t statuses = 0;  ///< how many of the events are statuses
};

/// Values of axes by the axis' name, as `factor_text` writes them: stands for the cells that have one of these on each
/// of the axes.
using AxisValues = std::map<std::string, std::vector<std::string>>;

/// A figure asked for in the study file, or on the command line.
struct FigureSpec {
  std::string name;  ///< file name without extension
  std::string title;
  std::string kind = "curve";        ///< or "ecdf" or "histogram": how the values of one metric are distributed
  std::string x;                     ///< a sweep axis; of distributions empty
  std::vector<std::string> y;        ///< metrics or events
  std::string statistic;             ///< "mean", "median" or "rms"; empty: the metric's leading one
  std::vector<std::string> group;    ///< axes or "method": one line per combination
  std::string facet;                 ///< axis or "method": one panel per value; empty: one panel
  std::vector<std::string> methods;  ///< restricts to these labels; empty: all that have the metric
  AxisValues where;                  ///< draws these cells alone; empty: all
  bool log_y = false;
  bool bounds = true;  ///< draws the bounds of the metrics too; for curves
};

/// Stands for the instruction set of a result whose blocks were computed with several.
inline constexpr const char* mixed_isa = "mixed";

/// Everything that says what a result is, apart from its numbers.
struct Header {
  std::string title;
  std::string aims;  ///< what the study is to find out; may be empty
  std::string experiment;
  int experiment_version = 0;
  std::string study_hash;
  std::string study_toml;  ///< the fully resolved study, a study file in its own right
  std::uint64_t seed = 0;
  std::uint64_t trials = 0;        ///< per cell
  std::uint64_t block_trials = 0;  ///< trials per block
  std::uint64_t kept_trials = 0;   ///< of each cell, the first: their values are kept one by one
  std::string isa = "baseline";    ///< instruction set that computed the numbers
  Schema schema;
  std::vector<Axis> axes;
  std::vector<CellInfo> cells;
  std::vector<MethodInfo> methods;
  std::vector<FigureSpec> figures;
};

}  // namespace ridgeloc::results
