#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.hpp"
#include "studies/files/decimal_range.hpp"
#include "studies/files/sections.hpp"
#include "studies/files/toml_document.hpp"
#include "studies/study/axis_groups.hpp"

namespace ridgeloc::studies {

namespace {

constexpr std::size_t max_axis_values = 100'000;

/// {from = a, to = b, step = s}: a, a + s, ..., b.
toml::array expand_range(const toml::table& range, const Setting& setting) {
  const std::string label = fmt::format("sweep.{}", setting.name);
  check_keys(range, label, {"from", "to", "step"});
  const auto part = [&](const char* key) {
    const toml::node* node = range.get(key);
    if (node == nullptr)
      fail_at(range, fmt::format("{}: a range takes from, to and step; \"{}\" is missing", label, key));
    if (!node->is_number() || !std::isfinite(*node->value<double>())) {
      fail_at(*node, fmt::format("{}.{} must be a number", label, key));
    }
    return *node->value<double>();
  };
  const double from = part("from");
  const double to = part("to");
  const double step = part("step");
  const DecimalRange expanded = decimal_range(from, to, step, max_axis_values);
  if (expanded.values.empty()) {
    fail_at(range, fmt::format("{}: from {} to {} in steps of {} is no range of 1 to {} values", label, from, to, step,
                               max_axis_values));
  }
  if (!expanded.reaches_end) {
    fail_at(range, fmt::format("{}: from {} in steps of {} comes to {} and {}, not to {}; let the range end at one of "
                               "them",
                               label, from, step, expanded.values.back(), expanded.beyond, to));
  }
  toml::array values;
  for (const double value : expanded.values) {
    if (setting.kind == Kind::Integer && value == std::floor(value)) {
      values.push_back(static_cast<std::int64_t>(value));
    } else {
      values.push_back(value);
    }
  }
  return values;
}

/// The values of an axis. One that is zipped may have a value several times, beside others of the axes that move with
/// it.
SweepAxis read_axis(const toml::node& node, const Setting& setting, bool is_zipped) {
  const std::string label = fmt::format("sweep.{}", setting.name);
  if (setting.kind == Kind::Samples || setting.kind == Kind::Positions || setting.kind == Kind::Building) {
    fail_at(node, fmt::format("{} cannot be swept; make one study of each", setting.name));
  }
  SweepAxis axis{&setting, {}};
  std::set<std::string> seen;
  const auto add = [&](Value value, const toml::node& place) {
    const std::string text = to_toml(value);
    if (!seen.insert(text).second && !is_zipped) fail_at(place, fmt::format("{} lists {} twice", label, text));
    axis.values.push_back(std::move(value));
  };
  if (const toml::table* range = node.as_table()) {
    for (const toml::node& value : expand_range(*range, setting)) {
      // Expanded values have no place of their own; a bad one is reported at the range.
      try {
        add(read_setting(value, setting, label), node);
      } catch (const core::InputError&) {
        fail_at(node,
                fmt::format("{}: the range repeats a value or leaves what is allowed: {}", label, accepted(setting)));
      }
    }
    return axis;
  }
  const toml::array* values = node.as_array();
  if (values == nullptr) {
    fail_at(node, fmt::format("{} must be a list of values or a range {{from=, to=, step=}}", label));
  }
  if (values->empty()) fail_at(node, fmt::format("{} is an empty list; give at least one value or remove it", label));
  for (const toml::node& value : *values) add(read_setting(value, setting, label), value);
  return axis;
}

std::vector<std::string> axis_names(const Study& study) {
  std::vector<std::string> names;
  for (const SweepAxis& axis : study.sweep) names.push_back(axis.setting->name);
  return names;
}

const SweepAxis& axis_named(const Study& study, std::string_view name) {
  return *std::ranges::find_if(study.sweep, [&](const SweepAxis& a) { return a.setting->name == name; });
}

/// Whether a key of [sweep] stands in one of its lists of zipped axes, whatever else is wrong with these.
bool is_zipped(const toml::table& sweep, std::string_view name) {
  const toml::array* groups = sweep["zip"].as_array();
  if (groups == nullptr) return false;
  return std::ranges::any_of(*groups, [&](const toml::node& group) {
    const toml::array* names = group.as_array();
    return names != nullptr &&
           std::ranges::any_of(*names, [&](const toml::node& n) { return n.value<std::string_view>() == name; });
  });
}

/// Refuses a group of zipped axes with the same values at two places: they would be one cell.
void refuse_repeated_row(const toml::node& group, const std::vector<std::string>& names, const Study& study) {
  std::set<std::string> seen;
  for (std::size_t i = 0; i < axis_named(study, names.front()).values.size(); ++i) {
    std::string row;
    for (const std::string& name : names)
      row += fmt::format("{}{} = {}", row.empty() ? "" : ", ", name, to_toml(axis_named(study, name).values[i]));
    if (!seen.insert(row).second)
      fail_at(group, fmt::format("sweep.zip: {} stands there twice; zipped values differ in one axis at least", row));
  }
}

void read_zip(const toml::node& node, Study& study) {
  const toml::array* groups = node.as_array();
  if (groups == nullptr) fail_at(node, "sweep.zip must be a list of lists of axes, [[\"points\", \"range_sigma_m\"]]");
  std::set<std::string> used;
  for (const toml::node& group : *groups) {
    auto names = read_texts(group, "sweep.zip", axis_names(study));
    if (names.size() < 2) fail_at(group, "sweep.zip needs two axes or more in each group");
    for (const std::string& name : names) {
      if (!used.insert(name).second) fail_at(group, fmt::format("sweep.zip names \"{}\" twice", name));
      const std::size_t expected = axis_named(study, names.front()).values.size();
      const std::size_t size = axis_named(study, name).values.size();
      if (size != expected) {
        fail_at(group, fmt::format("sweep.zip: {} has {} values and {} has {}; zipped axes have equally many",
                                   names.front(), expected, name, size));
      }
    }
    refuse_repeated_row(group, names, study);
    study.zip.push_back(std::move(names));
  }
}

void read_exclude(const toml::node& node, Study& study) {
  const auto tables = read_tables(node, "sweep.exclude");
  if (tables.size() > max_exclusions)
    fail_at(node, fmt::format("sweep.exclude has {} tables; at most {} are allowed", tables.size(), max_exclusions));
  for (const toml::table* table : tables) {
    check_keys(*table, "sweep.exclude", axis_names(study));
    if (table->empty()) fail_at(*table, "sweep.exclude: an empty table would leave out every cell");
    Values values;
    for (const auto& [key, value] : *table) {
      const SweepAxis& axis = axis_named(study, key.str());
      const std::string label = fmt::format("sweep.exclude.{}", key.str());
      values[std::string(key.str())] = read_setting(value, *axis.setting, label);
      if (std::ranges::find(axis.values, values[std::string(key.str())]) == axis.values.end()) {
        fail_at(value, fmt::format("{} is not among the values of that axis", label));
      }
    }
    study.exclude.push_back(std::move(values));
  }
}

}  // namespace

void read_sweep(const toml::table& document, Study& study) {
  const toml::node* node = document.get("sweep");
  if (node == nullptr) return;
  const toml::table& table = read_table(*node, "[sweep]");
  std::vector<std::string> allowed;
  for (const Setting& s : study.experiment->settings()) allowed.push_back(s.name);
  allowed.insert(allowed.end(), {"zip", "exclude"});
  check_keys(table, "[sweep]", allowed);
  for (const Setting& setting : study.experiment->settings()) {
    if (const toml::node* values = table.get(setting.name))
      study.sweep.push_back(read_axis(*values, setting, is_zipped(table, setting.name)));
  }
  if (study.sweep.empty()) fail_at(table, "[sweep] names no axis; add one, points = [3, 4, 5] say, or remove it");
  if (const toml::node* zip = table.get("zip")) read_zip(*zip, study);
  if (const toml::node* exclude = table.get("exclude")) read_exclude(*exclude, study);

  const double cells = crossed_cells(study);
  if (cells > static_cast<double>(max_cells)) {
    fail_at(table, fmt::format("[sweep] crosses to {:.0f} cells; at most {} are allowed", cells, max_cells));
  }
}

}  // namespace ridgeloc::studies
