#include "studies/study/value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/edit_distance.hpp"

namespace ridgeloc::studies {

namespace {

std::string number_text(double value) {
  std::string text = fmt::format("{}", value);
  const bool looks_real = text.find_first_of(".en") != std::string::npos;
  return looks_real ? text : text + ".0";
}

std::string toml_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      out += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string pair_text(const std::array<double, 2>& pair) {
  return fmt::format("[{}, {}]", number_text(pair[0]), number_text(pair[1]));
}

/// "key = [{...}, {...}], ", one table for each element.
template <class Element, class F>
std::string tables(const char* key, const std::vector<Element>& elements, F&& text) {
  std::string list;
  for (const Element& element : elements) list += (list.empty() ? "{ " : ", { ") + text(element) + " }";
  return elements.empty() ? "" : fmt::format(", {} = [{}]", key, list);
}

/// An inline table, what a file with the map holds.
std::string inline_table(const sim::BuildingMap& map) {
  const auto rectangle = [](const sim::Rectangle& r) {
    return fmt::format("name = {}, x_m = {}, y_m = {}", toml_string(r.name), pair_text(r.x_m), pair_text(r.y_m));
  };
  const auto wall = [](const sim::Wall& w) {
    return fmt::format("from_m = {}, to_m = {}", pair_text(w.from_m), pair_text(w.to_m));
  };
  const auto object_class = [](const sim::ObjectClass& c) {
    return fmt::format("name = {}, width_m = {}, height_m = {}{}", toml_string(c.name), number_text(c.width_m),
                       number_text(c.height_m), c.recall ? ", recall = " + pair_text(*c.recall) : "");
  };
  const auto object = [&map](const sim::MapObject& o) {
    return fmt::format("name = {}, class = {}, at_m = [{}, {}, {}], width_m = {}, height_m = {}", toml_string(o.name),
                       toml_string(map.classes[o.object_class].name), number_text(o.centre_m[0]),
                       number_text(o.centre_m[1]), number_text(o.centre_m[2]), number_text(o.width_m),
                       number_text(o.height_m));
  };
  return fmt::format("{{ name = {}{}{}{}{}{} }}", toml_string(map.name), tables("area", map.areas, rectangle),
                     tables("opening", map.openings, rectangle), tables("wall", map.walls, wall),
                     tables("class", map.classes, object_class), tables("object", map.objects, object));
}

}  // namespace

Building::Building(sim::BuildingMap map, std::string builtin)
    : map_(std::make_shared<const sim::BuildingMap>(std::move(map))), builtin_(std::move(builtin)) {}

Samples::Samples(std::vector<double> values) : values_(std::make_shared<const std::vector<double>>(std::move(values))) {
  double squares = 0.0;
  for (const double value : *values_) squares += value * value;
  if (!values_->empty()) rms_ = std::sqrt(squares / static_cast<double>(values_->size()));
}

bool Samples::operator==(const Samples& other) const {
  return std::ranges::equal(values(), other.values());
}

Positions::Positions(const std::vector<std::array<double, 3>>& places) {
  if (places.empty()) return;
  std::array<std::vector<double>, 3> columns;
  for (const auto& place : places)
    for (std::size_t axis = 0; axis < columns.size(); ++axis) columns[axis].push_back(place[axis]);
  columns_ = std::make_shared<const std::array<std::vector<double>, 3>>(std::move(columns));
}

bool Positions::operator==(const Positions& other) const {
  if (columns_ == other.columns_) return true;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!std::ranges::equal(column(axis), other.column(axis))) return false;
  return true;
}

std::string to_toml(const Value& value) {
  struct Writer {
    std::string operator()(std::int64_t v) const { return fmt::format("{}", v); }
    std::string operator()(double v) const { return number_text(v); }
    std::string operator()(const std::string& v) const { return toml_string(v); }
    std::string operator()(const Samples& v) const {
      std::string text = "[";
      for (const double sample : v.values()) text += (text.size() > 1 ? ", " : "") + number_text(sample);
      return text + "]";
    }
    std::string operator()(const Positions& v) const {
      std::string text = "[";
      for (std::size_t i = 0; i < v.size(); ++i) {
        const auto [x, y, z] = v[i];
        text += fmt::format("{}[{}, {}, {}]", i > 0 ? ", " : "", number_text(x), number_text(y), number_text(z));
      }
      return text + "]";
    }
    std::string operator()(const Interval& v) const { return pair_text(v); }
    std::string operator()(const Building& v) const {
      return v.builtin().empty() ? inline_table(v.map()) : toml_string(v.builtin());
    }
  };
  return std::visit(Writer{}, value);
}

results::FactorValue factor_value(const Value& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return *integer;
  if (const auto* real = std::get_if<double>(&value)) return *real;
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  return to_toml(value);
}

std::string accepted(const Setting& s) {
  switch (s.kind) {
    case Kind::Real:
      return fmt::format("a number from {} to {}", s.low, s.high);
    case Kind::Integer:
      return fmt::format("a whole number from {} to {}", s.low, s.high);
    case Kind::Choice:
      return fmt::format("one of: {}", fmt::join(s.choices, ", "));
    case Kind::Text:
      return "a text";
    case Kind::Range:
      return fmt::format("two numbers [low, high], low <= high, from {} to {}", s.low, s.high);
    case Kind::Samples:
      return fmt::format("a list of numbers from {} to {}, or {{ file = \"NAME.csv\", column = \"NAME\" }}", s.low,
                         s.high);
    case Kind::Positions:
      return fmt::format(
          "a list of positions [x, y, z], or [x, y] at z = 0, of numbers from {} to {}, or {{ file = "
          "\"NAME.csv\" }} with columns x_m, y_m, z_m",
          s.low, s.high);
    case Kind::Building:
      return "the name of a map, { file = \"NAME.toml\" }, or { random = SEED, wings = N, objects = N }";
  }
  return {};
}

std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(2, name.size() / 2) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t d = core::edit_distance(name, candidate);
    if (d < best_distance) {
      best = candidate;
      best_distance = d;
    }
  }
  return best;
}

}  // namespace ridgeloc::studies
