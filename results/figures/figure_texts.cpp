#include "results/figures/figure_texts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "results/figures/figure_data.hpp"

namespace ridgeloc::results {
namespace {

using Quantity = FigureNames::Quantity;
using Statistic = FigureNames::Statistic;

/// Descriptions that are longer would leave the figure; the name then stands for them.
constexpr std::size_t longest_legend_text = 45;

std::string statistic_text(const Quantity& quantity) {
  switch (quantity.statistic) {
    case Statistic::Mean:
      return "mean";
    case Statistic::Median:
      return "median";
    case Statistic::Quantile:
      return fmt::format("{} % quantile", quantity.percent);
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

bool share_scale(const Quantity& a, const Quantity& b) {
  return a.unit == b.unit && a.statistic == b.statistic;
}

std::string scale_label(const std::vector<Quantity>& quantities) {
  const Quantity& first = quantities.front();
  return quantities.size() == 1 ? quantity_label(first) : with_unit(statistic_text(first), first.unit);
}

std::vector<std::string> quantity_texts(const std::vector<Quantity>& quantities) {
  const bool on_one_scale = std::ranges::all_of(
      quantities, [&](const Quantity& quantity) { return share_scale(quantity, quantities.front()); });
  std::vector<std::string> texts;
  for (const Quantity& quantity : quantities) {
    const bool fits = !quantity.description.empty() && quantity.description.size() <= longest_legend_text;
    texts.push_back(!fits ? quantity.name : on_one_scale ? quantity.description : quantity_label(quantity));
  }
  return texts;
}

std::string description_of(const FigureData& data) {
  std::string text;
  for (const FigureScale& scale : data.scales) text += (text.empty() ? "" : "; ") + scale.label;
  if (data.metrics.size() > 1) text = fmt::format("{} ({})", fmt::join(data.metrics, "; "), text);
  text += fmt::format(" against {}", data.x_label);
  if (data.groups.size() > 1)
    text += fmt::format(", a line for each {}: {}", data.group_title.empty() ? "of" : data.group_title + " of",
                        fmt::join(data.groups, "; "));
  std::vector<std::string> panels;
  for (const FigurePanel& panel : data.panels)
    if (!panel.label.empty() && std::ranges::find(panels, panel.label) == panels.end()) panels.push_back(panel.label);
  if (!panels.empty()) text += fmt::format("; panels: {}", fmt::join(panels, "; "));
  return text;
}

}  // namespace ridgeloc::results
