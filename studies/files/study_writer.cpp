#include "studies/files/study_writer.hpp"
#include "studies/study/capabilities.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

namespace ridgeloc::studies {

namespace {

std::string quoted(const std::string& text) {
  return to_toml(Value(text));
}

std::string quoted_list(const std::vector<std::string>& texts) {
  std::vector<std::string> parts;
  for (const std::string& text : texts) parts.push_back(quoted(text));
  return fmt::format("[{}]", fmt::join(parts, ", "));
}

std::string value_list(const std::vector<Value>& values) {
  std::vector<std::string> parts;
  for (const Value& value : values) parts.push_back(to_toml(value));
  return fmt::format("[{}]", fmt::join(parts, ", "));
}

std::string inline_table(const Values& values) {
  std::vector<std::string> parts;
  for (const auto& [name, value] : values) parts.push_back(fmt::format("{} = {}", name, to_toml(value)));
  return fmt::format("{{ {} }}", fmt::join(parts, ", "));
}

void write_sweep(const Study& study, std::string& out) {
  if (study.sweep.empty()) return;
  out += "\n[sweep]\n";
  for (const SweepAxis& axis : study.sweep)
    out += fmt::format("{} = {}\n", axis.setting->name, value_list(axis.values));
  if (!study.zip.empty()) {
    std::vector<std::string> groups;
    for (const auto& group : study.zip) groups.push_back(quoted_list(group));
    out += fmt::format("zip = [{}]\n", fmt::join(groups, ", "));
  }
  if (!study.exclude.empty()) {
    std::vector<std::string> tables;
    for (const Values& values : study.exclude) tables.push_back(inline_table(values));
    out += fmt::format("exclude = [{}]\n", fmt::join(tables, ", "));
  }
}

/// { range_sigma_m = [0.1, 0.3] }.
std::string where_table(const Study& study, const results::AxisValues& where) {
  std::vector<std::string> parts;
  for (const auto& [name, texts] : where) {
    const auto axis = std::ranges::find(study.sweep, name, [](const SweepAxis& a) { return a.setting->name; });
    const bool is_text = axis->setting->kind == Kind::Choice || axis->setting->kind == Kind::Text;
    parts.push_back(
        fmt::format("{} = {}", name, is_text ? quoted_list(texts) : fmt::format("[{}]", fmt::join(texts, ", "))));
  }
  return fmt::format("{{ {} }}", fmt::join(parts, ", "));
}

void write_figure(const Study& study, const results::FigureSpec& figure, std::string& out) {
  out += fmt::format("\n[[figure]]\nname = {}\n", quoted(figure.name));
  if (!figure.title.empty()) out += fmt::format("title = {}\n", quoted(figure.title));
  if (figure.kind != "curve") out += fmt::format("kind = {}\n", quoted(figure.kind));
  if (!figure.x.empty()) out += fmt::format("x = {}\n", quoted(figure.x));
  out += fmt::format("y = {}\n", quoted_list(figure.y));
  if (!figure.statistic.empty()) out += fmt::format("statistic = {}\n", quoted(figure.statistic));
  if (!figure.group.empty()) out += fmt::format("group = {}\n", quoted_list(figure.group));
  if (!figure.facet.empty()) out += fmt::format("facet = {}\n", quoted(figure.facet));
  if (!figure.methods.empty()) out += fmt::format("methods = {}\n", quoted_list(figure.methods));
  if (!figure.where.empty()) out += fmt::format("where = {}\n", where_table(study, figure.where));
  if (figure.log_y) out += "log_y = true\n";
  if (!figure.bounds) out += "bounds = false\n";
}

void write_stop(const StopRule& rule, std::string& out) {
  out += fmt::format("\n[stop]\nmetric = {}\nstatistic = {}\n", quoted(rule.metric), quoted(rule.statistic));
  if (!rule.methods.empty()) out += fmt::format("methods = {}\n", quoted_list(rule.methods));
  out += fmt::format("{} = {}\nmin_trials = {}\nmax_trials = {}\n", rule.is_relative ? "relative" : "target",
                     to_toml(Value(rule.target)), rule.min_trials, rule.max_trials);
  if (rule.max_cost > 0.0) out += fmt::format("max_cost = {}\n", to_toml(Value(rule.max_cost)));
}

/// Calls `line` for every setting, with a section heading whenever the section changes.
template <class F>
void for_each_setting(const Experiment& experiment, std::string& out, F&& line) {
  std::string section;
  for (const Setting& setting : experiment.settings()) {
    if (setting.section != section) {
      section = setting.section;
      out += fmt::format("\n[{}]\n", section);
    }
    line(setting);
  }
}

}  // namespace

std::string resolved_toml(const Study& study) {
  std::string out = fmt::format("title = {}\n", quoted(study.title));
  if (!study.aims.empty()) out += fmt::format("aims = {}\n", quoted(study.aims));
  out +=
      fmt::format("experiment = {}\nseed = {}\ntrials = {}\naudit = {}\n",
                  quoted(std::string(study.experiment->name())), study.seed, study.trials, to_toml(Value(study.audit)));
  if (study.comparisons.empty()) out += "compare = []\n";
  out += fmt::format("\n[store]\ntrial_columns_mib = {}\n", to_toml(Value(study.trial_columns_mib)));
  for_each_setting(*study.experiment, out, [&](const Setting& setting) {
    const auto found = study.fixed.find(setting.name);
    // A text that is empty unless somebody writes one.
    const bool is_unwritten =
        setting.standard == Value(std::string()) && found != study.fixed.end() && found->second == setting.standard;
    if (found != study.fixed.end() && !is_unwritten)
      out += fmt::format("{} = {}\n", setting.name, to_toml(found->second));
  });
  write_sweep(study, out);
  for (const Method& method : study.methods) {
    out += fmt::format("\n[[method]]\nname = {}\nsolver = {}\n", quoted(method.label), quoted(method.solver));
    for (const auto& [name, value] : method.given) out += fmt::format("{} = {}\n", name, to_toml(value));
  }
  for (const Comparison& comparison : study.comparisons)
    out += fmt::format("\n[[compare]]\nmethod = {}\nwith = {}\n", quoted(comparison[0]), quoted(comparison[1]));
  if (study.stop) write_stop(*study.stop, out);
  for (const results::FigureSpec& figure : study.figures) write_figure(study, figure, out);
  return out;
}

std::string template_toml(const Experiment& experiment) {
  std::string out = fmt::format(
      "# A study of the experiment \"{}\": {}.\n"
      "# Run it with: ridgeloc run FILE.toml -o FILE.h5\n"
      "# Every setting below stands at its default; what you leave out stays there.\n\n"
      "title = \"My study\"\naims = \"\"  # what it is to find out, for reports\nexperiment = \"{}\"\nseed = "
      "2018\ntrials = 10000  # per cell\n",
      experiment.name(), experiment.summary(), experiment.name());
  if (audit_metrics_of(experiment) > 0) {
    out += "audit = 0.0001  # share of the trials, besides the first 100 of a cell, that Ceres solves again; 0: none\n";
  }
  out += "\n[store]\ntrial_columns_mib = 256.0  # per-trial columns kept of all cells together (MiB)\n";
  for_each_setting(experiment, out, [&](const Setting& s) {
    const std::string unit = s.unit == "1" ? "" : fmt::format(" ({})", s.unit);
    const std::string condition = s.read_if.setting.empty() ? ""
                                                            : fmt::format("; read only if {} is {}", s.read_if.setting,
                                                                          fmt::join(s.read_if.choices, " or "));
    out += fmt::format("# {}{}: {}{}\n", s.description, unit, accepted(s), condition);
    // What the example sweeps may not stand here too.
    const bool swept = experiment.example().find(fmt::format("\n{} = [", s.name)) != std::string_view::npos;
    out += fmt::format("{}{} = {}\n", swept ? "# " : "", s.name, to_toml(s.standard));
  });
  out +=
      "\n# Axes to sweep, crossed: any setting above that you take out there. Values as a list or as a range\n"
      "# { from = 0.1, to = 0.5, step = 0.1 }. zip = [[\"a\", \"b\"]] moves axes together, exclude = [{ a = 1, b = 2 "
      "}]\n# leaves cells out.";
  if (offered<SolverChoice>(experiment) != nullptr) {
    out +=
        " Methods are compared on the same trials; each may set any key of [solver] that its solver\n"
        "# reads for itself, and is called after its solver unless it has a name. Differences to the first method are "
        "taken\n# trial by trial; [[compare]] method = \"a\" with = \"b\" chooses other pairs.";
  }
  out += " Figures: ridgeloc plot FILE.h5\n";
  out += experiment.example();
  return out;
}

}  // namespace ridgeloc::studies
