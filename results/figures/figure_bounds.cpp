#include "results/figures/figure_bounds.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "results/statistics/interval.hpp"

namespace ridgeloc::results {
namespace {

/// Neither a difference nor a ratio, which nothing bounds.
bool is_solver(const MethodInfo& method) {
  return !method.difference && !method.ratio;
}

/// The row of a metric in a cell, of the first method that reports it there.
std::optional<SummaryRow> first_row(const Summary& summary, std::size_t cell, const std::string& metric) {
  for (std::size_t method = 0; method < summary.header.methods.size(); ++method) {
    if (!is_solver(summary.header.methods[method])) continue;
    const SummaryRow row = summary_row(summary.header, method, summary.of(cell, method), metric);
    if (row.n > 0) return row;
  }
  return std::nullopt;
}

const char* bound_kind_text(BoundKind kind, bool has_bands) {
  if (kind == BoundKind::RootMeanSquare) return "root mean square";
  return has_bands ? "median and quartiles" : "median";
}

}  // namespace

FigureBounds::FigureBounds(const Summary& summary, const FigureSpec& spec, const FigureNames& names)
    : summary_(summary), names_(names), is_wanted_(spec.bounds && names.kind == FigureNames::Kind::Curve) {}

std::size_t FigureBounds::bound_of(const std::string& metric) const {
  const auto& metrics = summary_.header.schema.metrics;
  const auto found = std::ranges::find(metrics, metric, &MetricInfo::name);
  if (found == metrics.end() || found->bound.empty()) return metrics.size();
  // One that the figure shows by itself needs no second line.
  if (std::ranges::find(names_.y, found->bound, &FigureNames::Quantity::name) != names_.y.end()) return metrics.size();
  return static_cast<std::size_t>(std::ranges::find(metrics, found->bound, &MetricInfo::name) - metrics.begin());
}

void FigureBounds::add(const SummaryRow& row, Place place) {
  if (!is_wanted_ || !is_solver(summary_.header.methods[row.method])) return;
  add_expectation(row, place);
  BoundKind kind = summary_.header.cells[row.cell].bound;
  const auto& metrics = summary_.header.schema.metrics;
  const std::size_t metric = bound_of(row.metric);
  if (kind == BoundKind::None || metric == metrics.size()) return;
  if (names_.y[place.metric].statistic != FigureNames::Statistic::RootMeanSquare) kind = BoundKind::Quantiles;

  Line& line = lines_[{place.panel, std::move(place.axes), metric, kind}];
  line.groups.insert(place.group);
  line.texts = std::move(place.texts);
  if (line.points.contains(place.x)) return;
  const auto bound = first_row(summary_, row.cell, metrics[metric].name);
  if (!bound) return;
  const bool is_rms = kind == BoundKind::RootMeanSquare;
  line.points[place.x] = is_rms ? FigurePoint{place.x, bound->rms, bound->rms, bound->rms}
                                : FigurePoint{place.x, bound->p50, bound->p25, bound->p75};
}

void FigureBounds::add_expectation(const SummaryRow& row, const Place& place) {
  const auto& metrics = summary_.header.schema.metrics;
  const auto info = std::ranges::find(metrics, row.metric, &MetricInfo::name);
  if (info == metrics.end() || info->chi_square == 0 || row.n == 0) return;
  if (names_.y[place.metric].statistic != FigureNames::Statistic::Mean) return;
  const Interval range = chi_square_mean_range(row.n, info->chi_square);
  const FigurePoint point{place.x, static_cast<double>(info->chi_square), range.lo, range.hi};
  const auto metric = static_cast<std::size_t>(info - metrics.begin());
  auto& points = lines_[{place.panel, {}, metric, BoundKind::None}].points;
  const auto entry = points.try_emplace(place.x, point).first;
  if (range.hi - range.lo > entry->second.hi - entry->second.lo) entry->second = point;
}

bool FigureBounds::unite(Line& line, const Line& other) {
  std::size_t shared = 0;
  for (const auto& [x, point] : other.points) {
    const auto same = line.points.find(x);
    if (same == line.points.end()) continue;
    if (same->second.y != point.y || same->second.lo != point.lo || same->second.hi != point.hi) return false;
    ++shared;
  }
  if (shared == 0) return false;
  line.groups.insert(other.groups.begin(), other.groups.end());
  line.points.insert(other.points.begin(), other.points.end());
  std::erase_if(line.texts,
                [&](const std::string& text) { return std::ranges::find(other.texts, text) == other.texts.end(); });
  return true;
}

std::vector<std::pair<FigureBounds::Key, FigureBounds::Line>> FigureBounds::distinct_lines() const {
  std::vector<std::pair<Key, Line>> distinct;
  for (const auto& [key, line] : lines_) {
    const bool is_known = std::ranges::any_of(distinct, [&, &of = key, &more = line](auto& known) {
      const Key& other = known.first;
      return other.panel == of.panel && other.metric == of.metric && other.kind == of.kind && unite(known.second, more);
    });
    if (!is_known && !line.points.empty()) distinct.emplace_back(key, line);
  }
  return distinct;
}

void FigureBounds::finish(FigureData& data) const {
  const auto lines = distinct_lines();
  std::map<std::size_t, std::size_t> bands;  // by panel
  for (const auto& [key, line] : lines) bands[key.panel] += key.kind == BoundKind::Quantiles ? 1 : 0;
  const bool has_bands = std::ranges::all_of(bands, [](const auto& panel) { return panel.second <= most_bands; });

  const auto& metrics = summary_.header.schema.metrics;
  std::map<std::string, std::size_t> entries;
  std::set<std::size_t> drawn;
  for (const auto& [key, line] : lines) {
    drawn.insert(key.metric);
    FigureBound bound;
    // The one group there is has no entry in the legend that would explain its colour.
    if (line.groups.size() == 1 && data.groups.size() > 1) bound.group = *line.groups.begin();
    const std::string of = bound.group || line.texts.empty() ? "" : fmt::format(" ({})", fmt::join(line.texts, ", "));
    const bool is_bound = key.kind != BoundKind::None;
    const std::string text =
        is_bound ? fmt::format("bound of unbiased estimates, {}{}", bound_kind_text(key.kind, has_bands), of)
                 : "expected, with 95 % of the means";
    const auto [entry, is_new] = entries.try_emplace(text, data.bounds.size());
    if (is_new) data.bounds.push_back(text);
    bound.entry = entry->second;
    bound.has_band = !is_bound || (has_bands && key.kind == BoundKind::Quantiles);
    for (const auto& [x, point] : line.points) bound.points.push_back(point);
    data.panels[key.panel].bounds.push_back(std::move(bound));
  }
  for (const std::size_t metric : drawn) {
    const MetricInfo& info = metrics[metric];
    if (info.chi_square > 0) {
      data.footnote += fmt::format("; expected: chi-square with {} degrees of freedom", info.chi_square);
      continue;
    }
    data.footnote += fmt::format("; bound of unbiased estimates, of their root mean squares: {}",
                                 info.description.empty() ? info.name : info.description);
  }
}

}  // namespace ridgeloc::results
