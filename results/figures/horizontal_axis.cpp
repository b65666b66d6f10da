#include "results/figures/horizontal_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/error.hpp"

namespace ridgeloc::results {
namespace {

std::optional<double> number(const FactorValue& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return static_cast<double>(*integer);
  if (const auto* real = std::get_if<double>(&value)) return *real;
  return std::nullopt;
}

/// The numbers of an axis; none if any of its values is a text.
std::vector<double> numbers_of(const Axis& axis) {
  std::vector<double> numbers;
  for (const FactorValue& value : axis.values)
    if (const auto x = number(value)) numbers.push_back(*x);
  if (numbers.size() < axis.values.size()) numbers.clear();
  return numbers;
}

}  // namespace

HorizontalAxis horizontal_axis(const Header& header, const FigureSpec& spec, const FigureNames& names,
                               const FigureSettings& settings, bool log_x) {
  const Axis& axis = header.axes[*names.x];
  HorizontalAxis result;
  result.positions = numbers_of(axis);
  result.is_categorical = result.positions.empty();
  const bool is_positive =
      !result.is_categorical && std::ranges::all_of(result.positions, [](double x) { return x > 0.0; });
  if (is_positive) {
    const auto [low, high] = std::ranges::minmax(result.positions);
    result.log = axis.values.size() > 2 && high >= 100.0 * low;
  }
  if (log_x && !is_positive) {
    throw core::InputError(
        fmt::format("figure '{}': --log-x needs an axis of numbers above 0, and {} is none", spec.name, axis.name));
  }
  result.log = result.log || log_x;
  if (result.is_categorical) result.positions.resize(axis.values.size());
  for (const std::size_t i : settings.drawn_values(*names.x)) {
    if (result.is_categorical) result.positions[i] = static_cast<double>(result.ticks.size());
    result.ticks.push_back({result.positions[i], settings.value_text(*names.x, i)});
  }
  std::ranges::sort(result.ticks, {}, &FigureTick::position);
  return result;
}

}  // namespace ridgeloc::results
