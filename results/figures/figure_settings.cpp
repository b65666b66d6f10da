#include "results/figures/figure_settings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "results/figures/figure_texts.hpp"
#include "results/schema/text.hpp"

namespace ridgeloc::results {
namespace {

bool contains(const std::vector<std::size_t>& dimensions, std::size_t dimension) {
  return std::ranges::find(dimensions, dimension) != dimensions.end();
}

/// "a (b)"; of two texts one of which is empty the other one.
std::string with_companion(const std::string& text, const std::string& companions) {
  if (text.empty() || companions.empty()) return text + companions;
  return fmt::format("{} ({})", text, companions);
}

}  // namespace

FigureSettings::FigureSettings(const Header& header, const FigureNames& names)
    : header_(header), names_(names), drawn_values_(header.axes.size()) {
  for (std::size_t cell = 0; cell < header.cells.size(); ++cell) {
    if (!names.is_drawn[cell]) continue;
    for (std::size_t axis = 0; axis < header.axes.size(); ++axis)
      drawn_values_[axis].insert(header.cells[cell].indices[axis]);
  }
  if (names.x) find_companions(*names.x);
  for (const Key* dimensions : {&names.group, &names.facet})
    for (const std::size_t axis : *dimensions)
      if (axis != FigureNames::method_dimension) find_companions(axis);
}

void FigureSettings::find_companions(std::size_t axis) {
  for (std::size_t other = 0; other < header_.axes.size(); ++other) {
    if (is_placed(other) || drawn_values_[other].size() < 2 || accompanying_.contains(other)) continue;
    Companion beside = companion(axis, other);
    if (beside.empty()) continue;
    companions_[axis][other] = std::move(beside);
    accompanying_.insert(other);
  }
}

FigureSettings::Companion FigureSettings::companion(std::size_t axis, std::size_t other) const {
  Companion beside;
  for (std::size_t cell = 0; cell < header_.cells.size(); ++cell) {
    if (!names_.is_drawn[cell]) continue;
    const Key& indices = header_.cells[cell].indices;
    if (beside.try_emplace(indices[axis], indices[other]).first->second != indices[other]) return {};
  }
  return beside;
}

FigureSettings::Key FigureSettings::key(std::size_t cell, std::size_t method, const Key& dimensions) const {
  Key result;
  for (const std::size_t dimension : dimensions)
    result.push_back(dimension == FigureNames::method_dimension ? method : header_.cells[cell].indices[dimension]);
  return result;
}

bool FigureSettings::is_placed(std::size_t axis) const {
  return axis == names_.x || contains(names_.group, axis) || contains(names_.facet, axis);
}

std::string FigureSettings::value(std::size_t axis, std::size_t value) const {
  return factor_text(header_.axes[axis].values[value]);
}

std::string FigureSettings::setting(std::size_t dimension, std::size_t value) const {
  if (dimension == FigureNames::method_dimension) return header_.methods[value].label;
  std::string text = fmt::format("{} = {}", header_.axes[dimension].name, this->value(dimension, value));
  const auto companions = companions_.find(dimension);
  if (companions == companions_.end()) return text;
  for (const auto& [axis, beside] : companions->second)
    text += fmt::format(", {} = {}", header_.axes[axis].name, this->value(axis, beside.at(value)));
  return text;
}

std::string FigureSettings::label(const Key& dimensions, const Key& values) const {
  std::string text;
  for (std::size_t i = 0; i < dimensions.size(); ++i) text += (i > 0 ? ", " : "") + setting(dimensions[i], values[i]);
  return text;
}

std::string FigureSettings::value_text(std::size_t axis, std::size_t value) const {
  std::string others;
  if (const auto companions = companions_.find(axis); companions != companions_.end()) {
    for (const auto& [other, beside] : companions->second) {
      const std::string text = this->value(other, beside.at(value));
      others += (others.empty() || text.empty() ? "" : ", ") + text;
    }
  }
  const std::string text = with_companion(this->value(axis, value), others);
  return text.empty() ? "none" : text;  // of a setting that only some cells read
}

std::string FigureSettings::title(std::size_t axis) const {
  std::string others;
  if (const auto companions = companions_.find(axis); companions != companions_.end())
    for (const auto& entry : companions->second)
      others += (others.empty() ? "" : ", ") + axis_label(header_.axes[entry.first]);
  return with_companion(axis_label(header_.axes[axis]), others);
}

std::string FigureSettings::conditions() const {
  std::string text;
  for (std::size_t axis = 0; axis < header_.axes.size(); ++axis) {
    if (is_placed(axis) || accompanying_.contains(axis) || header_.axes[axis].values.size() < 2) continue;
    const std::set<std::size_t>& values = drawn_values_[axis];
    if (values.empty()) continue;
    text += text.empty() ? "" : ", ";
    text += values.size() == 1 ? setting(axis, *values.begin())
                               : fmt::format("{} differs from cell to cell", header_.axes[axis].name);
  }
  return text;
}

}  // namespace ridgeloc::results
