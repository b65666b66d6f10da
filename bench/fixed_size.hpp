#pragma once

#include <memory>
#include <stdexcept>

#include "bench/peer.hpp"

namespace ridgeloc::bench {

/// Makes the peer whose number of points is fixed at compile time: `make.operator()<n>()` for n = points.
template <class Make>
std::unique_ptr<Peer> with_fixed_size(std::size_t points, Make make) {
  static_assert(std::size(point_counts) == 4);
  switch (points) {
    case point_counts[0]:
      return make.template operator()<point_counts[0]>();
    case point_counts[1]:
      return make.template operator()<point_counts[1]>();
    case point_counts[2]:
      return make.template operator()<point_counts[2]>();
    case point_counts[3]:
      return make.template operator()<point_counts[3]>();
    default:
      throw std::invalid_argument("no peer of this size");
  }
}

}  // namespace ridgeloc::bench
