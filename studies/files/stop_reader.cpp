#include <fmt/format.h>

#include <algorithm>

#include "studies/files/sections.hpp"
#include "studies/files/toml_document.hpp"
#include "studies/study/capabilities.hpp"
#include "studies/study/comparison.hpp"
#include "studies/study/setting_builders.hpp"

namespace ridgeloc::studies {

namespace {

/// A number of the rule, which has no default.
Setting number_setting(const char* name, Interval bounds) {
  return Section("stop").real(name, 0, bounds, "1", "");
}

std::uint64_t read_trials(const toml::table& table, const char* name, std::uint64_t least) {
  const Interval bounds = {static_cast<double>(least), static_cast<double>(max_trials)};
  const Setting setting = Section("stop").integer(name, 1, bounds, "");
  const toml::node* node = table.get(name);
  if (node == nullptr) fail_at(table, fmt::format("[stop] lacks {}: {}", name, accepted(setting)));
  return static_cast<std::uint64_t>(std::get<std::int64_t>(read_setting(*node, setting, fmt::format("stop.{}", name))));
}

}  // namespace

void read_stop(const toml::table& document, Study& study) {
  const toml::node* node = document.get("stop");
  if (node == nullptr) return;
  const toml::table& table = read_table(*node, "[stop]");
  check_keys(table, "[stop]",
             {"metric", "statistic", "methods", "target", "relative", "min_trials", "max_trials", "max_cost"});
  std::vector<std::string> quantities;
  for (const auto& metric : study.experiment->schema().metrics) quantities.push_back(metric.name);
  for (const auto& event : study.experiment->schema().events) quantities.push_back(event.name);
  std::vector<std::string> labels = label_names(*study.experiment);
  for (const Method& method : study.methods) labels.push_back(method.label);
  for (const Comparison& comparison : study.comparisons) labels.push_back(label_of(comparison));

  StopRule rule;
  const toml::node* metric = table.get("metric");
  if (metric == nullptr) fail_at(table, "[stop] lacks metric: what is to be known well enough, for example error_m");
  rule.metric = read_text(*metric, "stop.metric", quantities);
  if (const toml::node* statistic = table.get("statistic"))
    rule.statistic = read_text(*statistic, "stop.statistic", {"mean", "median", "rms"});
  if (const toml::node* methods = table.get("methods")) rule.methods = read_texts(*methods, "stop.methods", labels);
  const toml::node* target = table.get("target");
  const toml::node* relative = table.get("relative");
  if ((target == nullptr) == (relative == nullptr)) {
    fail_at(table,
            "[stop] needs either target, a standard error in the unit of the metric, or relative, a share of its "
            "value");
  }
  rule.is_relative = relative != nullptr;
  const char* name = rule.is_relative ? "relative" : "target";
  rule.target = std::get<double>(read_setting(rule.is_relative ? *relative : *target,
                                              number_setting(name, {1e-15, 1e12}), fmt::format("stop.{}", name)));
  rule.min_trials = table.contains("min_trials") ? read_trials(table, "min_trials", 1) : study.trials;
  const toml::node* trials = document.get("trials");
  if (trials != nullptr && is_override(*trials) && rule.min_trials != study.trials) {
    fail_at(*trials, "[stop] has its own min_trials, which counts instead; set stop.min_trials");
  }
  rule.max_trials = read_trials(table, "max_trials", rule.min_trials);
  if (const toml::node* cost = table.get("max_cost"))
    rule.max_cost = std::get<double>(read_setting(*cost, number_setting("max_cost", {1, 1e18}), "stop.max_cost"));
  study.trials = rule.min_trials;
  study.stop = std::move(rule);
}

}  // namespace ridgeloc::studies
