#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "bench/answer.hpp"
#include "bench/problem_set.hpp"

namespace ridgeloc::bench {

/// Another library, solving one problem at a time by plain least squares. It lives as long as its problem set is
/// solved, so that workspaces are made once.
class Peer {
 public:
  virtual ~Peer() = default;
  /// Solves problem `trial` from its start.
  virtual Answer solve(std::size_t trial) = 0;
};

/// A peer and its stop rule, named "library/stop".
struct PeerEntry {
  std::string_view name;
  std::unique_ptr<Peer> (*make)(const ProblemSet& problems);
};

/// Numbers of points for which there are problems: peers with sizes fixed at compile time exist for these.
inline constexpr std::size_t point_counts[] = {3, 4, 5, 7};

std::span<const PeerEntry> ceres_peers();
std::span<const PeerEntry> tiny_solver_peers();
std::span<const PeerEntry> eigen_peers();
std::span<const PeerEntry> cminpack_peers();
std::span<const PeerEntry> gsl_peers();

/// All of them.
std::vector<PeerEntry> peers();

}  // namespace ridgeloc::bench
