// Blocks of the `building` experiment.

#include "studies/building/building.hpp"

#include <algorithm>
#include <cmath>

#include "tests/support/building_study.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"
#include "tests/support/same_bits.hpp"
#include "tests/support/simulation.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;
using tests::columns_of;
using tests::metric_of;
using tests::photo_study;

namespace {

const std::string methods = R"(
[[method]]
solver = "ols"
[[method]]
solver = "lm"
[[method]]
solver = "rr"
[[method]]
solver = "rrr"
[[method]]
solver = "irls"
[[method]]
name = "oracle"
solver = "rrr"
k = "oracle_elem"
)";

constexpr core::Isa sets[] = {core::Isa::Baseline, core::Isa::Avx2, core::Isa::Avx512};

/// Columns that begin where others end are appended to them.
void append(std::vector<results::TrialColumns>& all, const std::vector<results::TrialColumns>& more) {
  REQUIRE(all.size() == more.size());
  for (std::size_t m = 0; m < all.size(); ++m) {
    all[m].status.insert(all[m].status.end(), more[m].status.begin(), more[m].status.end());
    for (std::size_t i = 0; i < all[m].metrics.size(); ++i) {
      all[m].metrics[i].insert(all[m].metrics[i].end(), more[m].metrics[i].begin(), more[m].metrics[i].end());
    }
  }
}

bool same(const results::TrialColumns& a, const results::TrialColumns& b) {
  const auto equal = [](const auto& s, const auto& t) { return tests::same_bits(s, t); };
  return a.status == b.status && std::ranges::equal(a.metrics, b.metrics, equal);
}

std::string error_of(const std::string& text) {
  return tests::refusal_of([&] { make_plan(photo_study("building", text + methods)); });
}

}  // namespace

TEST_CASE("photos are the same however a block is cut, on every instruction set") {
  const std::string settings = GENERATE(as<std::string>(), "[photo]\nscores = \"detector\"\n",
                                        "[photo]\ndetections = 4\n[coarse]\nstarts = \"grid\"\nstart_spacing_m = 4.0\n",
                                        "[building]\nmap = { random = 3 }\n[solver]\nv_mode = \"fixed\"\n");
  const Study study = photo_study("building", settings + methods);
  for (const core::Isa isa : sets) {
    if (!core::is_supported(isa)) continue;
    const auto whole = columns_of(study, {100, 60}, isa);
    auto pieces = columns_of(study, {100, 1}, isa);
    append(pieces, columns_of(study, {101, 16}, isa));
    append(pieces, columns_of(study, {117, 43}, isa));
    for (std::size_t m = 0; m < whole.size(); ++m) {
      CAPTURE(settings, core::name_of(isa), m);
      CHECK(same(whole[m], pieces[m]));
    }
  }
}

TEST_CASE("instruction sets take the same photos, and locate them at the same places to rounding") {
  const Study study = photo_study("building", "[solver]\nv_mode = \"fixed\"\n" + methods);
  const std::size_t photos = 100;
  const auto expected = columns_of(study, {0, photos}, core::Isa::Baseline);
  const std::size_t error = metric_of(study, "error_m");
  for (const core::Isa isa : sets) {
    if (!core::is_supported(isa) || isa == core::Isa::Baseline) continue;
    const auto columns = columns_of(study, {0, photos}, isa);
    CAPTURE(core::name_of(isa));
    CHECK(same(columns.back(), expected.back()));
    for (std::size_t m = 0; m + 1 < columns.size(); ++m) {
      CAPTURE(m);
      CHECK(columns[m].status == expected[m].status);
      double largest = 0.0;
      for (std::size_t t = 0; t < photos; ++t) {
        const double gap = std::fabs(columns[m].metrics[error][t] - expected[m].metrics[error][t]);
        if (!std::isnan(gap)) largest = std::max(largest, gap);
      }
      // Thirty steps from the same start magnify the rounding of 50 m, 1e-14 m, by less than a factor of two each.
      CHECK(largest < 1e-14 * 0x1p30);
    }
  }
}

