#include "sim/range_noise.hpp"

#include <array>
#include <utility>

namespace ridgeloc::sim {

std::span<const NoiseEntry> noise_registry() {
  static constexpr auto registry = []<std::size_t... I>(std::index_sequence<I...>) {
    return std::array{
        NoiseEntry{std::tuple_element_t<I, NoiseModels>::name, std::tuple_element_t<I, NoiseModels>::summary, I}...};
  }
  (std::make_index_sequence<std::tuple_size_v<NoiseModels>>{});
  return registry;
}

}  // namespace ridgeloc::sim
