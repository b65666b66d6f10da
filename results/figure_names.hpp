#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "results/schema.hpp"

namespace ridgeloc::results {

/// What the names in a figure stand for. `method_dimension` stands for "method" among the axes.
struct FigureNames {
  static constexpr std::size_t method_dimension = static_cast<std::size_t>(-1);

  enum class Statistic { Mean, Median, RootMeanSquare, Rate };

  struct Quantity {
    std::string name;
    std::string description;
    std::string unit;
    Statistic statistic = Statistic::Mean;  ///< which one is drawn
  };

  std::size_t x = 0;  ///< axis
  std::vector<Quantity> y;
  std::vector<std::size_t> group;    ///< axes or `method_dimension`
  std::vector<std::size_t> facet;    ///< none or one axis or `method_dimension`
  std::vector<std::size_t> methods;  ///< drawn methods
};

/// Throws core::InputError for a name that does not exist (with the nearest ones that do) and an unknown
/// statistic.
FigureNames resolve_figure_names(const Header& header, const FigureSpec& spec);

}  // namespace ridgeloc::results