TEST_CASE("photos with many starts are the same however they are put together") {
  // 1600 starts to a photo: ten photos are simulated at once.
  const std::string grid = "[photo]\ndetections = 3\n[coarse]\nstarts = \"grid\"\nstart_spacing_m = 0.4\n";
  const Study study = photo_study("building", grid + "[[method]]\nsolver = \"ols\"\n[[method]]\nsolver = \"rr\"\n");
  const Plan plan = make_plan(study, core::best_isa());
  CHECK(photos_at_once(BuildingCell(plan.cells[0].values)) == 10);
  const auto whole = columns_of(study, {0, 12});
  auto pieces = columns_of(study, {0, 1});
  append(pieces, columns_of(study, {1, 11}));
  for (std::size_t m = 0; m < whole.size(); ++m) CHECK(same(whole[m], pieces[m]));
  const auto counts = tests::PreparedCell(study, plan.cells[0], plan.isa).count_failures({0, 12});
  for (std::size_t m = 0; m < counts.size(); ++m) {
    CHECK(counts[m].failed == 12 - static_cast<std::uint64_t>(std::ranges::count(whole[m].status, std::uint8_t{0})));
  }
}

TEST_CASE("a photo that cannot be taken is an outcome of every method, and in no population") {
  // Numbers of detections as in Table 1 are up to 7; no photo of this map shows so many.
  const Study study = photo_study(
      "building",
      "[building]\nmap = { random = 1, objects = 6 }\n[[method]]\nsolver = \"ols\"\n[[method]]\nsolver = \"rr\"\n");
  constexpr std::size_t photos = 24;
  const auto columns = columns_of(study, {0, photos});
  const auto& events = study.experiment->schema().events;
  const auto no_photo =
      static_cast<std::uint8_t>(std::ranges::find(events, "no_photo", &results::EventInfo::name) - events.begin());
  std::size_t missing = 0;
  for (std::size_t t = 0; t < photos; ++t) {
    const bool is_missing = columns[0].status[t] == no_photo;
    missing += is_missing ? 1 : 0;
    CHECK((columns[1].status[t] == no_photo) == is_missing);
    if (!is_missing) continue;
    for (const auto& column : columns) {
      for (const auto& metric : column.metrics) CHECK((metric.empty() || std::isnan(metric[t])));
    }
  }
  CHECK(missing > 0);
  CHECK(missing < photos);
}

TEST_CASE("columns hold what their descriptions say") {
  const Study study = photo_study("building", methods);
  const std::size_t photos = 300;
  const auto columns = columns_of(study, {0, photos});
  const auto of_photos = [&](const char* name, std::size_t t) {
    return columns.back().metrics[metric_of(study, name)][t];
  };
  std::array<std::size_t, 4> ends{};
  for (std::size_t t = 0; t < photos; ++t) {
    const double starts = of_photos("start_count", t);
    CHECK(starts <= 4.0 * 2.5);
    CHECK(of_photos("objects_visible", t) >= of_photos("objects_detected", t));
    CHECK(of_photos("objects_detected", t) >= 3.0);
    CHECK(of_photos("objects_detected", t) <= 7.0);
    CHECK(std::isnan(of_photos("coarse_error_m", t)) == (starts == 0.0));
    if (starts > 0.0) CHECK(of_photos("coarse_error_m", t) <= of_photos("coarse_mean_error_m", t) + 1e-12);
    for (std::size_t m = 0; m + 1 < columns.size(); ++m) {
      const auto value = [&](const char* name) { return columns[m].metrics[metric_of(study, name)][t]; };
      const bool located = columns[m].status[t] == 0;
      ++ends[columns[m].status[t]];
      CHECK(std::isnan(value("error_m")) == !located);
      CHECK(std::isnan(value("iterations")) == !located);
      CHECK((value("converged_starts") > 0.0) == located);
      CHECK(std::isnan(value("convergence")) == (starts == 0.0));
      if (starts > 0.0) CHECK(value("convergence") == value("converged_starts") / starts);
      CHECK((columns[m].status[t] == 3) == (starts == 0.0));
    }
  }
  for (const std::size_t status : {0U, 1U, 2U}) CHECK(ends[status] > 0);
  CHECK(columns.back().status.empty());
}

