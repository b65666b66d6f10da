// What holds for every registered noise model, and hand-worked values of each.

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/catch.hpp"
#include "tests/support/noise_draw.hpp"

using namespace ridgeloc;
using tests::Draw;

namespace {

constexpr core::Isa sets[] = {core::Isa::Baseline, core::Isa::Avx2, core::Isa::Avx512};

/// Measured ranges and scores, as spans.
std::vector<std::span<const double>> columns(const core::ProblemBatch& problems) {
  std::vector<std::span<const double>> all;
  for (std::size_t j = 0; j < problems.points(); ++j) {
    all.push_back(problems.measured(j));
    if (problems.has_scores()) all.push_back(problems.score(j));
  }
  return all;
}

double largest_difference(const core::ProblemBatch& a, const core::ProblemBatch& b) {
  double largest = 0.0;
  for (std::size_t c = 0; c < columns(a).size(); ++c) {
    for (std::size_t t = 0; t < a.trials(); ++t) {
      largest = std::max(largest, std::abs(columns(a)[c][t] - columns(b)[c][t]));
    }
  }
  return largest;
}

}  // namespace

TEST_CASE("every noise model: the baseline draws the bits of the double path, others the same to rounding") {
  const auto options = tests::noise_options(0.3);
  // With 3 degrees of freedom an error before its angle is above 1000 with probability 1e-9, and scores multiply by at
  // most sqrt 5. Its logarithm, exponential, root and angle are each exact to a few units, the exponential's argument
  // of up to 14 multiplying those of the logarithm.
  constexpr double rounding = 128.0 * 0x1p-53 * 0.3 * 1000.0 * 2.3;
  for (const sim::NoiseEntry& entry : sim::noise_registry()) {
    for (const bool scored : {false, true}) {
      for (const std::size_t trials : {1, 7, 8, 9, 15, 16, 17, 500}) {
        const Draw draw{5, trials, 40, scored, 4.0};
        const auto expected = tests::draw_ranges(entry.name, options, draw);
        for (const core::Isa isa : sets) {
          if (!core::is_supported(isa)) continue;
          INFO(entry.name << " on " << core::name_of(isa) << ", " << trials << " trials, scores " << scored);
          const auto drawn = tests::draw_ranges(entry.name, options, draw, sim::kernels(isa));
          CHECK(largest_difference(expected, drawn) <= (isa == core::Isa::Baseline ? 0.0 : rounding));
        }
      }
    }
  }
}

TEST_CASE("every noise model: a trial is the same in every lane and at the end of a batch") {
  const auto options = tests::noise_options();
  for (const sim::NoiseEntry& entry : sim::noise_registry()) {
    for (const core::Isa isa : sets) {
      if (!core::is_supported(isa)) continue;
      INFO(entry.name << " on " << core::name_of(isa));
      const auto all = tests::draw_ranges(entry.name, options, {5, 64, 1000, true, 4.0}, sim::kernels(isa));
      std::size_t different = 0;
      for (std::size_t shift = 1; shift < 16; ++shift) {
        const Draw later{5, 64 - shift, 1000 + shift, true, 4.0};
        const auto shifted = tests::draw_ranges(entry.name, options, later, sim::kernels(isa));
        for (std::size_t c = 0; c < columns(all).size(); ++c) {
          different += std::ranges::equal(columns(all)[c].subspan(shift), columns(shifted)[c]) ? 0 : 1;
        }
      }
      CHECK(different == 0);
    }
  }
}

TEST_CASE("every noise model: three points are the first three of seven, and errors scale with their level") {
  for (const sim::NoiseEntry& entry : sim::noise_registry()) {
    INFO(entry.name);
    const auto seven = tests::draw_ranges(entry.name, tests::noise_options(), {7, 50, 0, true, 0.0});
    const auto three = tests::draw_ranges(entry.name, tests::noise_options(), {3, 50, 0, true, 0.0});
    const auto doubled = tests::draw_ranges(entry.name, tests::noise_options(2.0), {7, 50, 0, true, 0.0});
    for (std::size_t t = 0; t < 50; ++t) {
      for (std::size_t j = 0; j < 3; ++j) {
        CHECK(three.measured(j)[t] == seven.measured(j)[t]);
        CHECK(three.score(j)[t] == seven.score(j)[t]);
      }
      CHECK(doubled.measured(6)[t] == 2.0 * seven.measured(6)[t]);
    }
  }
}

TEST_CASE("each noise model draws from a stream of its own, which options do not change") {
  // A difference of options that reached the key would give other normals under contaminated and proportional errors.
  auto options = tests::noise_options();
  options.outlier_rate = 0.0;
  const auto plain = tests::draw_errors("contaminated", options, {7, 1000});
  options.outlier_size = 50.0;
  CHECK(tests::draw_errors("contaminated", options, {7, 1000}) == plain);
  CHECK(tests::draw_errors("normal", options, {7, 1000}) != plain);
}

