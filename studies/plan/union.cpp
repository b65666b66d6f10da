#include "studies/plan/union.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "studies/plan/plan.hpp"
#include "studies/study/axis_groups.hpp"
#include "studies/study/capabilities.hpp"
#include "studies/study/comparison.hpp"
#include "studies/study/conditions.hpp"

namespace ridgeloc::studies {

namespace {

std::map<std::string, std::string> content_by_key(const Study& study) {
  std::map<std::string, std::string> content;
  for (const std::string& line : study_content(study)) {
    const std::size_t sign = line.find(" = ");
    content[line.substr(0, sign)] = line.substr(sign + 3);
  }
  for (const SweepAxis& axis : study.sweep) {
    if (!axis.setting->per_method) content[axis.setting->name] = "swept";
  }
  return content;
}

bool is_number(const Value& value) {
  return std::holds_alternative<std::int64_t>(value) || std::holds_alternative<double>(value);
}

double number_of(const Value& value) {
  const auto* integer = std::get_if<std::int64_t>(&value);
  return integer != nullptr ? static_cast<double>(*integer) : std::get<double>(value);
}

bool are_ascending_numbers(const std::vector<Value>& values) {
  return std::ranges::all_of(values, is_number) && std::ranges::is_sorted(values, {}, number_of);
}

/// The values of `more` behind those of `values`, or between them.
void add_values(std::vector<Value>& values, const std::vector<Value>& more) {
  const bool sorted = are_ascending_numbers(values) && are_ascending_numbers(more);
  std::set<std::string> known;
  for (const Value& value : values) known.insert(to_toml(value));
  for (const Value& value : more) {
    if (known.insert(to_toml(value)).second) values.push_back(value);
  }
  if (sorted) std::ranges::sort(values, {}, number_of);
}

/// Axes that move together gain whole rows.
void add_rows(Study& study, const std::vector<std::string>& zip, const Study& other) {
  const auto axes_of = [&](auto& of) {
    std::vector<decltype(of.sweep.data())> axes;
    for (const std::string& name : zip)
      axes.push_back(&*std::ranges::find_if(of.sweep, [&](const SweepAxis& a) { return a.setting->name == name; }));
    return axes;
  };
  const auto row_of = [](const auto& axes, std::size_t i) {
    std::vector<std::string> row;
    for (const auto* axis : axes) row.push_back(to_toml(axis->values[i]));
    return row;
  };
  const auto axes = axes_of(study);
  const auto others = axes_of(other);
  std::set<std::vector<std::string>> known;
  for (std::size_t i = 0; i < axes.front()->values.size(); ++i) known.insert(row_of(axes, i));
  for (std::size_t i = 0; i < others.front()->values.size(); ++i) {
    if (!known.insert(row_of(others, i)).second) continue;
    for (std::size_t a = 0; a < axes.size(); ++a) axes[a]->values.push_back(others[a]->values[i]);
  }
}

std::set<std::set<std::string>> zip_groups(const Study& study) {
  std::set<std::set<std::string>> groups;
  for (const auto& zip : study.zip) groups.insert({zip.begin(), zip.end()});
  return groups;
}

/// A pattern stays while it leaves out no cell of either study.
std::vector<Values> common_exclusions(const Study& study, const Study& other) {
  const CellGrid cells(study);
  const CellGrid others(other);
  std::vector<Values> kept;
  const auto keep = [&](const std::vector<Values>& patterns) {
    for (const Values& pattern : patterns) {
      if (!cells.has_any(pattern) && !others.has_any(pattern) && std::ranges::find(kept, pattern) == kept.end())
        kept.push_back(pattern);
    }
  };
  keep(study.exclude);
  keep(other.exclude);
  return kept;
}

void unite_sweeps(Study& study, const Study& other) {
  if (zip_groups(study) != zip_groups(other)) {
    throw core::InputError(fmt::format(
        "{}: its axes are zipped in another way than those of {}; use the same sweep.zip", study.name, other.name));
  }
  std::vector<Values> exclusions = common_exclusions(study, other);
  for (SweepAxis& axis : study.sweep) {
    const bool zipped = std::ranges::any_of(
        study.zip, [&](const auto& zip) { return std::ranges::find(zip, axis.setting->name) != zip.end(); });
    if (zipped) continue;
    const auto same = std::ranges::find(other.sweep, axis.setting, &SweepAxis::setting);
    add_values(axis.values, same->values);
  }
  for (const auto& zip : study.zip) add_rows(study, zip, other);
  study.exclude = std::move(exclusions);
  // Before the next union looks at all of them.
  refuse_too_many_cells(study);
}

/// A method of another study with all that it reads and that the first study has set otherwise.
Method method_in(const Study& study, const Study& other, Method method) {
  for (const std::string& name : settings_read_for(*study.experiment, method.solver)) {
    const Setting& setting = setting_named(*study.experiment, name);
    if (depends_on_method(*study.experiment, setting) && !is_read(other, method, setting)) continue;
    const auto here = study.fixed.find(name);
    const auto there = other.fixed.find(name);
    if (method.given.contains(name) || here == study.fixed.end() || there == other.fixed.end()) continue;
    if (here->second != there->second) method.given[name] = there->second;
  }
  return method;
}

void unite_methods(Study& study, const Study& other) {
  std::set<std::string> known;
  for (const Method& method : study.methods) known.insert(method_hash(study, method));
  for (const std::string& label : label_names(*study.experiment)) {
    if (method_hash(study, {label, label, {}}) != method_hash(other, {label, label, {}})) {
      throw core::InputError(
          fmt::format("{}: its settings in [solver] give another \"{}\" than those of {}; give them to "
                      "each [[method]] instead",
                      study.name, label, other.name));
    }
  }
  for (const Method& method : other.methods) {
    if (!known.insert(method_hash(other, method)).second) continue;
    if (std::ranges::find(study.methods, method.label, &Method::label) != study.methods.end()) {
      throw core::InputError(
          fmt::format("{}: its method \"{}\" has other settings in {}; call one of them by another name = \"...\"",
                      study.name, method.label, other.name));
    }
    study.methods.push_back(method_in(study, other, method));
  }
}

/// Comparisons name methods by label, and the other study may have other labels for the same methods.
void unite_comparisons(Study& study, const Study& other) {
  const auto label_here = [&](const std::string& label) {
    const std::string hash = method_hash(other, *std::ranges::find(other.methods, label, &Method::label));
    return std::ranges::find(study.methods, hash, [&](const Method& m) { return method_hash(study, m); })->label;
  };
  for (const Comparison& comparison : other.comparisons) {
    const Comparison here = {label_here(comparison[0]), label_here(comparison[1])};
    if (std::ranges::find(study.comparisons, here) == study.comparisons.end()) study.comparisons.push_back(here);
  }
}

}  // namespace

std::vector<std::string> differences(const Study& found, const Study& wanted) {
  const auto there = content_by_key(found);
  const auto here = content_by_key(wanted);
  std::vector<std::string> texts;
  for (const auto& [key, value] : here) {
    const auto other = there.find(key);
    const std::string known = other == there.end() ? "absent" : other->second;
    if (known != value) texts.push_back(fmt::format("{} is {}, not {}", key, known, value));
  }
  for (const auto& [key, value] : there) {
    if (!here.contains(key)) texts.push_back(fmt::format("{} is {}, not absent", key, value));
  }
  return texts;
}

Study united(Study study, const Study& other) {
  unite_sweeps(study, other);
  unite_methods(study, other);
  unite_comparisons(study, other);
  if (const auto clash = named_like_a_method(study)) {
    throw core::InputError(
        fmt::format("{}: together with {} it has a method and a comparison that are both called "
                    "\"{}\"; choose another name for the method",
                    study.name, other.name, label_of(*clash)));
  }
  study.trials = std::max(study.trials, other.trials);
  study.trial_columns_mib = std::max(study.trial_columns_mib, other.trial_columns_mib);
  return study;
}

}  // namespace ridgeloc::studies
