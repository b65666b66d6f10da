// A solve allocates nothing once its buffers have grown.

#include <atomic>
#include <cstdlib>
#include <new>
#include <random>
#include <vector>

#include "solvers/coarse/coarse_matching.hpp"
#include "tests/support/all_methods.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/sample.hpp"

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

namespace {

void check(const core::ProblemBatch& problems, const tests::MethodChoice& method) {
  for (std::size_t i = 0; i <= core::isa_count; ++i) {
    if (i > 0 && !core::is_supported(static_cast<core::Isa>(i - 1))) continue;
    const solvers::Solver solve = i == 0 ? method.entry->solve : method.entry->kernels[i - 1];
    if (solvers::k_estimator_registry()[method.options.k].needs_oracle) continue;
    core::SolutionBatch out;
    solve(problems, method.options, nullptr, out);
    const std::size_t before = allocations.load();
    solve(problems, method.options, nullptr, out);
    const std::size_t made = allocations.load() - before;
    INFO(method.name << " kernel " << i << ", " << problems.points() << " points");
    CHECK(made == 0);
  }
}

}  // namespace

TEST_CASE("a solve allocates nothing once its buffers have grown, whatever the options, the model, the points") {
  auto methods = tests::methods_by_k();
  for (const auto& method : tests::methods_by_option()) methods.push_back(method);
  for (const std::size_t points : {3, 5, 11}) {
    std::mt19937_64 engine(points);
    std::vector<tests::Sample> ranges;
    std::vector<tests::Sample> images;
    for (int i = 0; i < 100; ++i) {
      ranges.push_back(tests::random_sample(engine, {.points = points, .sigma_m = 0.3, .offset_m = 5.0}));
      images.push_back(
          tests::random_sample(engine, {.points = points, .images = true, .sigma_m = 0.3, .offset_m = 5.0}));
    }
    for (tests::MethodChoice method : methods) {
      check(tests::batch_of(ranges), method);
      for (const auto& model : tests::pseudorange_models()) {
        tests::apply(model, method.options);
        check(tests::batch_of(images), method);
      }
    }
  }
}

TEST_CASE("matching a photo with map graphs allocates nothing once its buffers have grown") {
  std::mt19937_64 engine(1);
  const auto nodes = [&](std::size_t count) {
    std::vector<solvers::GraphNode> drawn(count);
    for (solvers::GraphNode& node : drawn) {
      node = {.object_class = static_cast<std::uint32_t>(engine() % 4),
              .x_px = tests::uniform(engine, 0.0, 3000.0),
              .y_px = tests::uniform(engine, 0.0, 2000.0),
              .width_px = 100.0,
              .height_px = tests::uniform(engine, 50.0, 200.0)};
    }
    return drawn;
  };
  std::vector<solvers::MapGraph> graphs(50);
  for (solvers::MapGraph& graph : graphs) {
    graph.nodes = nodes(10);
    graph.objects.resize(10);
  }
  const solvers::MapGraphDatabase database(std::move(graphs));
  const auto image = nodes(6);
  solvers::CoarseScratch scratch;
  std::vector<solvers::CoarsePose> poses;
  database.match(image, {}, scratch, poses);
  const std::size_t before = allocations.load();
  database.match(image, {}, scratch, poses);
  const std::size_t made = allocations.load() - before;
  CHECK(made == 0);
  CHECK(poses.size() == 4);
}
