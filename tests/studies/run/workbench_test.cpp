#include "studies/run/workbench.hpp"

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "studies/files/study_reader.hpp"
#include "studies/registry.hpp"
#include "studies/study/setting_builders.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;

namespace {

std::atomic<int> alive{0};
std::atomic<int> made{0};
std::atomic<int> at_once{0};
std::atomic<int> most_at_once{0};

struct Counted : Simulation {
  Counted() { ++alive; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;
  ~Counted() override { --alive; }
  bool run_block(TrialRange, Workspace&, Monitor&, results::BlockSink&) const override { return true; }
};

/// Simulations that take long to prepare, and are counted.
struct Slow : Experiment {
  std::string_view name() const override { return "slow to prepare"; }
  std::string_view summary() const override { return ""; }
  int version() const override { return 1; }
  std::uint64_t block_trials() const override { return 1; }
  std::span<const Setting> settings() const override { return {}; }
  const results::Schema& schema() const override {
    static const results::Schema schema{{{"m", "1", "", false}}, {}, 0};
    return schema;
  }
  std::string_view example() const override { return ""; }
  std::unique_ptr<const Simulation> prepare(const StudyKey&, const Cell& cell, std::span<const Method>) const override {
    if (cell.index == 2) throw core::InputError("no such cell");
    const int here = ++at_once;
    int most = most_at_once;
    while (here > most && !most_at_once.compare_exchange_weak(most, here)) {
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    --at_once;
    ++made;
    return std::make_unique<Counted>();
  }
};

/// Three cells of such a study.
struct Bench {
  Bench() {
    study.experiment = &experiment;
    static const Setting bench = Section("").integer("bench", 0, {0, 2}, "");
    study.sweep = {{&bench, {std::int64_t{0}, std::int64_t{1}, std::int64_t{2}}}};
    plan.cells = CellGrid(study);
    made = 0;
    most_at_once = 0;
  }
  Slow experiment;
  Study study;
  Plan plan;
};

}  // namespace

TEST_CASE("workers at the same cell share one simulation, which is made once") {
  Bench b;
  {
    Workbench bench(b.study, b.plan, 4);
    std::vector<const Simulation*> got(4);
    {
      std::vector<std::jthread> workers;
      for (std::size_t w = 0; w < got.size(); ++w)
        workers.emplace_back([&, w] { got[w] = &bench.simulation(w, 0, {}); });
    }
    CHECK(made == 1);
    for (const Simulation* simulation : got) CHECK(simulation == got[0]);
    // Whoever asks again for what it has gets just that.
    CHECK(&bench.simulation(2, 0, {}) == got[0]);
    CHECK(made == 1);
  }
  CHECK(alive == 0);
}

TEST_CASE("simulations of several cells are prepared at the same time, and live while a worker has them") {
  Bench b;
  Workbench bench(b.study, b.plan, 2);
  {
    std::vector<std::jthread> workers;
    for (std::size_t w = 0; w < 2; ++w) workers.emplace_back([&, w] { bench.simulation(w, w, {}); });
  }
  CHECK(most_at_once == 2);
  CHECK(alive == 2);
  bench.simulation(0, 1, {});
  CHECK(alive == 1);
  CHECK(made == 2);
  bench.simulation(0, 0, {});  // made anew: nobody had it
  CHECK(made == 3);
}

TEST_CASE("a simulation that cannot be prepared is refused to each who asks, and nobody waits for it") {
  Bench b;
  Workbench bench(b.study, b.plan, 2);
  for (std::size_t worker = 0; worker < 2; ++worker) {
    CHECK_THROWS_AS(bench.simulation(worker, 2, {}), core::InputError);
  }
  bench.simulation(0, 0, {});
  CHECK(made == 1);
}
