#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>

#include "results/figures/figure_names.hpp"
#include "results/schema/text.hpp"
#include "studies/files/sections.hpp"
#include "studies/files/toml_document.hpp"
#include "studies/study/capabilities.hpp"
#include "studies/study/comparison.hpp"

namespace ridgeloc::studies {

namespace {

/// { points = 3, range_sigma_m = [0.1, 0.3] }: values of swept axes.
results::AxisValues read_where(const toml::node& node, const Study& study) {
  const toml::table& table = read_table(node, "figure.where");
  std::vector<std::string> axes;
  for (const SweepAxis& axis : study.sweep) axes.push_back(axis.setting->name);
  check_keys(table, "figure.where", axes);
  results::AxisValues where;
  for (const auto& [key, value] : table) {
    const std::string name(key.str());
    const std::string label = "figure.where." + name;
    const auto axis = std::ranges::find(study.sweep, name, [](const SweepAxis& a) { return a.setting->name; });
    const auto add = [&](const toml::node& one) {
      const Value read = read_setting(one, *axis->setting, label);
      if (std::ranges::find(axis->values, read) == axis->values.end())
        fail_at(one, fmt::format("{} is not among the values of that axis", label));
      where[name].push_back(results::factor_text(factor_value(read)));
    };
    const toml::array* list = value.as_array();
    // An interval is an array itself.
    const bool is_one_interval =
        list != nullptr && axis->setting->kind == Kind::Range && !list->empty() && !list->front().is_array();
    if (list == nullptr || is_one_interval) {
      add(value);
      continue;
    }
    if (list->empty()) fail_at(value, fmt::format("{} is an empty list", label));
    for (const toml::node& one : *list) add(one);
  }
  return where;
}

/// A distribution is that of one metric, over the values of the metric itself.
void check_distribution(const toml::table& table, const results::FigureSpec& figure, const Experiment& experiment) {
  for (const char* key : {"x", "statistic", "bounds"}) {
    if (const toml::node* node = table.get(key))
      fail_at(*node, fmt::format("figure.{} does not go with kind = \"{}\", which shows all values", key, figure.kind));
  }
  const auto& metrics = experiment.schema().metrics;
  const auto metric = std::ranges::find(metrics, figure.y.front(), &results::MetricInfo::name);
  if (figure.y.size() > 1 || metric == metrics.end() || metric->yes_no)
    fail_at(*table.get("y"), fmt::format("kind = \"{}\" takes one metric as y, none that is yes or no", figure.kind));
}

/// What figures may be called, made of any text: letters of every alphabet, digits, '-', '_' and '.', other bytes
/// replaced, and no '.' in front, which would hide the file.
std::string file_name(const std::string& text) {
  std::string name = text.substr(std::min(text.find_first_not_of('.'), text.size()));
  const auto allowed = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.' || c >= 0x80;
  };
  std::ranges::replace_if(name, std::not_fn(allowed), '-');
  return name.empty() ? "figure" : name;
}

results::FigureSpec read_figure(const toml::table& table, const Study& study, std::size_t number) {
  check_keys(table, "[[figure]]",
             {"name", "title", "kind", "x", "y", "statistic", "group", "facet", "methods", "where", "log_y", "bounds"});
  std::vector<std::string> axes;
  for (const SweepAxis& axis : study.sweep) axes.push_back(axis.setting->name);
  std::vector<std::string> groups = axes;
  groups.emplace_back("method");
  std::vector<std::string> quantities;
  for (const auto& metric : study.experiment->schema().metrics) quantities.push_back(metric.name);
  for (const auto& event : study.experiment->schema().events) quantities.push_back(event.name);
  std::vector<std::string> labels = label_names(*study.experiment);
  for (const Method& method : study.methods) labels.push_back(method.label);
  for (const Comparison& comparison : study.comparisons) {
    labels.push_back(label_of(comparison));
    labels.push_back(ratio_label_of(comparison));
  }

  const auto required = [&](const char* key, const char* what) -> const toml::node& {
    const toml::node* node = table.get(key);
    if (node == nullptr) fail_at(table, fmt::format("[[figure]] lacks {}: {}", key, what));
    return *node;
  };
  results::FigureSpec figure;
  const toml::node* name = table.get("name");
  figure.name = name != nullptr ? read_text(*name, "figure.name")
                : number == 1   ? file_name(study.name)
                                : fmt::format("{}-{}", file_name(study.name), number);
  if (figure.name != file_name(figure.name)) {
    fail_at(*name, fmt::format("figure name \"{}\" is not allowed: letters, digits, '-', '_' and '.'", figure.name));
  }
  const auto taken = std::ranges::find(study.figures, figure.name, &results::FigureSpec::name);
  if (taken != study.figures.end()) fail_at(table, fmt::format("two figures are called \"{}\"", figure.name));

  if (const toml::node* node = table.get("kind"))
    figure.kind = read_text(*node, "figure.kind", {"curve", "ecdf", "histogram"});
  if (figure.kind == "curve") {
    if (axes.empty()) fail_at(table, "[[figure]] needs a swept axis for x; add a [sweep]");
    figure.x = read_text(required("x", "a swept axis"), "figure.x", axes);
  }
  figure.y = read_texts(required("y", "a metric, or a list of them"), "figure.y", quantities);
  if (figure.kind != "curve") check_distribution(table, figure, *study.experiment);
  if (const toml::node* node = table.get("title")) figure.title = read_text(*node, "figure.title");
  if (const toml::node* node = table.get("statistic")) {
    figure.statistic = read_text(*node, "figure.statistic", results::figure_statistics());
  }
  if (const toml::node* node = table.get("group")) figure.group = read_texts(*node, "figure.group", groups);
  if (const toml::node* node = table.get("facet")) figure.facet = read_text(*node, "figure.facet", groups);
  if (const toml::node* node = table.get("methods")) figure.methods = read_texts(*node, "figure.methods", labels);
  if (const toml::node* node = table.get("where")) figure.where = read_where(*node, study);
  if (const toml::node* node = table.get("log_y")) figure.log_y = read_bool(*node, "figure.log_y");
  if (const toml::node* node = table.get("bounds")) figure.bounds = read_bool(*node, "figure.bounds");
  return figure;
}

}  // namespace

void read_figures(const toml::table& document, Study& study) {
  const toml::node* node = document.get("figure");
  if (node == nullptr) return;
  for (const toml::table* table : read_tables(*node, "figure")) {
    study.figures.push_back(read_figure(*table, study, study.figures.size() + 1));
  }
}

}  // namespace ridgeloc::studies
