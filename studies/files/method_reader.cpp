#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/error.hpp"
#include "studies/files/sections.hpp"
#include "studies/files/toml_document.hpp"
#include "studies/study/capabilities.hpp"
#include "studies/study/conditions.hpp"

namespace ridgeloc::studies {

namespace {

constexpr std::size_t max_label_size = 64;

void check_label(const toml::node& node, const std::string& label, const Study& study) {
  // Labels become names of groups in result files.
  const bool plain = std::ranges::none_of(label, [](unsigned char c) { return c == '/' || c < 0x20 || c == 0x7f; });
  if (label.empty() || label == "." || label.size() > max_label_size || !plain) {
    fail_at(
        node,
        fmt::format(
            "method name \"{}\" is not allowed: 1 to {} bytes without '/' or control characters, and not a single '.'",
            label, max_label_size));
  }
  const auto reserved = label_names(*study.experiment);
  if (std::ranges::find(reserved, label) != reserved.end()) {
    fail_at(node, fmt::format("method name \"{}\" is taken by the experiment itself; choose another", label));
  }
  if (std::ranges::find(study.methods, label, &Method::label) != study.methods.end()) {
    fail_at(node, fmt::format("two methods are called \"{}\"; tell them apart with name = \"...\"", label));
  }
}

/// Refuses a setting that is given and that the method does not read, and an empty text that it reads.
void check_condition(const toml::table& table, const Setting& setting, const Study& study, const Method& method) {
  const toml::node* const value = table.get(setting.name);
  const std::string choices = fmt::format("{}", fmt::join(setting.read_if.choices, " or "));
  if (!is_read(study, method, setting)) {
    if (value == nullptr) return;
    fail_at(*value, fmt::format("{} changes nothing in this [[method]]: it is read only if {} is {}", setting.name,
                                setting.read_if.setting, choices));
  }
  if (!depends_on_method(*study.experiment, setting) || setting.complaint == nullptr) return;
  const auto values = values_read(study, method, setting);
  if (std::ranges::find(values, Value(std::string())) == values.end()) return;
  const toml::node* const chosen = table.get(setting.read_if.setting);
  const toml::node& place = chosen == nullptr ? table : *chosen;
  fail_at(value == nullptr ? place : *value, fmt::format("{} = \"{}\" needs {}: {}", setting.read_if.setting, choices,
                                                         setting.name, setting.complaint(std::string())));
}

void read_method(const toml::table& table, Study& study) {
  const toml::node* solver = table.get("solver");
  if (solver == nullptr) {
    fail_at(table, fmt::format("[[method]] lacks a solver; add solver = \"...\" (allowed: {})",
                               fmt::join(solvers_of(*study.experiment), ", ")));
  }
  Method method;
  method.solver = read_text(*solver, "solver", solvers_of(*study.experiment));
  const auto read = settings_read_for(*study.experiment, method.solver);
  std::vector<std::string> allowed = {"solver", "name"};
  allowed.insert(allowed.end(), read.begin(), read.end());
  check_keys(table, fmt::format("[[method]] with solver \"{}\"", method.solver), allowed);

  for (const Setting& setting : study.experiment->settings()) {
    const toml::node* value = table.get(setting.name);
    if (value == nullptr) continue;
    if (!study.fixed.contains(setting.name)) {
      fail_at(*value, fmt::format("\"{}\" is swept in [sweep] too; give it in one place", setting.name));
    }
    method.given[setting.name] = read_setting(*value, setting, setting.name);
  }
  for (const Setting& setting : study.experiment->settings()) {
    if (std::ranges::find(read, setting.name) != read.end()) check_condition(table, setting, study, method);
  }

  const toml::node* name = table.get("name");
  method.label = name == nullptr ? method.solver : read_text(*name, "name");
  check_label(name == nullptr ? *solver : *name, method.label, study);
  study.methods.push_back(std::move(method));
}

}  // namespace

void read_methods(const toml::table& document, const std::string& origin, Study& study) {
  const toml::node* node = document.get("method");
  if (offered<SolverChoice>(*study.experiment) == nullptr) {
    if (node == nullptr) return;
    fail_at(*node, fmt::format("the experiment \"{}\" has no methods to choose; leave [[method]] out",
                               study.experiment->name()));
  }
  if (node == nullptr || (node->is_array() && node->as_array()->empty())) {
    throw core::InputError(fmt::format("{}: no [[method]]; add at least one with solver = \"...\" (allowed: {})",
                                       origin, fmt::join(solvers_of(*study.experiment), ", ")));
  }
  const auto tables = read_tables(*node, "method");
  if (tables.size() > max_methods)
    fail_at(*node, fmt::format("{} [[method]]s; at most {} are allowed", tables.size(), max_methods));
  for (const toml::table* table : tables) read_method(*table, study);

  for (const SweepAxis& axis : study.sweep) {
    const bool read = std::ranges::any_of(study.methods, [&](const Method& m) {
      const auto settings = settings_read_for(*study.experiment, m.solver);
      return std::ranges::find(settings, axis.setting->name) != settings.end() && is_read(study, m, *axis.setting);
    });
    if (axis.setting->per_method && !read) {
      const auto& [setting, choices] = axis.setting->read_if;
      const std::string condition =
          setting.empty() ? "" : fmt::format(": it is read only if {} is {}", setting, fmt::join(choices, " or "));
      fail_at(*document.get("sweep"),
              fmt::format("sweep.{} changes nothing: no [[method]] reads it{}", axis.setting->name, condition));
    }
  }
}

}  // namespace ridgeloc::studies
