#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "results/schema/schema.hpp"

namespace ridgeloc::results {

/// What the names in a figure stand for. `method_dimension` stands for "method" among the axes.
struct FigureNames {
  static constexpr std::size_t method_dimension = static_cast<std::size_t>(-1);

  enum class Statistic { Mean, Median, Quantile, RootMeanSquare, Rate, RatioOfMeans };
  enum class Kind { Curve, Ecdf, Histogram };

  struct Quantity {
    std::string name;
    std::string description;
    std::string unit;
    Statistic statistic = Statistic::Mean;  ///< which one is drawn
    unsigned percent = 50;                  ///< which quantile
  };

  Kind kind = Kind::Curve;
  std::optional<std::size_t> x;  ///< axis; none of a distribution
  std::vector<Quantity> y;
  std::vector<std::size_t> group;    ///< axes or `method_dimension`
  std::vector<std::size_t> facet;    ///< none or one axis or `method_dimension`
  std::vector<std::size_t> methods;  ///< drawn methods
  std::vector<bool> is_drawn;        ///< per cell
};

/// What `FigureSpec::statistic` may be: "mean", "median", "rms", or a quantile in percent, "p95".
const std::vector<std::string>& figure_statistics();

/// Throws core::InputError for a name that does not exist (with the nearest ones that do), an unknown kind or
/// statistic, what a distribution cannot have: an x, a statistic, or anything but one metric with other values than
/// yes and no; and for ratios beside other methods or with another statistic than the mean.
FigureNames resolve_figure_names(const Header& header, const FigureSpec& spec);

/// Per cell, whether the figure shows it. Throws core::InputError for an axis or a value that does not exist, and where
/// no cell is left.
std::vector<bool> cells_of_figure(const Header& header, const FigureSpec& spec);

}  // namespace ridgeloc::results
