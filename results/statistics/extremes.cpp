#include "results/statistics/extremes.hpp"

#include <algorithm>

#include "results/statistics/lanes.hpp"

namespace ridgeloc::results {
namespace {

/// NaN compares false and changes nothing.
template <std::size_t width>
struct Range {
  Lanes<width> low, high;

  [[gnu::always_inline]] void add(const double* group) {
    for (std::size_t r = 0; r < Lanes<width>::registers; ++r) {
      typename Lanes<width>::Register value;
      Lanes<width>::load(value, group, r);
      low.parts[r] = value < low.parts[r] ? value : low.parts[r];
      high.parts[r] = value > high.parts[r] ? value : high.parts[r];
    }
  }
};

template <std::size_t width>
struct FindExtremes {
  [[gnu::always_inline]] static Extremes run(std::span<const double> values) {
    Range<width> range;
    range.low.fill(Extremes{}.min);
    range.high.fill(Extremes{}.max);
    for_each_group(values, range);
    const auto low = range.low.values();
    const auto high = range.high.values();
    return {*std::min_element(low.begin(), low.end()), *std::max_element(high.begin(), high.end())};
  }
};

}  // namespace

Extremes extremes_of(std::span<const double> values, InstructionSet set) {
  return run_with<FindExtremes>(set, values);
}

}  // namespace ridgeloc::results
