#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/problem.hpp"

namespace ridgeloc::bench {

/// One measured range: m = |point - x| + noise, all in metres.
struct Observation {
  std::array<double, 3> point;
  double measured;
};

/// The problems of a batch in the layout that suits a peer, one problem after the other: solvers that take one problem
/// at a time would pay for the columns of `core::ProblemBatch` with a cache line per number.
class ProblemSet {
 public:
  explicit ProblemSet(const core::ProblemBatch& batch);

  std::size_t points() const { return points_; }
  std::size_t trials() const { return starts_.size(); }
  const std::array<double, 3>& start(std::size_t trial) const { return starts_[trial]; }
  std::span<const Observation> observations(std::size_t trial) const {
    return {observations_.data() + trial * points_, points_};
  }

  /// The same problems in a frame whose origin is moved by -offset, so that every coordinate grows by it.
  ProblemSet moved_by(const std::array<double, 3>& offset) const;

  /// Writes one line of comma-separated numbers per problem, 17 digits: the start, then x, y, z and the measured range
  /// of every point. Throws std::runtime_error if the file cannot be written.
  void write_csv(const std::string& path) const;

 private:
  std::size_t points_;
  std::vector<std::array<double, 3>> starts_;
  std::vector<Observation> observations_;
};

}  // namespace ridgeloc::bench
