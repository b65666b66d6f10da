#pragma once

#include <cstddef>
#include <tuple>
#include <utility>

namespace ridgeloc::core {

/// Calls f with an element of a list of types, chosen by its index and made of the arguments: how a choice that is
/// equal for all trials, made while the program runs, reaches code that is compiled for every choice.
template <class List, class F, class... Arguments>
void with_entry(std::size_t index, F&& f, const Arguments&... arguments) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (void)((I == index && (f(std::tuple_element_t<I, List>{arguments...}), true)) || ...);
  }
  (std::make_index_sequence<std::tuple_size_v<List>>{});
}

}  // namespace ridgeloc::core
