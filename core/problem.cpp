#include "core/problem.hpp"

namespace ridgeloc::core {

void ProblemBatch::reshape(std::size_t points, std::size_t trials) {
  points_ = points;
  trials_ = trials;
  has_scores_ = false;
  const std::size_t needed = (points * 4 + position_parameters) * trials;
  if (values_.size() < needed) values_.resize(needed);
}

void ProblemBatch::add_scores() {
  has_scores_ = true;
  const std::size_t needed = (points_ * 5 + position_parameters) * trials_;
  if (values_.size() < needed) values_.resize(needed);
}

}  // namespace ridgeloc::core
