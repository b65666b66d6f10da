#include "studies/files/map_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "core/error.hpp"
#include "sim/random_building.hpp"
#include "studies/catalog/building_maps.hpp"
#include "studies/files/text_file.hpp"
#include "studies/files/toml_document.hpp"

namespace ridgeloc::studies {

namespace {

/// Coordinates and sizes beyond this are a mistake of units.
constexpr double farthest_m = 1e5;
constexpr double smallest_m = 1e-3;
constexpr double largest_m = 1e3;

/// More would take minutes to check and longer to look at; random maps stay below.
constexpr std::size_t most_objects = 200'000;
constexpr std::size_t most_classes = 1'000;
constexpr std::size_t most_of_others = 10'000;

std::vector<double> read_numbers(const toml::node& node, const std::string& label, std::size_t count, double low,
                                 double high) {
  const toml::array* list = node.as_array();
  std::vector<double> values;
  if (list != nullptr) {
    for (const toml::node& element : *list) {
      if (element.is_number()) values.push_back(*element.value<double>());
    }
  }
  const auto allowed = [&](double v) { return low <= v && v <= high; };
  if (list == nullptr || list->size() != count || values.size() != count || !std::ranges::all_of(values, allowed)) {
    fail_at(node, fmt::format("{} = {} is not allowed: it takes a list of {} numbers from {} to {}", label,
                              text_of(node), count, low, high));
  }
  return values;
}

double read_size(const toml::node& node, const std::string& label) {
  const auto value = node.value<double>();
  if (!node.is_number() || !(*value >= smallest_m && *value <= largest_m)) {
    fail_at(node, fmt::format("{} = {} is not allowed: it takes a number from {} to {}", label, text_of(node),
                              smallest_m, largest_m));
  }
  return *value;
}

/// One table of a map with what messages call it.
class Entry {
 public:
  Entry(const toml::table& table, const std::string& kind, std::size_t number, const std::vector<std::string>& keys)
      : table_(table), label_(fmt::format("{} {}", kind, number)) {
    check_keys(table, fmt::format("[[{}]]", kind), keys);
    if (const toml::node* node = table.get("name")) {
      name_ = read_text(*node, label_ + ".name");
      label_ = fmt::format("{} \"{}\"", kind, name_);
    }
  }

  const toml::table& table() const { return table_; }
  const std::string& label() const { return label_; }
  const std::string& name() const { return name_; }
  const toml::node* find(const char* key) const { return table_.get(key); }
  const toml::node& get(const char* key) const {
    const toml::node* node = find(key);
    if (node == nullptr) fail_at(table_, fmt::format("{} lacks {}", label_, key));
    return *node;
  }
  std::string key(const char* name) const { return fmt::format("{}: {}", label_, name); }

 private:
  const toml::table& table_;
  std::string label_;
  std::string name_;
};

class MapReader {
 public:
  explicit MapReader(const toml::table& document) : document_(document) {
    check_keys(document, "a map", {"name", "area", "opening", "wall", "class", "object"});
    if (const toml::node* node = document.get("name")) map_.name = read_text(*node, "name");
    read_areas();
    read_walls();
    read_classes();
    read_objects();
  }

  sim::BuildingMap take() { return std::move(map_); }

 private:
  std::vector<Entry> entries(const char* kind, const std::vector<std::string>& keys,
                             std::size_t most = most_of_others) const {
    std::vector<Entry> list;
    const toml::node* node = document_.get(kind);
    if (node == nullptr) return list;
    const auto tables = read_tables(*node, kind);
    if (tables.size() > most) {
      fail_at(*tables[most], fmt::format("the map has {} [[{}]]; at most {} are allowed", tables.size(), kind, most));
    }
    for (const toml::table* table : tables) list.emplace_back(*table, kind, list.size() + 1, keys);
    return list;
  }

  [[noreturn]] void fail_whole(const std::string& message) const { fail_at(document_, message); }

