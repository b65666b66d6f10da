#include "results/schema/axis_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "core/error.hpp"
#include "results/schema/text.hpp"

namespace ridgeloc::results {

std::optional<double> number_in(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

namespace {

bool is_interval(std::string_view text) {
  return text.size() > 2 && text.front() == '[' && text.back() == ']';
}

bool mean_the_same(std::string_view a, std::string_view b) {
  if (is_interval(a) && is_interval(b)) {
    return std::ranges::equal(list_items(a.substr(1, a.size() - 2)), list_items(b.substr(1, b.size() - 2)),
                              mean_the_same);
  }
  const auto number = number_in(a);
  return a == b || (number && number == number_in(b));
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> list_items(std::string_view text) {
  std::vector<std::string_view> items;
  int depth = 0;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '[' || text[i] == '(') ++depth;
    if (text[i] == ']' || text[i] == ')') --depth;
    if (text[i] != ',' || depth > 0) continue;
    items.push_back(trimmed(text.substr(begin, i - begin)));
    begin = i + 1;
  }
  items.push_back(trimmed(text.substr(begin)));
  return items;
}

void add_axis_values(AxisValues& chosen, std::string_view text) {
  const std::size_t equals = std::min(text.find('='), text.size());
  const std::string_view axis = trimmed(text.substr(0, equals));
  const auto values = list_items(text.substr(std::min(equals + 1, text.size())));
  if (axis.empty() || std::ranges::find(values, "") != values.end()) {
    throw core::InputError(
        fmt::format("where \"{}\": write it as AXIS=VALUE,..., for example range_sigma_m=0.1,0.3", text));
  }
  std::vector<std::string>& list = chosen[std::string(axis)];
  list.insert(list.end(), values.begin(), values.end());
}

std::vector<std::string> axis_values_texts(const AxisValues& chosen) {
  std::vector<std::string> texts;
  for (const auto& [axis, values] : chosen) texts.push_back(fmt::format("{}={}", axis, fmt::join(values, ",")));
  return texts;
}

bool is_written_as(const FactorValue& value, std::string_view text) {
  return mean_the_same(factor_text(value), text);
}

}  // namespace ridgeloc::results
