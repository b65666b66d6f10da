#include "sim/range_noise.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace ridgeloc::sim {

std::span<const NoiseEntry> noise_registry() {
  static constexpr auto registry = []<std::size_t... I>(std::index_sequence<I...>) {
    return std::array{NoiseEntry{std::tuple_element_t<I, NoiseModels>::name,
                                 std::tuple_element_t<I, NoiseModels>::summary,
                                 std::tuple_element_t<I, NoiseModels>::option_names, I}...};
  }
  (std::make_index_sequence<std::tuple_size_v<NoiseModels>>{});
  return registry;
}

const NoiseEntry* find_noise(std::string_view name) {
  const auto registry = noise_registry();
  const auto found = std::ranges::find(registry, name, &NoiseEntry::name);
  return found == registry.end() ? nullptr : &*found;
}

}  // namespace ridgeloc::sim
