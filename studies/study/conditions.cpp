#include "studies/study/conditions.hpp"

#include <algorithm>
#include <cassert>

namespace ridgeloc::studies {

namespace {

/// Whether a condition holds where the setting that it asks for has this value.
bool is_choice(const Condition& condition, const Value& value) {
  return std::ranges::find(condition.choices, std::get<std::string>(value)) != condition.choices.end();
}

}  // namespace

bool is_read(const Study& study, const Setting& setting) {
  return is_read(study, Method{}, setting);
}

bool is_read(const Study& study, const Method& method, const Setting& setting) {
  if (setting.read_if.setting.empty()) return true;
  const auto values = values_of(study, method, setting_named(*study.experiment, setting.read_if.setting));
  return std::ranges::any_of(values, [&](const Value& value) { return is_choice(setting.read_if, value); });
}

bool depends_on_method(const Experiment& experiment, const Setting& setting) {
  return !setting.read_if.setting.empty() && setting_named(experiment, setting.read_if.setting).per_method;
}

const Setting& setting_named(const Experiment& experiment, std::string_view name) {
  const auto found = std::ranges::find(experiment.settings(), name, &Setting::name);
  assert(found != experiment.settings().end());
  return *found;
}

std::vector<Value> values_of(const Study& study, const Method& method, const Setting& setting) {
  const auto given = method.given.find(setting.name);
  if (given != method.given.end()) return {given->second};
  const auto fixed = study.fixed.find(setting.name);
  if (fixed != study.fixed.end()) return {fixed->second};
  const auto axis = std::ranges::find(study.sweep, setting.name, [](const SweepAxis& a) { return a.setting->name; });
  return axis == study.sweep.end() ? std::vector<Value>{} : axis->values;
}

std::vector<Value> values_read(const Study& study, const Method& method, const Setting& setting) {
  if (!is_read(study, method, setting)) return {};
  std::vector<Value> values = values_of(study, method, setting);
  const std::string& other = setting.read_if.setting;
  const bool is_zipped = std::ranges::any_of(study.zip, [&](const std::vector<std::string>& names) {
    return std::ranges::find(names, setting.name) != names.end() && std::ranges::find(names, other) != names.end();
  });
  if (!is_zipped || method.given.contains(setting.name) || method.given.contains(other)) return values;
  const auto beside = values_of(study, method, setting_named(*study.experiment, other));
  std::vector<Value> read;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (is_choice(setting.read_if, beside[i])) read.push_back(values[i]);
  return read;
}

}  // namespace ridgeloc::studies
