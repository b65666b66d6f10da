#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "studies/study/value.hpp"

namespace ridgeloc::studies {

/// Builds the settings of one table of a study file. Each kind asks for what it has and no more: `standard` is the
/// default, `bounds` are [low, high], inclusive, for a range those of both of its ends.
class Section {
 public:
  /// `name`: of the table; empty at the top of the file.
  explicit Section(std::string name) : name_(std::move(name)) {}

  Setting real(std::string name, double standard, Interval bounds, std::string unit, std::string description) const;

  Setting integer(std::string name, std::integral auto standard, Interval bounds, std::string description) const {
    return number(Kind::Integer, std::move(name), static_cast<std::int64_t>(standard), bounds, "1",
                  std::move(description));
  }

  Setting range(std::string name, Interval standard, Interval bounds, std::string unit, std::string description) const;

  /// A list of numbers, none as long as the study gives none.
  Setting samples(std::string name, Interval bounds, std::string description) const;

  /// A list of positions, none as long as the study gives none.
  Setting positions(std::string name, Interval bounds, std::string description) const;

  Setting choice(std::string name, std::vector<std::string> choices, std::string standard,
                 std::string description) const;

  /// An enumeration whose names are listed in the order of its values.
  template <class Enum, std::size_t N>
  requires std::is_enum_v<Enum> Setting choice(std::string name, const std::array<std::string_view, N>& choices,
                                               Enum standard, std::string description)
  const {
    return choice(std::move(name), {choices.begin(), choices.end()},
                  std::string(choices[static_cast<std::size_t>(standard)]), std::move(description));
  }

  Setting text(std::string name, std::string standard, std::string description) const;
  Setting building(std::string name, Building standard, std::string description) const;

 private:
  Setting number(Kind kind, std::string name, Value standard, Interval bounds, std::string unit,
                 std::string description) const;
  Setting other(Kind kind, std::string name, Value standard, std::string description) const;

  std::string name_;
};

/// The setting, which may also stand in a [[method]].
Setting per_method(Setting setting);

/// The setting, read only under the condition.
Setting read_if(Condition condition, Setting setting);

/// What the entries of a registry are called, in its order: the choices of a setting that picks one.
template <class Registry>
std::vector<std::string> names_of(const Registry& registry) {
  std::vector<std::string> names;
  for (const auto& entry : registry) names.emplace_back(entry.name);
  return names;
}

}  // namespace ridgeloc::studies
