// A solve allocates nothing once its buffers have grown.

#include <atomic>
#include <cstdlib>
#include <new>

#include "catch.hpp"
#include "sim/field_of_view.hpp"
#include "sim/range_noise.hpp"
#include "solvers/solver.hpp"

namespace {

std::atomic<std::size_t> allocations{0};

}  // namespace

void* operator new(std::size_t size) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

using namespace ridgeloc;

TEST_CASE("a solve allocates nothing once its buffers have grown") {
  core::ProblemBatch problems;
  problems.reshape(5, 500);
  const sim::FieldOfView view;
  sim::place_objects(view, sim::SceneStreams(1, view), 0, problems);
  sim::measure_ranges(sim::noise_registry()[0], {.range_sigma_m = 0.3}, core::Stream(1, "noise", "normal"), 0,
                      problems);
  for (const auto& entry : solvers::solver_registry()) {
    for (std::size_t i = 0; i <= core::isa_count; ++i) {
      if (i > 0 && !core::is_supported(static_cast<core::Isa>(i - 1))) continue;
      const solvers::Solver solve = i == 0 ? entry.solve : entry.kernels[i - 1];
      core::SolutionBatch out;
      solve(problems, {}, nullptr, out);
      const std::size_t before = allocations.load();
      solve(problems, {}, nullptr, out);
      const std::size_t made = allocations.load() - before;
      INFO(entry.name << " kernel " << i);
      CHECK(made == 0);
    }
  }
}
