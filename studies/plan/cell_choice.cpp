#include "studies/plan/cell_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "core/error.hpp"
#include "results/schema/axis_values.hpp"

namespace ridgeloc::studies {

namespace {

[[noreturn]] void fail(std::string_view text, const std::string& reason) {
  throw core::InputError(fmt::format("--cell {}: {}", text, reason));
}

std::optional<std::uint64_t> number_in(std::string_view text) {
  std::uint64_t value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// A value as users write it on the command line: texts without quotes.
std::string plain(const Value& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* real = std::get_if<double>(&value)) return fmt::format("{}", *real);
  return to_toml(value);
}

bool is_value(std::string_view text, const Value& value) {
  return results::is_written_as(factor_value(value), text) || text == to_toml(value);
}

std::vector<std::string> axis_names(const Study& study) {
  std::vector<std::string> names;
  for (const SweepAxis& axis : study.sweep) names.push_back(axis.setting->name);
  return names;
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates) {
  const std::string nearest = nearest_name(name, candidates);
  return nearest.empty() ? "" : fmt::format(", did you mean \"{}\"?", nearest);
}

/// The index of the axis, and that of its value, that "name=value" names.
struct Choice {
  std::size_t axis;
  std::size_t value;
};
Choice choice(const Study& study, std::string_view text, std::string_view item) {
  const std::size_t equals = item.find('=');
  if (equals == std::string_view::npos) {
    fail(text, fmt::format("\"{}\" is neither the number of a cell nor AXIS=VALUE, for example points=5", item));
  }
  const std::string_view name = results::trimmed(item.substr(0, equals));
  const std::string_view value = results::trimmed(item.substr(equals + 1));
  const auto axis = std::ranges::find(study.sweep, name, [](const SweepAxis& a) { return a.setting->name; });
  if (axis == study.sweep.end()) {
    const auto names = axis_names(study);
    const std::string allowed =
        names.empty() ? "the study sweeps nothing" : fmt::format("swept are: {}", fmt::join(names, ", "));
    fail(text, fmt::format("\"{}\" is no axis of the sweep{} ({})", name, did_you_mean(name, names), allowed));
  }
  const auto found = std::ranges::find_if(axis->values, [&](const Value& v) { return is_value(value, v); });
  if (found == axis->values.end()) {
    std::vector<std::string> values;
    for (const Value& v : axis->values) values.push_back(plain(v));
    const bool is_text = std::holds_alternative<std::string>(axis->values.front());
    fail(text, fmt::format("{} = {} is not in the sweep{} (allowed: {})", name, value,
                           is_text ? did_you_mean(value, values) : "", fmt::join(values, ", ")));
  }
  return {static_cast<std::size_t>(axis - study.sweep.begin()), static_cast<std::size_t>(found - axis->values.begin())};
}

}  // namespace

const Cell& choose_cell(const Study& study, const Plan& plan, std::string_view text) {
  if (const auto number = number_in(results::trimmed(text))) {
    if (*number < plan.cells.size()) return plan.cells[*number];
    fail(text, fmt::format("there is no such cell (allowed: 0 to {})", plan.cells.size() - 1));
  }
  std::vector<Choice> choices;
  if (!results::trimmed(text).empty()) {
    for (const std::string_view item : results::list_items(text)) choices.push_back(choice(study, text, item));
  }
  const Cell* chosen = nullptr;
  std::size_t count = 0;
  for (const Cell& cell : plan.cells) {
    if (!std::ranges::all_of(choices, [&](const Choice& c) { return cell.indices[c.axis] == c.value; })) continue;
    chosen = &cell;
    ++count;
  }
  if (count == 0) fail(text, "no cell of the sweep has all of these values");
  if (count == 1) return *chosen;
  std::vector<std::string> missing;
  for (std::size_t a = 0; a < study.sweep.size(); ++a) {
    const bool given = std::ranges::any_of(choices, [&](const Choice& c) { return c.axis == a; });
    if (!given && study.sweep[a].values.size() > 1) missing.push_back(study.sweep[a].setting->name + "=...");
  }
  const std::string more = fmt::format("{}", fmt::join(missing, ","));
  if (choices.empty()) {
    throw core::InputError(fmt::format("the sweep has {} cells; choose one with --cell {}", count, more));
  }
  fail(text, fmt::format("{} cells of the sweep are like this; add {}", count, more));
}

}  // namespace ridgeloc::studies
