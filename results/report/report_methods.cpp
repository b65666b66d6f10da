#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "results/report/html.hpp"
#include "results/report/report_part.hpp"

namespace ridgeloc::results {
namespace {

using Kind = HtmlTable::Kind;
using Settings = std::vector<std::pair<std::string, std::string>>;  ///< names and values, in order

/// The settings of a method as its description writes them: name = value, ...; values may have commas in quotes and
/// brackets. Empty for what is no solver.
Settings settings_of(std::string_view description) {
  Settings settings;
  std::string name;
  std::string text;
  int depth = 0;
  bool in_quotes = false;
  const auto finish = [&] {
    if (!name.empty()) settings.emplace_back(name, text);
    name.clear();
    text.clear();
  };
  for (std::size_t i = 0; i < description.size(); ++i) {
    const char c = description[i];
    if (in_quotes && c == '\\' && i + 1 < description.size()) {
      text += c;
      text += description[++i];
      continue;
    }
    if (c == '"') in_quotes = !in_quotes;
    if (!in_quotes && (c == '[' || c == '{')) ++depth;
    if (!in_quotes && (c == ']' || c == '}')) --depth;
    const bool outside = !in_quotes && depth == 0;
    if (outside && name.empty() && description.substr(i).starts_with(" = ")) {
      name = std::exchange(text, "");
      i += 2;
    } else if (outside && description.substr(i).starts_with(", ")) {
      finish();
      ++i;
    } else {
      text += c;
    }
  }
  finish();
  return settings;
}

/// Names of the settings in which two methods that read them differ, in the order in which they are read.
std::vector<std::string> differing(const std::vector<Settings>& methods) {
  std::vector<std::string> names;
  std::map<std::string, std::string> first;
  std::map<std::string, bool> differs;
  for (const Settings& settings : methods) {
    for (const auto& [name, value] : settings) {
      const auto [entry, is_new] = first.try_emplace(name, value);
      if (is_new) names.push_back(name);
      differs[name] = differs[name] || entry->second != value;
    }
  }
  std::erase_if(names, [&](const std::string& name) { return !differs[name]; });
  return names;
}

}  // namespace

std::string report_methods(const Header& header) {
  std::vector<Settings> settings;
  std::vector<std::string> labels;
  for (const MethodInfo& method : header.methods) {
    Settings own = settings_of(method.description);
    if (method.difference || own.empty()) continue;
    settings.push_back(std::move(own));
    labels.push_back(method.label);
  }
  std::string html;
  if (const std::vector<std::string> names = differing(settings); !names.empty()) {
    std::vector<HtmlTable::Column> columns = {{"method", Kind::Head}};
    for (const std::string& name : names) columns.push_back({name});
    HtmlTable table("Settings in which methods differ; - where a method does not read one", columns);
    for (std::size_t m = 0; m < settings.size(); ++m) {
      std::vector<HtmlCell> cells = {text_cell(labels[m])};
      for (const std::string& name : names) {
        const auto found = std::ranges::find(settings[m], name, &Settings::value_type::first);
        cells.push_back(text_cell(found == settings[m].end() ? "-" : found->second));
      }
      table.add(cells);
    }
    html = table.html();
  }
  HtmlTable all("Methods and all settings that they read", {{"method", Kind::Head}, {"settings"}});
  for (const MethodInfo& method : header.methods) all.add({text_cell(method.label), text_cell(method.description)});
  return html + html_details("All settings", html.empty(), all.html());
}

}  // namespace ridgeloc::results
