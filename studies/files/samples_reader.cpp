#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "studies/files/toml_document.hpp"

namespace ridgeloc::studies {

namespace {

/// Fewer are no distribution; more would make the resolved study, which holds them all, larger than a few MiB.
constexpr std::size_t fewest_samples = 2;
constexpr std::size_t most_samples = 100'000;
/// Below this root mean square, samples are zeros.
constexpr double smallest_rms = 1e-12;

std::vector<double> listed(const toml::array& list, const std::string& label) {
  std::vector<double> values;
  for (const toml::node& element : list) {
    if (!element.is_number()) fail_at(element, fmt::format("{}[{}] is not a number", label, values.size()));
    values.push_back(*element.value<double>());
  }
  return values;
}

std::vector<double> samples_in_file(const toml::table& table, const std::string& label) {
  check_keys(table, label, {"file", "column"});
  const toml::node* node = table.get("column");
  if (node == nullptr) fail_at(table, fmt::format("{} lacks column; give {{ file = ..., column = ... }}", label));
  const std::string column = read_text(*node, fmt::format("{}.column", label));
  return std::move(read_columns_of(table, label, {column}, most_samples + 1).front());
}

}  // namespace

Samples read_samples(const toml::node& node, const Setting& setting, const std::string& label) {
  const toml::array* list = node.as_array();
  const toml::table* table = node.as_table();
  if (list == nullptr && table == nullptr) {
    fail_at(node, fmt::format("{} = {} is not allowed: {} takes {}", label, text_of(node), label, accepted(setting)));
  }
  std::vector<double> values = list != nullptr ? listed(*list, label) : samples_in_file(*table, label);
  if (list != nullptr && values.empty()) return {};
  if (values.size() < fewest_samples || values.size() > most_samples) {
    fail_at(node, values.size() < fewest_samples
                      ? fmt::format("{}: too few samples, {}; give {} at least", label, values.size(), fewest_samples)
                      : fmt::format("{}: at most {} samples are allowed", label, most_samples));
  }
  for (const double value : values) {
    if (setting.low <= value && value <= setting.high) continue;
    fail_at(node, fmt::format("{}: {} is not allowed: samples are numbers from {} to {}", label, value, setting.low,
                              setting.high));
  }
  Samples samples(std::move(values));
  if (samples.rms() < smallest_rms) fail_at(node, fmt::format("{}: the samples are all zero", label));
  return samples;
}

}  // namespace ridgeloc::studies
