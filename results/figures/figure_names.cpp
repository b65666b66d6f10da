#include "results/figures/figure_names.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "core/edit_distance.hpp"
#include "core/error.hpp"
#include "results/schema/axis_values.hpp"
#include "results/schema/text.hpp"

namespace ridgeloc::results {
namespace {

const std::string method_name = "method";

/// Index of `name` among the valid names, or an error that lists the nearest ones first.
std::size_t find_name(const FigureSpec& spec, std::string_view key, std::string_view name,
                      const std::vector<std::string>& valid) {
  const auto found = std::find(valid.begin(), valid.end(), name);
  if (found != valid.end()) return static_cast<std::size_t>(found - valid.begin());
  if (valid.empty())
    throw core::InputError(fmt::format("figure '{}': {} = \"{}\": this study has none", spec.name, key, name));
  std::vector<std::string> nearest = valid;
  std::stable_sort(nearest.begin(), nearest.end(), [&](const std::string& a, const std::string& b) {
    return core::edit_distance(name, a) < core::edit_distance(name, b);
  });
  constexpr std::size_t listed = 6;
  const bool all = nearest.size() <= listed;
  if (!all) nearest.resize(listed);
  throw core::InputError(fmt::format("figure '{}': {} = \"{}\" is unknown; {}: {}", spec.name, key, name,
                                     all ? "valid names" : "nearest valid names", fmt::join(nearest, ", ")));
}

std::vector<std::string> axis_names(const Header& header) {
  std::vector<std::string> names;
  for (const Axis& axis : header.axes) names.push_back(axis.name);
  return names;
}

std::size_t find_dimension(const Header& header, const FigureSpec& spec, std::string_view key,
                           const std::string& name) {
  std::vector<std::string> names = axis_names(header);
  names.push_back(method_name);
  const std::size_t index = find_name(spec, key, name, names);
  return index == header.axes.size() ? FigureNames::method_dimension : index;
}

void choose_statistic(const FigureSpec& spec, const MetricInfo& metric, FigureNames::Quantity& quantity) {
  using enum FigureNames::Statistic;
  const std::string& name = spec.statistic;
  if (metric.yes_no) {
    quantity.statistic = Rate;
  } else if (name.empty()) {
    quantity.statistic = metric.heavy_tailed ? Median : Mean;
  } else if (name.front() == 'p') {
    quantity.statistic = Quantile;
    std::from_chars(name.data() + 1, name.data() + name.size(), quantity.percent);
  } else {
    quantity.statistic = name == "median" ? Median : name == "rms" ? RootMeanSquare : Mean;
  }
}

FigureNames::Quantity find_quantity(const Header& header, const FigureSpec& spec, const std::string& name) {
  const Schema& schema = header.schema;
  std::vector<std::string> names;
  for (const MetricInfo& metric : schema.metrics) names.push_back(metric.name);
  for (const EventInfo& event : schema.events) names.push_back(event.name);
  const std::size_t index = find_name(spec, "y", name, names);
  if (index >= schema.metrics.size()) {
    const EventInfo& event = schema.events[index - schema.metrics.size()];
    return {event.name, event.description, "1", FigureNames::Statistic::Rate};
  }
  const MetricInfo& metric = schema.metrics[index];
  FigureNames::Quantity quantity{metric.name, metric.description, metric.unit};
  choose_statistic(spec, metric, quantity);
  return quantity;
}

/// In the order of `FigureNames::Kind`.
const std::vector<std::string> figure_kinds = {"curve", "ecdf", "histogram"};

void check_distribution(const FigureSpec& spec, const FigureNames& names) {
  const auto refuse = [&](const std::string& reason) {
    throw core::InputError(fmt::format("figure '{}': kind = \"{}\" {}", spec.name, spec.kind, reason));
  };
  if (!spec.x.empty()) refuse("takes no x, which is the metric itself");
  if (!spec.statistic.empty()) refuse("takes no statistic");
  if (spec.y.size() > 1) refuse("shows one metric; y names several");
  if (names.y.front().statistic == FigureNames::Statistic::Rate)
    refuse(fmt::format("shows metrics; \"{}\" is yes or no, draw its rate as a curve", spec.y.front()));
}

/// Differences have no quantiles, since histograms do not resolve negative values, and ratios are of means.
void adapt_statistics(const Header& header, const FigureSpec& spec, FigureNames& names) {
  const auto all = [&](auto is) {
    return std::ranges::all_of(names.methods, [&](std::size_t m) { return is(header.methods[m]); });
  };
  const auto is_ratio = [](const MethodInfo& method) { return method.ratio.has_value(); };
  const bool none_is_ratio = all([&](const MethodInfo& method) { return !is_ratio(method); });
  if (none_is_ratio) {
    if (!spec.statistic.empty() || !all([](const MethodInfo& method) { return method.difference.has_value(); })) return;
    for (FigureNames::Quantity& quantity : names.y)
      if (quantity.statistic == FigureNames::Statistic::Median) quantity.statistic = FigureNames::Statistic::Mean;
    return;
  }
  const auto refuse = [&](const char* reason) {
    throw core::InputError(fmt::format("figure '{}': {}", spec.name, reason));
  };
  if (!all(is_ratio))
    refuse("methods: a ratio has no unit and stands beside ratios only; draw it in a figure of its own");
  if (names.kind != FigureNames::Kind::Curve)
    refuse("methods: a ratio of means has no distribution; use kind = \"curve\"");
  if (!spec.statistic.empty() && spec.statistic != "mean") refuse("statistic: ratios are those of means; remove it");
  for (FigureNames::Quantity& quantity : names.y) {
    quantity.statistic = FigureNames::Statistic::RatioOfMeans;
    quantity.unit.clear();
  }
}

/// Per value of an axis, whether one of the texts writes it.
std::vector<bool> chosen_values(const FigureSpec& spec, const Axis& axis, const std::vector<std::string>& texts) {
  std::vector<bool> chosen(axis.values.size(), false);
  std::vector<std::string> valid;
  for (const FactorValue& value : axis.values) valid.push_back(factor_text(value));
  for (const std::string& text : texts) {
    const auto found =
        std::ranges::find_if(axis.values, [&](const FactorValue& value) { return is_written_as(value, text); });
    const std::size_t index = found != axis.values.end() ? static_cast<std::size_t>(found - axis.values.begin())
                                                         : find_name(spec, "where " + axis.name, text, valid);
    chosen[index] = true;
  }
  return chosen;
}

}  // namespace

const std::vector<std::string>& figure_statistics() {
  static const std::vector<std::string> statistics = {"mean", "median", "rms", "p05", "p10",
                                                      "p25",  "p75",    "p90", "p95", "p99"};
  return statistics;
}

std::vector<bool> cells_of_figure(const Header& header, const FigureSpec& spec) {
  std::vector<bool> is_drawn(header.cells.size(), true);
  for (const auto& [name, texts] : spec.where) {
    const std::size_t axis = find_name(spec, "where", name, axis_names(header));
    const std::vector<bool> chosen = chosen_values(spec, header.axes[axis], texts);
    for (std::size_t cell = 0; cell < is_drawn.size(); ++cell) {
      if (!chosen[header.cells[cell].indices[axis]]) is_drawn[cell] = false;
    }
  }
  if (std::ranges::find(is_drawn, true) == is_drawn.end()) {
    throw core::InputError(fmt::format("figure '{}': no cell has the values of where", spec.name));
  }
  return is_drawn;
}

FigureNames resolve_figure_names(const Header& header, const FigureSpec& spec) {
  if (!spec.statistic.empty()) find_name(spec, "statistic", spec.statistic, figure_statistics());
  if (spec.y.empty()) throw core::InputError(fmt::format("figure '{}': y names no metric", spec.name));
  FigureNames names;
  names.kind = static_cast<FigureNames::Kind>(find_name(spec, "kind", spec.kind, figure_kinds));
  for (const std::string& name : spec.y) names.y.push_back(find_quantity(header, spec, name));
  if (names.kind == FigureNames::Kind::Curve) {
    names.x = find_name(spec, "x", spec.x, axis_names(header));
  } else {
    check_distribution(spec, names);
  }
  for (const std::string& name : spec.group) names.group.push_back(find_dimension(header, spec, "group", name));
  if (!spec.facet.empty()) names.facet.push_back(find_dimension(header, spec, "facet", spec.facet));

  std::vector<std::string> labels;
  for (const MethodInfo& method : header.methods) labels.push_back(method.label);
  for (const std::string& label : spec.methods) names.methods.push_back(find_name(spec, "methods", label, labels));
  if (spec.methods.empty()) {
    for (std::size_t method = 0; method < labels.size(); ++method)
      if (!header.methods[method].difference && !header.methods[method].ratio) names.methods.push_back(method);
  }
  adapt_statistics(header, spec, names);
  names.is_drawn = cells_of_figure(header, spec);
  return names;
}

}  // namespace ridgeloc::results
