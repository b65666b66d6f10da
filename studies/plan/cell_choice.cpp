#include "studies/plan/cell_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "core/error.hpp"
#include "results/schema/axis_values.hpp"
#include "results/schema/text.hpp"

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

bool is_text(const results::FactorValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  return text != nullptr && !text->starts_with('[');
}

/// As a command line or a study file has it: texts with quotes too.
bool is_value(std::string_view text, const results::FactorValue& value) {
  return results::is_written_as(value, text) || (is_text(value) && text == to_toml(std::get<std::string>(value)));
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
Choice choice(const results::Header& header, std::string_view text, std::string_view item) {
  const std::size_t equals = item.find('=');
  if (equals == std::string_view::npos) {
    fail(text, fmt::format("\"{}\" is neither the number of a cell nor AXIS=VALUE, for example points=5", item));
  }
  const std::string_view name = results::trimmed(item.substr(0, equals));
  const std::string_view value = results::trimmed(item.substr(equals + 1));
  const auto axis = std::ranges::find(header.axes, name, &results::Axis::name);
  if (axis == header.axes.end()) {
    std::vector<std::string> names;
    for (const results::Axis& swept : header.axes) names.push_back(swept.name);
    const std::string allowed =
        names.empty() ? "the study sweeps nothing" : fmt::format("swept are: {}", fmt::join(names, ", "));
    fail(text, fmt::format("\"{}\" is no axis of the sweep{} ({})", name, did_you_mean(name, names), allowed));
  }
  const auto found = std::ranges::find_if(axis->values, [&](const auto& v) { return is_value(value, v); });
  if (found == axis->values.end()) {
    std::vector<std::string> values;
    for (const results::FactorValue& v : axis->values) values.push_back(results::factor_text(v));
    fail(text, fmt::format("{} = {} is not in the sweep{} (allowed: {})", name, value,
                           is_text(axis->values.front()) ? did_you_mean(value, values) : "", fmt::join(values, ", ")));
  }
  return {static_cast<std::size_t>(axis - header.axes.begin()), static_cast<std::size_t>(found - axis->values.begin())};
}

std::vector<Choice> choices_in(const results::Header& header, std::string_view text) {
  std::vector<Choice> choices;
  if (results::trimmed(text).empty()) return choices;
  for (const std::string_view item : results::list_items(text)) choices.push_back(choice(header, text, item));
  return choices;
}

}  // namespace

std::vector<std::size_t> choose_cells(const results::Header& header, std::string_view text) {
  if (const auto number = number_in(results::trimmed(text))) {
    if (*number < header.cells.size()) return {static_cast<std::size_t>(*number)};
    fail(text, fmt::format("there is no such cell (allowed: 0 to {})", header.cells.size() - 1));
  }
  const std::vector<Choice> choices = choices_in(header, text);
  std::vector<std::size_t> cells;
  for (std::size_t cell = 0; cell < header.cells.size(); ++cell) {
    const auto matches = [&](const Choice& c) { return header.cells[cell].indices[c.axis] == c.value; };
    if (std::ranges::all_of(choices, matches)) cells.push_back(cell);
  }
  if (cells.empty()) fail(text, "no cell of the sweep has all of these values");
  return cells;
}

Cell choose_cell(const Plan& plan, std::string_view text) {
  const results::Header& header = plan.header;
  const std::vector<std::size_t> cells = choose_cells(header, text);
  if (cells.size() == 1) return plan.cells[cells.front()];
  const std::vector<Choice> choices = choices_in(header, text);
  std::vector<std::string> missing;
  for (std::size_t a = 0; a < header.axes.size(); ++a) {
    const bool given = std::ranges::any_of(choices, [&](const Choice& c) { return c.axis == a; });
    if (!given && header.axes[a].values.size() > 1) missing.push_back(header.axes[a].name + "=...");
  }
  const std::string more = fmt::format("{}", fmt::join(missing, ","));
  if (choices.empty()) {
    throw core::InputError(fmt::format("the sweep has {} cells; choose one with --cell {}", cells.size(), more));
  }
  fail(text, fmt::format("{} cells of the sweep are like this; add {}", cells.size(), more));
}

}  // namespace ridgeloc::studies
