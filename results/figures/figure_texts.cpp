#include "results/figures/figure_texts.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace ridgeloc::results {
namespace {

using Quantity = FigureNames::Quantity;
using Statistic = FigureNames::Statistic;

/// Descriptions that are longer would leave the figure; the name then stands for them.
constexpr std::size_t longest_legend_text = 45;

const char* statistic_text(const Quantity& quantity) {
  switch (quantity.statistic) {
    case Statistic::Mean:
      return "mean";
    case Statistic::Median:
      return "median";
    case Statistic::RootMeanSquare:
      return "root mean square";
    case Statistic::Rate:
      return "rate";
    case Statistic::RatioOfMeans:
      return "ratio of the means";
  }
  return "";
}

std::string quantity_label(const Quantity& quantity) {
  return with_unit(fmt::format("{}, {}", description_of(quantity), statistic_text(quantity)), quantity.unit);
}

/// Whether one label fits all.
bool are_alike(const std::vector<Quantity>& quantities) {
  return std::ranges::all_of(quantities, [&](const Quantity& quantity) {
    return quantity.unit == quantities.front().unit && quantity.statistic == quantities.front().statistic;
  });
}

}  // namespace

std::string with_unit(const std::string& text, const std::string& unit) {
  return unit == "1" || unit.empty() ? text : fmt::format("{} [{}]", text, unit);
}

std::string axis_label(const Axis& axis) {
  return with_unit(axis.description.empty() ? axis.name : axis.description, axis.unit);
}

const std::string& description_of(const Quantity& quantity) {
  return quantity.description.empty() ? quantity.name : quantity.description;
}

std::string quantities_label(const std::vector<Quantity>& quantities) {
  const Quantity& first = quantities.front();
  if (quantities.size() == 1) return quantity_label(first);
  return are_alike(quantities) ? with_unit(statistic_text(first), first.unit) : "";
}

std::vector<std::string> quantity_texts(const std::vector<Quantity>& quantities) {
  if (quantities.size() == 1) return {""};
  std::vector<std::string> texts;
  for (const Quantity& quantity : quantities) {
    const bool fits = !quantity.description.empty() && quantity.description.size() <= longest_legend_text;
    texts.push_back(!fits ? quantity.name : are_alike(quantities) ? quantity.description : quantity_label(quantity));
  }
  return texts;
}

}  // namespace ridgeloc::results