  static sim::Rectangle read_rectangle(const Entry& entry) {
    const auto side = [&entry](const char* key) {
      const auto v = read_numbers(entry.get(key), entry.key(key), 2, -farthest_m, farthest_m);
      if (!(v[1] - v[0] >= smallest_m)) {
        fail_at(entry.get(key),
                fmt::format("{} = [{}, {}] is not allowed: the second must be larger than the first, by {} at least",
                            entry.key(key), v[0], v[1], smallest_m));
      }
      return std::array<double, 2>{v[0], v[1]};
    };
    return {entry.name(), side("x_m"), side("y_m")};
  }

  void read_areas() {
    const std::vector<Entry> areas = entries("area", {"name", "x_m", "y_m"});
    for (const Entry& entry : areas) {
      const sim::Rectangle area = read_rectangle(entry);
      for (std::size_t i = 0; i < map_.areas.size(); ++i) {
        if (!sim::overlap(area, map_.areas[i])) continue;
        fail_at(entry.table(),
                fmt::format("{} overlaps {}; let areas touch along a border instead", entry.label(), areas[i].label()));
      }
      map_.areas.push_back(area);
    }
    if (map_.areas.empty()) fail_whole("the map has no [[area]]; give at least one corridor or room");
    for (const Entry& entry : entries("opening", {"name", "x_m", "y_m"})) {
      map_.openings.push_back(read_rectangle(entry));
    }
  }

  void read_walls() {
    for (const Entry& entry : entries("wall", {"from_m", "to_m"})) {
      const auto end = [&entry](const char* key) {
        const auto v = read_numbers(entry.get(key), entry.key(key), 2, -farthest_m, farthest_m);
        return sim::PlanPoint{v[0], v[1]};
      };
      const sim::Wall wall{end("from_m"), end("to_m")};
      if (wall.from_m == wall.to_m) fail_at(entry.table(), fmt::format("{} ends where it begins", entry.label()));
      map_.walls.push_back(wall);
    }
  }

  void read_classes() {
    for (const Entry& entry : entries("class", {"name", "width_m", "height_m", "recall"}, most_classes)) {
      sim::ObjectClass c;
      c.name = read_text(entry.get("name"), entry.key("name"));
      if (std::ranges::find(map_.classes, c.name, &sim::ObjectClass::name) != map_.classes.end()) {
        fail_at(entry.table(), fmt::format("class \"{}\" is there twice", c.name));
      }
      c.width_m = read_size(entry.get("width_m"), entry.key("width_m"));
      c.height_m = read_size(entry.get("height_m"), entry.key("height_m"));
      if (const toml::node* node = entry.find("recall")) {
        const auto v = read_numbers(*node, entry.key("recall"), 2, 0.0, 1.0);
        c.recall = {v[0], v[1]};
      }
      map_.classes.push_back(c);
    }
  }

  void read_objects() {
    std::vector<std::string> names;
    for (const sim::ObjectClass& c : map_.classes) names.push_back(c.name);
    const std::vector<Entry> list = entries("object", {"name", "class", "at_m", "width_m", "height_m"}, most_objects);
    std::set<std::string> known;
    for (const Entry& entry : list) {
      sim::MapObject object;
      const toml::node& class_node = entry.get("class");
      const std::string class_name = read_text(class_node, entry.key("class"));
      const auto found = std::ranges::find(names, class_name);
      if (found == names.end()) {
        fail_at(class_node,
                fmt::format("{}: unknown class \"{}\"{}", entry.label(), class_name, suggestion(class_name, names)));
      }
      object.object_class = static_cast<std::size_t>(found - names.begin());
      const sim::ObjectClass& c = map_.classes[object.object_class];
      object.name = entry.name().empty() ? fmt::format("{} {}", c.name, map_.objects.size() + 1) : entry.name();
      const auto at = read_numbers(entry.get("at_m"), entry.key("at_m"), 3, -farthest_m, farthest_m);
      object.centre_m = {at[0], at[1], at[2]};
      const auto size = [&entry](const char* key, double standard) {
        const toml::node* node = entry.find(key);
        return node == nullptr ? standard : read_size(*node, entry.key(key));
      };
      object.width_m = size("width_m", c.width_m);
      object.height_m = size("height_m", c.height_m);
      if (!map_.is_inside({object.centre_m[0], object.centre_m[1]})) {
        fail_at(entry.table(), fmt::format("{} at [{}, {}] lies outside of every area", entry.label(),
                                           object.centre_m[0], object.centre_m[1]));
      }
      if (!known.insert(object.name).second) {
        fail_at(entry.table(), fmt::format("object \"{}\" is there twice", object.name));
      }
      map_.objects.push_back(object);
    }
    if (map_.objects.empty()) fail_whole("the map has no [[object]]; without objects no photo shows anything");
    if (const auto found = sim::first_overlap(map_.objects)) {
      const auto [later, earlier] = *found;
      fail_at(list[later].table(),
              fmt::format("{} overlaps object \"{}\"", list[later].label(), map_.objects[earlier].name));
    }
  }

