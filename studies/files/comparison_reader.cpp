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
  return pair;
}

}  // namespace

void read_comparisons(const toml::table& document, Study& study) {
  const toml::node* node = document.get("compare");
  if (node == nullptr) {
    for (std::size_t m = 1; m < study.methods.size(); ++m)
      study.comparisons.push_back({study.methods[m].label, study.methods[0].label});
  } else {
    for (const toml::table* table : read_tables(*node, "compare"))
      study.comparisons.push_back(read_comparison(*table, study));
  }
  const auto clash = named_like_a_method(study);
  if (!clash) return;
  const toml::array& methods = *document.get("method")->as_array();
  const auto method = std::ranges::find(study.methods, label_of(*clash), &Method::label);
  fail_at(methods[static_cast<std::size_t>(method - study.methods.begin())],
          fmt::format("the name \"{0}\" of this [[method]] is that of the comparison of \"{1}\" with \"{2}\"; choose "
                      "another name, or other comparisons ([[compare]]; compare = [] for none)",
                      label_of(*clash), (*clash)[0], (*clash)[1]));
}

}  // namespace ridgeloc::studies
