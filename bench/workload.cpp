#include "bench/workload.hpp"

#include <map>

#include "bench/ours.hpp"

namespace ridgeloc::bench {

namespace {

Workload make_workload(std::size_t points) {
  core::ProblemBatch batch;
  batch.reshape(points, workload_trials);
  own_generators().front().generate(0, batch);
  ProblemSet problems(batch);
  return {std::move(batch), std::move(problems)};
}

}  // namespace

const Workload& workload(std::size_t points) {
  static std::map<std::size_t, Workload> made;
  const auto found = made.find(points);
  return found != made.end() ? found->second : made.emplace(points, make_workload(points)).first->second;
}

}  // namespace ridgeloc::bench