TEST_CASE("failures are counted again as the block counts them") {
  const Study study = photo_study("building", methods);
  const auto columns = columns_of(study, {7, 60});
  const Plan plan = make_plan(study, core::best_isa());
  const auto counts = tests::PreparedCell(study, plan.cells[0], plan.isa).count_failures({7, 60});
  REQUIRE(counts.size() == study.methods.size());
  for (std::size_t m = 0; m < counts.size(); ++m) {
    CHECK(counts[m].trials == 60);
    CHECK(counts[m].failed == 60 - static_cast<std::uint64_t>(std::ranges::count(columns[m].status, std::uint8_t{0})));
    CHECK_FALSE(counts[m].has_reference);
  }
}

TEST_CASE("one or two detections make no position and are refused") {
  for (const int detections : {1, 2}) {
    const std::string error = error_of("[photo]\ndetections = " + std::to_string(detections) + "\n");
    CHECK(error.find("photo.detections = " + std::to_string(detections) +
                     ": a position and an image distance need 3") != std::string::npos);
  }
  CHECK(error_of("[sweep]\ndetections = [3, 2]\n").find("photo.detections = 2") != std::string::npos);
  CHECK(error_of("[photo]\ndetections = 3\n").empty());
  CHECK(error_of("").empty());
}

TEST_CASE("more detections than a map shows are refused with what to change") {
  const Study study =
      photo_study("building", "[photo]\ndetections = 12\n[building]\nmap = { random = 1, objects = 5 }\n" + methods);
  const std::string error = tests::error_of_block(study);
  CHECK(error.find("photo.detections = 12: among 200000 photos of the map \"random 1\"") != std::string::npos);
  CHECK(error.find("give the map more objects") != std::string::npos);
}

TEST_CASE("grids that would take hours are refused with what to change") {
  CHECK(error_of("[coarse]\ngrid_spacing_m = 0.1\ngrid_headings = 360\n")
            .find("coarse.grid_spacing_m = 0.1, coarse.grid_headings = 360: that makes views from 25300 places") !=
        std::string::npos);
  CHECK(error_of("[coarse]\ngrid_spacing_m = 0.1\n").empty());
  CHECK(error_of("[coarse]\nstarts = \"grid\"\nstart_spacing_m = 0.05\n").empty());
  CHECK(
      error_of("[building]\nmap = { random = 1, wings = 9, objects = 9 }\n"
               "[coarse]\nstarts = \"grid\"\nstart_spacing_m = 0.05\n")
          .find("coarse.start_spacing_m = 0.05: that makes 910800 starts on the map \"random 1\", more than 200000") !=
      std::string::npos);
}

TEST_CASE("a sweep of what the starts or the scores do not read is refused") {
  const auto swept = [](const std::string& axis) { return error_of("[sweep]\n" + axis + "\n"); };
  const std::string grid = "[coarse]\nstarts = \"grid\"\n[sweep]\n";
  for (const char* axis : {"coarse_topk = [1, 2]", "grid_spacing_m = [1.0, 2.0]", "grid_headings = [4, 8]",
                           "agreement_weight = [0.0, 1.0]", "unmatched_penalty = [0.0, 1.0]",
                           "coarse_ties = [\"size\", \"order\"]", "false_class_rate = [0.0, 0.1]"}) {
    CAPTURE(axis);
    CHECK(swept(axis).empty());
    CHECK(error_of(grid + axis + "\n").find("changes nothing: it is read only if starts is coarse") !=
          std::string::npos);
  }
  CHECK(swept("start_spacing_m = [1.0, 2.0]").find("it is read only if starts is grid") != std::string::npos);
  for (const std::string axis : {"score_low = [0.1, 0.2]", "score_link = [0.0, 1.0]"}) {
    CAPTURE(axis);
    CHECK(swept(axis).find("changes nothing: it is read only if scores is detector") != std::string::npos);
    CHECK(swept("scores = [\"none\", \"detector\"]\n" + axis).empty());
  }
}

TEST_CASE("what photos do not read is no setting of theirs") {
  CHECK(error_of("[solver]\nsimilarity = 0.5\n").find("similarity") != std::string::npos);
  CHECK(error_of("[solver]\neta = \"absolute\"\n").find("eta") != std::string::npos);
}
