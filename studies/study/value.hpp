#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "results/schema/schema.hpp"
#include "sim/building_map.hpp"

namespace ridgeloc::studies {

/// A closed interval [low, high].
using Interval = std::array<double, 2>;

/// Numbers to draw from. Copies share them: every cell of a study has one.
class Samples {
 public:
  Samples() = default;
  explicit Samples(std::vector<double> values);

  std::span<const double> values() const {
    return values_ == nullptr ? std::span<const double>() : std::span<const double>(*values_);
  }
  double rms() const { return rms_; }  ///< root mean square, 0 of none
  bool operator==(const Samples& other) const;

 private:
  std::shared_ptr<const std::vector<double>> values_;
  double rms_ = 0.0;
};

/// Positions in the frame of a map (m). Copies share them.
class Positions {
 public:
  Positions() = default;
  explicit Positions(const std::vector<std::array<double, 3>>& places);

  std::size_t size() const { return column(0).size(); }
  std::array<double, 3> operator[](std::size_t i) const { return {column(0)[i], column(1)[i], column(2)[i]}; }
  /// Coordinate `axis` (0 = x, 1 = y, 2 = z) of all of them.
  std::span<const double> column(std::size_t axis) const {
    return columns_ == nullptr ? std::span<const double>() : std::span<const double>((*columns_)[axis]);
  }
  bool operator==(const Positions& other) const;

 private:
  std::shared_ptr<const std::array<std::vector<double>, 3>> columns_;
};

/// A map of a building. Copies share it.
class Building {
 public:
  /// `builtin`: what the map is called where it comes with the program, and written as; others are written in full.
  explicit Building(sim::BuildingMap map, std::string builtin = {});

  const sim::BuildingMap& map() const { return *map_; }
  const std::string& builtin() const { return builtin_; }
  bool operator==(const Building& other) const { return map_ == other.map_ || map() == other.map(); }

 private:
  std::shared_ptr<const sim::BuildingMap> map_;
  std::string builtin_;
};

/// The value of a setting.
using Value = std::variant<std::int64_t, double, std::string, Interval, Samples, Positions, Building>;

/// Values by name of setting.
using Values = std::map<std::string, Value, std::less<>>;

/// A value as it is written in a study file; equal values have equal texts and different ones different texts, so it
/// also serves as the content that hashes are made of.
std::string to_toml(const Value& value);

/// A value as results know it; intervals as text.
results::FactorValue factor_value(const Value& value);

/// What a setting accepts.
enum class Kind { Real, Integer, Choice, Text, Range, Samples, Positions, Building };

/// When a setting is read: always, or only while another one, a choice, has one of some values.
struct Condition {
  std::string setting;  ///< empty: always
  std::vector<std::string> choices;
};

/// One setting of an experiment: the single place that knows its default, bounds and meaning. Study validation, the
/// `new` and `list` verbs and the result's labels are all made from it.
struct Setting {
  std::string section;  ///< table of the study file
  std::string name;     ///< unique among all sections
  Kind kind = Kind::Real;
  Value standard;    ///< default
  double low = 0.0;  ///< bounds of numbers and of both ends of an interval, inclusive
  double high = 0.0;
  std::vector<std::string> choices;
  std::string unit = "1";
  std::string description;
  bool per_method = false;  ///< may also stand in a [[method]]
  Condition read_if = {};   ///< sweeping it where nothing reads it is an error

  /// Of a text besides the default: what is wrong with it, or empty; null where any text will do.
  std::string (*complaint)(const std::string& text) = nullptr;
};

/// What the setting accepts, for messages and templates: "a number from 0 to 10", "one of: a, b".
std::string accepted(const Setting& setting);

/// The candidate nearest to `name` in edit distance, or empty when none is near.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace ridgeloc::studies