  const toml::table& document_;
  sim::BuildingMap map_;
};

Building from_file(const toml::node& node, const std::string& label) {
  const std::filesystem::path path = named_file(node, label);
  const toml::table document = parse_document(read_text_file(path, most_text_mib), path.string(), {});
  return Building(MapReader(document).take());
}

Building at_random(const toml::table& table, const std::string& label) {
  check_keys(table, label, {"random", "wings", "objects"});
  sim::RandomBuildingOptions options;
  const auto read = [&](const char* key, auto standard, std::int64_t low, std::int64_t high) {
    const toml::node* node = table.get(key);
    if (node == nullptr) return standard;
    const auto value = whole_number(*node);
    if (!value || *value < low || *value > high) {
      fail_at(*node, fmt::format("{}.{} = {} is not allowed: it takes a whole number from {} to {}", label, key,
                                 text_of(*node), low, high));
    }
    return static_cast<decltype(standard)>(*value);
  };
  options.seed = read("random", options.seed, 0, std::int64_t{1} << 62);
  options.wings = read("wings", options.wings, 1, 1000);
  options.objects = read("objects", options.objects, 1, 200);
  try {
    return Building(sim::random_building(options));
  } catch (const std::invalid_argument& error) {
    fail_at(table, fmt::format("{}.objects = {}: {}; ask for fewer", label, options.objects, error.what()));
  }
}

}  // namespace

Building read_building(const toml::node& node, const Setting& setting, const std::string& label) {
  if (node.is_string()) {
    const std::string name = *node.value<std::string>();
    if (const Building* map = find_building(name)) return *map;
    std::vector<std::string> names;
    for (const CatalogEntry& entry : building_maps()) names.emplace_back(entry.name);
    fail_at(node, fmt::format("{}: there is no map \"{}\"{}; for a file write {{ file = \"NAME.toml\" }}", label, name,
                              suggestion(name, names)));
  }
  const toml::table* table = node.as_table();
  if (table == nullptr) {
    fail_at(node, fmt::format("{} = {} is not allowed: {} takes {}", label, text_of(node), label, accepted(setting)));
  }
  if (const toml::node* file = table->get("file")) {
    check_keys(*table, label, {"file"});
    return from_file(*file, label);
  }
  if (table->contains("random")) return at_random(*table, label);
  return Building(MapReader(*table).take());
}

const Building* find_building(std::string_view name) {
  static const std::vector<Building> maps = [] {
    std::vector<Building> list;
    for (const CatalogEntry& entry : building_maps()) {
      const std::string builtin(entry.name);
      list.emplace_back(MapReader(parse_document(entry.text, builtin, {})).take(), builtin);
    }
    return list;
  }();
  const auto found = std::ranges::find(maps, name, &Building::builtin);
  return found == maps.end() ? nullptr : &*found;
}

}  // namespace ridgeloc::studies
