#include <fmt/format.h>

#include <algorithm>

#include "studies/files/sections.hpp"
#include "studies/files/toml_document.hpp"
#include "studies/study/comparison.hpp"

namespace ridgeloc::studies {

namespace {

Comparison read_comparison(const toml::table& table, const Study& study) {
  check_keys(table, "[[compare]]", {"method", "with"});
  std::vector<std::string> labels;
  for (const Method& method : study.methods) labels.push_back(method.label);
  Comparison pair;
  for (std::size_t i = 0; i < pair.size(); ++i) {
    const char* key = i == 0 ? "method" : "with";
    const toml::node* node = table.get(key);
    if (node == nullptr) fail_at(table, fmt::format("[[compare]] lacks {} = \"...\", the name of a [[method]]", key));
    pair[i] = read_text(*node, fmt::format("compare.{}", key), labels);
  }
  if (pair[0] == pair[1]) fail_at(table, fmt::format("[[compare]] compares \"{}\" with itself", pair[0]));
  if (std::ranges::find(study.comparisons, pair) != study.comparisons.end()) {
    fail_at(table, fmt::format("\"{}\" is compared with \"{}\" twice", pair[0], pair[1]));
  }
  if (std::ranges::find(labels, label_of(pair)) != labels.end()) {
    fail_at(table, fmt::format("the comparison \"{}\" and a [[method]] have the same name", label_of(pair)));
  }
  return pair;
}

}  // namespace

void read_comparisons(const toml::table& document, Study& study) {
  const toml::node* node = document.get("compare");
  if (node == nullptr) {
    for (std::size_t m = 1; m < study.methods.size(); ++m)
      study.comparisons.push_back({study.methods[m].label, study.methods[0].label});
    return;
  }
  for (const toml::table* table : read_tables(*node, "compare"))
    study.comparisons.push_back(read_comparison(*table, study));
}

}  // namespace ridgeloc::studies