TEST_CASE("contaminated errors are normal ones of the same stream, and a higher rate only adds outliers") {
  auto options = tests::noise_options();
  const Draw draw{7, 2000};
  core::ProblemBatch normal;
  normal.reshape(7, 2000);
  for (std::size_t j = 0; j < 7; ++j) {
    for (std::size_t axis = 0; axis < 3; ++axis) std::ranges::fill(normal.position(j, axis), 0.0);
  }
  sim::measure_ranges(*sim::find_noise("normal"), options, core::Stream(2018, "noise", "contaminated"), 0, normal);
  const auto at_rate = [&](double rate) {
    options.outlier_rate = rate;
    return tests::draw_ranges("contaminated", options, draw);
  };
  const auto none = at_rate(0.0);
  const auto few = at_rate(0.1);
  const auto more = at_rate(0.3);
  const auto all = at_rate(1.0);
  std::size_t wrong = 0;
  for (std::size_t j = 0; j < 7; ++j) {
    for (std::size_t t = 0; t < 2000; ++t) {
      const double error = normal.measured(j)[t];
      const bool outlier = few.measured(j)[t] == 10.0 * error;
      wrong += none.measured(j)[t] == error && all.measured(j)[t] == 10.0 * error ? 0 : 1;
      wrong += outlier || few.measured(j)[t] == error ? 0 : 1;
      wrong += !outlier || more.measured(j)[t] == 10.0 * error ? 0 : 1;
    }
  }
  CHECK(wrong == 0);
}

TEST_CASE("proportional errors are normal ones times range over reference") {
  auto options = tests::noise_options();
  options.reference_depth_m = 2.0;
  const auto near = tests::draw_errors("proportional", options, {7, 100, 0, false, 2.0});
  const auto far = tests::draw_errors("proportional", options, {7, 100, 0, false, 8.0});
  // A range of 8 and an error are summed: exact to 2^-50.
  for (std::size_t i = 0; i < near.size(); ++i)
    CHECK(far[i] - 8.0 == Approx(4.0 * (near[i] - 2.0)).margin(8.0 * 0x1p-50));
  const auto nowhere = tests::draw_errors("proportional", options, {7, 100, 0, false, 0.0});
  CHECK(std::ranges::count(nowhere, 0.0) == 700);
}

TEST_CASE("empirical errors are the samples over their root mean square") {
  const auto options = tests::noise_options(0.5);
  for (const double error : tests::draw_errors("empirical", options, {7, 200})) {
    CHECK(std::ranges::any_of(tests::noise_samples,
                              [&](double s) { return error == 0.5 * (s * (1.0 / options.samples_rms)); }));
  }
}

TEST_CASE("scores scale errors by s^c over its root mean square, and say nothing at c = 0") {
  auto options = tests::noise_options();
  const auto plain = tests::draw_ranges("normal", options, {7, 100});
  const auto scored_with = [&](double low, double exponent) {
    options.score = {low, exponent};
    return tests::draw_ranges("normal", options, {7, 100, 0, true});
  };
  // For s uniform on [0.2, 1]: E s^-2 = 5, E s^2 = 31/75, E s^-1 = log(5) / 0.8.
  const auto inverse = scored_with(0.2, -1.0);
  const auto direct = scored_with(0.2, 1.0);
  const auto root = scored_with(0.2, -0.5);
  const auto silent = scored_with(0.2, 0.0);
  const auto constant = scored_with(1.0, -1.0);
  constexpr double rounding = 32.0 * 0x1p-53;
  for (std::size_t j = 0; j < 7; ++j) {
    for (std::size_t t = 0; t < 100; ++t) {
      const double error = plain.measured(j)[t];
      const double s = inverse.score(j)[t];
      CHECK((0.2 <= s && s <= 1.0));
      CHECK(inverse.measured(j)[t] == Approx(error / s / std::sqrt(5.0)).epsilon(rounding));
      CHECK(direct.measured(j)[t] == Approx(error * s / std::sqrt(31.0 / 75.0)).epsilon(rounding));
      CHECK(root.measured(j)[t] == Approx(error / std::sqrt(s * std::log(5.0) / 0.8)).epsilon(rounding));
      CHECK(direct.score(j)[t] == s);
      CHECK(silent.score(j)[t] == s);
      CHECK(silent.measured(j)[t] == error);
      CHECK(constant.score(j)[t] == 1.0);
      CHECK(constant.measured(j)[t] == error);
    }
  }
}
