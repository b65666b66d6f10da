#include <fmt/format.h>

#include <array>
#include <string>
#include <vector>

#include "studies/files/toml_document.hpp"

namespace ridgeloc::studies {

namespace {

/// More would make the resolved study, which holds them all, larger than a few MiB.
constexpr std::size_t most_positions = 100'000;

using Place = std::array<double, 3>;

/// [x, y, z], or [x, y] at z = 0.
Place place_of_list(const toml::node& node, const std::string& label) {
  const toml::array* list = node.as_array();
  if (list == nullptr || list->size() < 2 || list->size() > 3)
    fail_at(node, fmt::format("{} = {} is no position: give [x, y, z], or [x, y] at z = 0", label, text_of(node)));
  Place place{};
  for (std::size_t axis = 0; axis < list->size(); ++axis) {
    const toml::node& number = (*list)[axis];
    if (!number.is_number()) fail_at(node, fmt::format("{}[{}] = {} is not a number", label, axis, text_of(number)));
    place[axis] = *number.value<double>();
  }
  return place;
}

std::vector<Place> places_in_file(const toml::table& table, const std::string& label) {
  check_keys(table, label, {"file", "columns"});
  std::vector<std::string> columns = {"x_m", "y_m", "z_m"};
  if (const toml::node* node = table.get("columns")) {
    const std::string own = fmt::format("{}.columns", label);
    columns = read_texts(*node, own, {});
    if (columns.size() < 2 || columns.size() > 3)
      fail_at(*node, fmt::format("{} names {}: give two or three, of x, y and z (without z they lie at z = 0)", own,
                                 columns.size()));
  }
  const auto read = read_columns_of(table, label, columns, most_positions + 1);
  std::vector<Place> places(read.front().size(), Place{});
  for (std::size_t axis = 0; axis < read.size(); ++axis)
    for (std::size_t i = 0; i < places.size(); ++i) places[i][axis] = read[axis][i];
  return places;
}

}  // namespace

Positions read_positions(const toml::node& node, const Setting& setting, const std::string& label) {
  const toml::array* list = node.as_array();
  const toml::table* table = node.as_table();
  if (list == nullptr && table == nullptr)
    fail_at(node, fmt::format("{} = {} is not allowed: {} takes {}", label, text_of(node), label, accepted(setting)));
  std::vector<Place> places;
  if (list != nullptr) {
    for (const toml::node& element : *list)
      places.push_back(place_of_list(element, fmt::format("{}[{}]", label, places.size())));
  } else {
    places = places_in_file(*table, label);
    if (places.empty()) fail_at(node, fmt::format("{}: the file has no row", label));
  }
  if (places.size() > most_positions)
    fail_at(node, fmt::format("{}: at most {} positions are allowed", label, most_positions));
  for (const Place& place : places) {
    for (const double coordinate : place) {
      if (setting.low <= coordinate && coordinate <= setting.high) continue;
      fail_at(node, fmt::format("{}: {} is not allowed: coordinates are numbers from {} to {} m; subtract an origin "
                                "that is nearer",
                                label, coordinate, setting.low, setting.high));
    }
  }
  return Positions(places);
}

}  // namespace ridgeloc::studies
