#include "bench/problem_set.hpp"

#include <cstdio>
#include <memory>
#include <stdexcept>

namespace ridgeloc::bench {

ProblemSet::ProblemSet(const core::ProblemBatch& batch) : points_(batch.points()) {
  for (std::size_t trial = 0; trial < batch.trials(); ++trial) {
    starts_.push_back({batch.start(0)[trial], batch.start(1)[trial], batch.start(2)[trial]});
    for (std::size_t j = 0; j < points_; ++j) {
      const std::array point = {batch.position(j, 0)[trial], batch.position(j, 1)[trial], batch.position(j, 2)[trial]};
      observations_.push_back({point, batch.measured(j)[trial]});
    }
  }
}

ProblemSet ProblemSet::moved_by(const std::array<double, 3>& offset) const {
  ProblemSet moved = *this;
  for (std::size_t axis = 0; axis < offset.size(); ++axis) {
    for (auto& start : moved.starts_) start[axis] += offset[axis];
    for (auto& observation : moved.observations_) observation.point[axis] += offset[axis];
  }
  return moved;
}

void ProblemSet::write_csv(const std::string& path) const {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "w"), std::fclose);
  if (!file) throw std::runtime_error(path + ": cannot be written");
  for (std::size_t trial = 0; trial < trials(); ++trial) {
    const auto& start = starts_[trial];
    std::fprintf(file.get(), "%.17g,%.17g,%.17g", start[0], start[1], start[2]);
    for (const Observation& seen : observations(trial)) {
      std::fprintf(file.get(), ",%.17g,%.17g,%.17g,%.17g", seen.point[0], seen.point[1], seen.point[2], seen.measured);
    }
    std::fputc('\n', file.get());
  }
  if (std::fflush(file.get()) != 0 || std::ferror(file.get()) != 0) throw std::runtime_error(path + ": write failed");
}

}  // namespace ridgeloc::bench
