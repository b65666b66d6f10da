#pragma once

#include <cstddef>
#include <ranges>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace ridgeloc::results {

/// Where in a list of cells or methods each hash stands; a method may be there twice, under two labels. The list must
/// outlive it.
class PlacesByHash {
 public:
  template <class Info>
  explicit PlacesByHash(const std::vector<Info>& list) {
    places_.reserve(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) places_.emplace(list[i].hash, i);
  }

  /// The places of a hash, in no order.
  auto of(const std::string& hash) const {
    const auto [begin, end] = places_.equal_range(hash);
    return std::ranges::subrange(begin, end) | std::views::values;
  }

 private:
  std::unordered_multimap<std::string_view, std::size_t> places_;
};

}  // namespace ridgeloc::results
