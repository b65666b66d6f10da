#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/problem.hpp"
#include "core/solution.hpp"

namespace ridgeloc::solvers {

/// The trials of a batch that need more than the first few steps: a queue of where they stand, and a small batch whose
/// slots they take, one after the other, as others finish.
class Survivors {
 public:
  /// Empties the queue and makes room for every trial of `batch`, with `values` numbers of state each, and for `lanes`
  /// problems at a time. Allocates only when it grows.
  void reshape(const core::ProblemBatch& batch, std::size_t values, std::size_t lanes);

  /// Appends a trial; its state is to be written to what this returns.
  double* push(std::size_t trial);

  /// Takes the next trial and puts its problem into a slot. Precondition: not empty.
  struct Entry {
    std::size_t trial;
    const double* state;
  };
  Entry pop(const core::ProblemBatch& batch, std::size_t slot);

  bool empty() const { return next_ == end_; }
  const core::ProblemBatch& problems() const { return problems_; }

  /// What came of the problems in the slots.
  core::SolutionBatch& finished() { return finished_; }

 private:
  std::vector<std::uint32_t> trials_;
  std::vector<double> states_;
  std::size_t values_ = 0;
  std::size_t next_ = 0;
  std::size_t end_ = 0;
  core::ProblemBatch problems_;
  core::SolutionBatch finished_;
};

/// The queue of the calling thread.
Survivors& survivors_of_thread();

}  // namespace ridgeloc::solvers
