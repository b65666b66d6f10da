// Whatever it is given, a solver answers: with a status, and never with a converged estimate that is not a number.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "tests/support/all_methods.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/sample.hpp"

using namespace ridgeloc;
using namespace ridgeloc::tests;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t trials = RIDGELOC_ROBUSTNESS_TRIALS;

/// Something terrible, or nothing at all.
void spoil(Sample& s, std::mt19937_64& engine) {
  const auto pick = [&](std::size_t count) { return static_cast<std::size_t>(engine() % count); };
  const std::array bad = {infinity, -infinity, not_a_number, 1e300, -1e300, 1e-300, 0.0, -3.0, 1e9};
  const std::size_t j = pick(s.points.size());
  switch (pick(20)) {
    case 0:  // one line
      for (std::size_t i = 0; i < s.points.size(); ++i) s.points[i] = {1.0 + static_cast<double>(i), 0.5, -1.0};
      break;
    case 1:  // one plane
      for (Point& p : s.points) p[2] = 1.0;
      break;
    case 2:  // one plane with the start in it
      for (Point& p : s.points) p[1] = s.start[1];
      break;
    case 3:  // one point
      for (Point& p : s.points) p = s.points[0];
      break;
    case 4:  // two points the same
      s.points[0] = s.points[1];
      break;
    case 5:  // start on a point
      s.start = s.points[j];
      break;
    case 6:
      s.start[pick(3)] = bad[pick(bad.size())];
      break;
    case 7:
      s.measured[j] = bad[pick(bad.size())];
      break;
    case 8:
      s.points[j][pick(3)] = bad[pick(bad.size())];
      break;
    case 9:
      for (double& m : s.measured) m = 100.0 * uniform(engine, -1.0, 1.0);
      break;
    case 10:
      for (double& m : s.measured) m *= 1e6;
      break;
    case 11:
      std::ranges::fill(s.measured, bad[pick(bad.size())]);
      break;
    case 12:
      if (!s.score.empty()) s.score[j] = bad[pick(bad.size())];
      break;
    case 13:
      std::ranges::fill(s.score, 0.0);
      break;
    case 14:
      s.start_image_distance = bad[pick(bad.size())];
      break;
    case 15:
      if (s.has_images()) s.alpha[j] = bad[pick(bad.size())];
      break;
    case 16:  // far away, so that all directions agree
      for (Point& p : s.points) p[0] += 1e7;
      break;
    case 17:  // start at the truth of exact measurements
      s.start = s.truth;
      s.start_image_distance = s.image_distance;
      break;
    default:
      break;
  }
}

std::vector<Sample> hostile_samples(std::size_t points, bool images, std::size_t count) {
  std::mt19937_64 engine(points * 2 + (images ? 1 : 0));
  std::vector<Sample> all;
  for (std::size_t i = 0; i < count; ++i) {
    const double sigma = std::array{0.0, 0.1, 30.0}[i % 3];
    all.push_back(random_sample(engine, {.points = points,
                                         .images = images,
                                         .scores = points % 2 == 0,
                                         .sigma_m = sigma,
                                         .offset_m = i % 5 == 0 ? 30.0 : 1.0}));
    spoil(all.back(), engine);
  }
  return all;
}

struct Faults {
  std::size_t without_status = 0;
  std::size_t converged_nowhere = 0;  ///< converged to what is not finite or outside the domain
  std::size_t converged_unmoved = 0;  ///< converged without a step
  std::array<std::size_t, core::status_names.size()> count{};
};

Faults faults(const core::SolutionBatch& s) {
  Faults f;
  for (std::size_t t = 0; t < s.trials(); ++t) {
    if (s.status[t] >= core::status_names.size()) {
      ++f.without_status;
      continue;
    }
    ++f.count[s.status[t]];
    if (status(s, t) != core::Status::Converged) continue;
    const Point x = estimate(s, t);
    f.converged_nowhere += std::hypot(x[0], x[1], x[2]) <= 1e6 * (1.0 + 1e-9) ? 0 : 1;
    f.converged_unmoved += s.iterations[t] >= 1.0 ? 0 : 1;
  }
  return f;
}

/// The problems of one batch, with all that an oracle knows.
struct Hostile {
  core::ProblemBatch problems;
  std::array<std::vector<double>, 3> truth;
  std::vector<double> image_distance;
  core::Oracle oracle;

  Hostile(std::size_t points, bool images, std::size_t count) {
    const auto samples = hostile_samples(points, images, count);
    problems = batch_of(samples);
    for (const Sample& s : samples) {
      for (std::size_t axis = 0; axis < 3; ++axis) truth[axis].push_back(s.truth[axis]);
      image_distance.push_back(s.image_distance);
    }
    for (std::size_t axis = 0; axis < 3; ++axis) oracle.truth[axis] = truth[axis];
    oracle.image_distance = image_distance;
    oracle.range_sigma_m = 0.1;
    oracle.k_error = core::Stream(1, "k_error");
  }
};

std::vector<MethodChoice> all_methods() {
  auto all = methods_by_k();
  const auto more = methods_by_option();
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

std::array<std::size_t, core::status_names.size()> total{};

void check(const Hostile& hostile, const MethodChoice& method, const std::string& model) {
  core::SolutionBatch out;
  for (std::size_t i = 0; i <= core::isa_count; ++i) {
    if (i > 0 && !core::is_supported(static_cast<core::Isa>(i - 1))) continue;
    const solvers::Solver solve = i == 0 ? method.entry->solve : method.entry->kernels[i - 1];
    solve(hostile.problems, method.options, &hostile.oracle, out);
    const Faults f = faults(out);
    INFO(method.name << ", " << model << ", " << hostile.problems.points() << " points, "
                     << (i == 0 ? "double" : core::name_of(static_cast<core::Isa>(i - 1))));
    CHECK(f.without_status == 0);
    CHECK(f.converged_nowhere == 0);
    CHECK(f.converged_unmoved == 0);
    for (std::size_t s = 0; s < total.size(); ++s) total[s] += f.count[s];
  }
}

}  // namespace

TEST_CASE("no input brings a solver down or makes it converge to what is not a number") {
  total = {};
  // `trials` of each method, over batches of every number of points.
  for (std::size_t points = 3; points <= 12; ++points) {
    const Hostile ranges(points, false, trials / 20);
    for (const MethodChoice& method : all_methods()) check(ranges, method, "ranges");
    const Hostile images(points, true, trials / 20);
    const auto models = pseudorange_models();
    std::size_t next = points;
    for (MethodChoice method : all_methods()) {
      // One model each, another one with every number of points.
      const ModelChoice& model = models[next++ % models.size()];
      apply(model, method.options);
      check(images, method, name_of(model));
    }
  }
  std::printf("hostile problems: %zu converged, %zu iteration_limit, %zu singular, %zu non_finite, %zu left_domain\n",
              total[0], total[1], total[2], total[3], total[4]);
  for (const std::size_t count : total) CHECK(count > 100);
}
