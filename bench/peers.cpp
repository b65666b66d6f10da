#include "bench/peer.hpp"

namespace ridgeloc::bench {

std::vector<PeerEntry> peers() {
  std::vector<PeerEntry> all;
  for (const auto& library : {ceres_peers(), tiny_solver_peers(), eigen_peers(), cminpack_peers(), gsl_peers()}) {
    all.insert(all.end(), library.begin(), library.end());
  }
  return all;
}

}  // namespace ridgeloc::bench
