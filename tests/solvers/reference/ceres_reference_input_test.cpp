#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <string>

#include "solvers/reference/ceres_reference.hpp"
#include "tests/solvers/reference/reference_scene.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc;
using solvers::ReferenceLoss;
using tests::make_scene;
using tests::Position;
using tests::Scene;

namespace {

constexpr double theta = 0.05;

/// What `work` writes to the descriptors of standard output and standard error.
std::string printed_by(const std::function<void()>& work) {
  std::FILE* file = std::tmpfile();
  REQUIRE(file != nullptr);
  std::fflush(nullptr);
  const std::array<int, 2> saved{::dup(STDOUT_FILENO), ::dup(STDERR_FILENO)};
  ::dup2(::fileno(file), STDOUT_FILENO);
  ::dup2(::fileno(file), STDERR_FILENO);
  work();
  std::fflush(nullptr);
  ::dup2(saved[0], STDOUT_FILENO);
  ::dup2(saved[1], STDERR_FILENO);
  ::close(saved[0]);
  ::close(saved[1]);
  std::rewind(file);
  std::string text;
  for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file)) text.push_back(static_cast<char>(c));
  std::fclose(file);
  return text;
}

}  // namespace

TEST_CASE("unusable input and far starts end quietly", "[ceres_reference]") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const auto fails = [](const Scene& scene, const Position& start, ReferenceLoss loss, double width) {
    return !solvers::minimize(scene.batch, 0, start, {loss, width}).converged &&
           std::isnan(solvers::gradient(scene.batch, 0, start, {loss, width})[0]);
  };
  bool all_fail = true;
  bool far_is_sane = true;
  const std::string printed = printed_by([&] {
    for (const auto loss : {ReferenceLoss::WeightedSquares, ReferenceLoss::HuberTheta}) {
      const Scene good = make_scene(5, 0.1, 40);
      for (const double bad : {nan, infinite}) {
        Scene scene = good;
        scene.batch.measured(2)[0] = bad;
        all_fail = all_fail && fails(scene, scene.start, loss, theta);
        scene = good;
        scene.batch.position(4, 1)[0] = bad;
        all_fail = all_fail && fails(scene, scene.start, loss, theta);
        scene = good;
        scene.batch.score(0)[0] = bad;
        all_fail = all_fail && fails(scene, scene.start, loss, theta);
        all_fail = all_fail && fails(good, {0.0, bad, 0.0}, loss, theta);
      }
      Scene negative = good;
      negative.batch.score(1)[0] = -0.5;
      all_fail = all_fail && fails(negative, negative.start, loss, theta);
      const Position on_point{good.batch.position(0, 0)[0], good.batch.position(0, 1)[0], good.batch.position(0, 2)[0]};
      all_fail = all_fail && fails(good, on_point, loss, theta);
      all_fail = all_fail && fails(good, {1e200, 0.0, 0.0}, loss, theta);
      for (const double distance : {1e3, 1e6, 1e12, 1e150}) {
        const auto found = solvers::minimize(good.batch, 0, Position{distance, -distance, distance}, {loss, theta});
        far_is_sane = far_is_sane && std::isfinite(found.estimate[0]) &&
                      (!found.converged || std::hypot(found.estimate[0], found.estimate[1], found.estimate[2]) < 100.0);
      }
    }
    const Scene scene = make_scene(5, 0.1, 41);
    for (const double width : {0.0, -1.0, nan, infinite}) {
      all_fail = all_fail && fails(scene, scene.start, ReferenceLoss::HuberTheta, width);
    }
  });
  CHECK(all_fail);
  CHECK(far_is_sane);
  CHECK(printed.empty());
}
