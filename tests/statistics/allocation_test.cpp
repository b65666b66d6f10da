// What it is worth to spend a limited cost where it gains most: the cost at which an equal number of trials per cell
// would reach the same mean square of the cells' relative errors. Errors squared fall with 1 over the cost, so that the
// ratio of the mean squares at equal cost is that of the costs at an equal mean square.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <string>

#include "results/store/result_file.hpp"
#include "studies/files/study_reader.hpp"
#include "studies/registry.hpp"
#include "studies/run/runner.hpp"
#include "studies/study/capabilities.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;

namespace {

struct Spent {
  double cost = 0.0;
  double mean_square = 0.0;  ///< of the relative errors of the cells
  double worst = 0.0;        ///< the largest relative error
};

Spent run(const std::string& sweep, const std::string& amount) {
  const Study study = read_study(
      {"s", "s.toml", "experiment = \"ranging\"\naudit = 0\n" + amount + sweep + "[[method]]\nsolver = \"rrr\"\n"});
  const Plan plan = make_plan(study);
  const tests::ScratchFolder folder;
  const std::filesystem::path output = folder / "result.h5";
  RunProgress progress;
  run_study(study, plan, everything(plan), results::ResultClaim(output), *thread_queue(2), {}, progress,
            std::atomic<bool>(false));
  const results::Summary summary = results::read_result(output);
  Spent spent;
  for (std::size_t cell = 0; cell < plan.cells.size(); ++cell) {
    const auto row = results::summary_row(summary.header, 0, summary.of(cell, 0), "error_all_m");
    spent.cost += cost_of(*study.experiment, plan.cells[cell].values, summary.of(cell, 0));
    spent.mean_square += std::pow(row.mcse / row.mean, 2) / static_cast<double>(plan.cells.size());
    spent.worst = std::max(spent.worst, row.mcse / row.mean);
  }
  return spent;
}

void compare(const std::string& name, const std::string& sweep) {
  const Spent equal = run(sweep, "trials = 204800\n");
  const Spent chosen = run(sweep,
                           "[stop]\nmetric = \"error_all_m\"\nrelative = 1e-6\nmin_trials = 4096\n"
                           "max_trials = 100000000\nmax_cost = " +
                               std::to_string(equal.cost) + "\n");
  const double ratio = (equal.mean_square * equal.cost) / (chosen.mean_square * chosen.cost);
  UNSCOPED_INFO(name << ": cost " << equal.cost << " and " << chosen.cost
                     << "; root mean square of the relative errors " << 100.0 * std::sqrt(equal.mean_square)
                     << " % and " << 100.0 * std::sqrt(chosen.mean_square) << " %, the worst " << 100.0 * equal.worst
                     << " % and " << 100.0 * chosen.worst << " %; equal trials cost " << ratio << " times as much");
  CHECK(ratio > 1.0);
  // The same target for all cells, whatever they cost.
  const Spent reached = run(sweep,
                            "[stop]\nmetric = \"error_all_m\"\nrelative = 0.0035\nmin_trials = 4096\n"
                            "max_trials = 100000000\n");
  UNSCOPED_INFO(name << ": a target of 0.35 % for every cell costs " << reached.cost << ", root mean square "
                     << 100.0 * std::sqrt(reached.mean_square) << " %, and "
                     << (reached.mean_square * reached.cost) / (chosen.mean_square * chosen.cost) << " times as much");
  CHECK(reached.worst <= 0.0035);
}

}  // namespace

TEST_CASE("allocation by priority needs less than equal trials") {
  compare("points and noise", "[sweep]\npoints = [4, 5, 7]\nrange_sigma_m = [0.1, 0.5]\n");
  compare("fields of view", "[sweep]\nazimuth_deg = [[-60, 60], [-30, 30], [-15, 15], [-7, 7]]\npoints = [4, 7, 20]\n");
}
