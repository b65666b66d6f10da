#include "sim/kernels.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "tests/support/catch.hpp"

using namespace ridgeloc;

namespace {

constexpr std::size_t points = 5;

core::ProblemBatch draw(const sim::Kernels& kernels, std::uint64_t first, std::size_t trials) {
  const sim::FieldOfView view;
  core::ProblemBatch problems;
  problems.reshape(points, trials);
  kernels.place_objects(view, sim::SceneStreams(2018, view), first, problems);
  kernels.measure_ranges(sim::noise_registry()[0], {.range_sigma_m = 0.3}, core::Stream(2018, "noise", "normal"), first,
                         problems);
  return problems;
}

/// Every column of a batch, as spans.
std::vector<std::span<const double>> columns(const core::ProblemBatch& problems) {
  std::vector<std::span<const double>> all;
  for (std::size_t j = 0; j < points; ++j) {
    for (std::size_t axis = 0; axis < 3; ++axis) all.push_back(problems.position(j, axis));
    all.push_back(problems.measured(j));
  }
  for (std::size_t axis = 0; axis < 3; ++axis) all.push_back(problems.start(axis));
  return all;
}

}  // namespace

TEST_CASE("the baseline draws the bits of the double path, others the same to rounding") {
  const sim::Kernels reference = sim::kernels_over<double>();
  for (const std::size_t trials : {1, 7, 8, 9, 15, 16, 17, 33, 500}) {
    const auto expected = draw(reference, 40, trials);
    for (const core::Isa isa : {core::Isa::Baseline, core::Isa::Avx2, core::Isa::Avx512}) {
      if (!core::is_supported(isa)) continue;
      INFO(core::name_of(isa) << ", " << trials << " trials");
      const auto drawn = draw(sim::kernels(isa), 40, trials);
      double largest = 0.0;
      for (std::size_t c = 0; c < columns(expected).size(); ++c) {
        for (std::size_t t = 0; t < trials; ++t) {
          largest = std::max(largest, std::abs(columns(expected)[c][t] - columns(drawn)[c][t]));
        }
      }
      // Lengths are at most 10 m; each comes from a few roundings of 2^-53 of it.
      CHECK(largest <= (isa == core::Isa::Baseline ? 0.0 : 64.0 * 0x1p-53 * 10.0));
    }
  }
}

TEST_CASE("a trial is the same in every lane and at the end of a batch") {
  for (const core::Isa isa : {core::Isa::Baseline, core::Isa::Avx2, core::Isa::Avx512}) {
    if (!core::is_supported(isa)) continue;
    const auto all = draw(sim::kernels(isa), 1000, 64);
    std::size_t different = 0;
    for (std::size_t shift = 1; shift < 16; ++shift) {
      const auto shifted = draw(sim::kernels(isa), 1000 + shift, 64 - shift);
      for (std::size_t c = 0; c < columns(all).size(); ++c) {
        different += std::ranges::equal(columns(all)[c].subspan(shift), columns(shifted)[c]) ? 0 : 1;
      }
    }
    INFO(core::name_of(isa));
    CHECK(different == 0);
  }
}
