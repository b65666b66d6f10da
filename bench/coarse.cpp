// Coarse positioning: our database of map graphs against a scan of all graphs. Both tie by order, so that they find the
// same poses, which is checked before anything is measured.

#include <benchmark/benchmark.h>

#include <cstdio>
#include <memory>
#include <string>

#include "bench/corridors.hpp"
#include "bench/graph_scan.hpp"
#include "solvers/coarse/coarse_matching.hpp"

namespace ridgeloc::bench {

namespace {

constexpr std::size_t image_count = 256;

struct Coarse {
  explicit Coarse(std::size_t graphs) : Coarse(corridor_views(graphs, image_count)) {}
  explicit Coarse(CorridorViews views)
      : images(std::move(views.images)), scan(views.graphs), database(std::move(views.graphs)) {}

  std::vector<std::vector<solvers::GraphNode>> images;
  GraphScan scan;
  solvers::MapGraphDatabase database;
  solvers::CoarseScratch scratch;
  std::vector<solvers::CoarsePose> poses;
};

bool check(Coarse& coarse) {
  std::vector<solvers::CoarsePose> expected;
  const auto equal = [](const solvers::CoarsePose& a, const solvers::CoarsePose& b) {
    return a.graph == b.graph && a.score == b.score && a.matched == b.matched;
  };
  const solvers::CoarseOptions options{.ties = solvers::CoarseTies::Order};
  for (const auto& image : coarse.images) {
    coarse.scan.match(image, options, expected);
    coarse.database.match(image, options, coarse.scratch, coarse.poses);
    if (!std::ranges::equal(coarse.poses, expected, equal)) return false;
  }
  return true;
}

template <class Match>
void add(const std::string& name, std::shared_ptr<Coarse> coarse, Match match) {
  const std::string graphs = std::to_string(coarse->database.graphs().size());
  benchmark::RegisterBenchmark((name + "/" + graphs).c_str(), [=](benchmark::State& state) {
    for ([[maybe_unused]] auto pass : state) {
      for (const auto& image : coarse->images) {
        match(*coarse, image);
        benchmark::DoNotOptimize(coarse->poses.data());
      }
    }
    state.counters["per_trial"] = benchmark::Counter(
        static_cast<double>(image_count), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  })->Unit(benchmark::kMicrosecond);
}

}  // namespace

}  // namespace ridgeloc::bench

int main(int argc, char** argv) {
  using namespace ridgeloc;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  for (const std::size_t graphs : {458, 45800}) {
    const auto coarse = std::make_shared<bench::Coarse>(graphs);
    if (!bench::check(*coarse)) {
      std::fprintf(stderr, "ridgeloc_bench_coarse: the scan of %zu graphs finds other poses\n", graphs);
      return 1;
    }
    for (const auto ties : {solvers::CoarseTies::Size, solvers::CoarseTies::Order}) {
      const auto name = std::string(solvers::coarse_ties_names[static_cast<std::size_t>(ties)]);
      bench::add("coarse/" + name, coarse, [ties](bench::Coarse& in, const auto& image) {
        in.database.match(image, {.ties = ties}, in.scratch, in.poses);
      });
    }
    bench::add("coarse/scan", coarse, [](bench::Coarse& in, const auto& image) {
      in.scan.match(image, {.ties = solvers::CoarseTies::Order}, in.poses);
    });
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
