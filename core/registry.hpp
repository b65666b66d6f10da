#pragma once

#include <cstddef>
#include <tuple>
#include <type_traits>
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

/// The same with the type alone, as std::type_identity.
template <class List, class F>
void with_type(std::size_t index, F&& f) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (void)((I == index && (f(std::type_identity<std::tuple_element_t<I, List>>{}), true)) || ...);
  }
  (std::make_index_sequence<std::tuple_size_v<List>>{});
}

}  // namespace ridgeloc::core
