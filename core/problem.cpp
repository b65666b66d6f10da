#include "core/problem.hpp"

namespace ridgeloc::core {

namespace {

/// Numbers from one column to the next: an odd number of cache lines, since columns that lie a power of two apart would
/// all compete for the same few places of the cache.
std::size_t stride_of(std::size_t trials) {
  constexpr std::size_t line = 8;
  return ((trials + line - 1) / line | 1U) * line;
}

}  // namespace

void ProblemBatch::reshape(std::size_t points, std::size_t trials) {
  points_ = points;
  trials_ = trials;
  stride_ = stride_of(trials);
  has_scores_ = false;
  has_images_ = false;
  grow();
}

void ProblemBatch::add_scores() {
  has_scores_ = true;
  grow();
}

void ProblemBatch::add_images() {
  has_images_ = true;
  grow();
}

void ProblemBatch::grow() {
  const std::size_t needed = columns() * stride_ + largest_lanes;
  if (values_.size() < needed) values_.resize(needed);
}

void ProblemBatch::copy_trial(const ProblemBatch& from, std::size_t trial, std::size_t slot) {
  const std::size_t used = columns();
  for (std::size_t c = 0; c < used; ++c) values_[c * stride_ + slot] = from.values_[c * from.stride_ + trial];
}

}  // namespace ridgeloc::core
