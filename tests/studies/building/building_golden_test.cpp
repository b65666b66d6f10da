// Numbers of the experiments with photos change only with their versions.

#include <vector>

#include "results/blocks/block.hpp"
#include "studies/plan/assignment.hpp"
#include "studies/plan/plan.hpp"
#include "tests/support/building_study.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/simulation.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;

namespace {

/// Digests of the columns of a study's first block, by method; the experiment's own label is the last.
std::vector<std::uint64_t> digests_of(const Study& study, core::Isa isa) {
  const Plan plan = make_plan(study, isa);
  const TrialRange range = everything(plan).range(0);
  results::BlockMethods methods = results::all_methods(plan.header);
  methods.differences.clear();
  results::BlockSink sink(plan.header, 0, 0, range.count, std::move(methods));
  tests::PreparedCell(study, plan.cells[0], isa).run(range, sink);
  std::vector<std::uint64_t> digests;
  for (const results::Row& row : sink.take_rows()) digests.push_back(row.digests[0]);
  return digests;
}

/// The digests on the baseline, and on the instruction sets with a fused multiply-add, which agree.
struct Golden {
  const char* study;
  std::vector<std::uint64_t> baseline;
  std::vector<std::uint64_t> fused;
};

void check(const std::string& experiment, int version, const Golden& golden) {
  const Study study = tests::photo_study(experiment, golden.study);
  // A deliberate change of the numbers raises the version and updates the digests; an accidental one is caught here.
  REQUIRE(study.experiment->version() == version);
  for (const core::Isa isa : {core::Isa::Baseline, core::Isa::Avx2, core::Isa::Avx512}) {
    if (!core::is_supported(isa)) continue;
    const auto digests = digests_of(study, isa);
    const auto& expected = isa == core::Isa::Baseline ? golden.baseline : golden.fused;
    REQUIRE(digests.size() == expected.size());
    for (std::size_t method = 0; method < digests.size(); ++method) {
      INFO(experiment << ", " << core::name_of(isa) << ", row " << method << " is 0x" << std::hex << digests[method]);
      CHECK(digests[method] == expected[method]);
    }
  }
}

}  // namespace

TEST_CASE("numbers of located photos change only with the version of the experiment") {
  check("building", 3,
        GENERATE(Golden{R"(
trials = 512
[photo]
scores = "detector"
[[method]]
solver = "ols"
[[method]]
solver = "lm"
[[method]]
solver = "rr"
[[method]]
solver = "rrr"
[[method]]
name = "v fixed"
solver = "irls"
v_mode = "fixed"
)",
                        {0x6e85652da524a24b, 0xb3cafff8871fb5a4, 0xa0289abf1f237e33, 0xb39acfb5e1668679,
                         0xcaffadf9057f9a53, 0x811c46fc577372ca},
                        {0x8916e6b637a16927, 0xf574f87dfe1db0f4, 0xf545f0df76a55c55, 0x957cdc7434adb856,
                         0x7ce545aec65ba0bb, 0x811c46fc577372ca}},
                 Golden{R"(
trials = 128
seed = 7
[building]
map = { random = 3, wings = 2, objects = 40 }
[photo]
detections = 4
zoom = 1.25
pitch_sigma_deg = 2.0
roll_sigma_deg = 1.0
scores = "detector"
[detector]
centre_sigma = 0.02
height_sigma = 0.01
false_class_rate = 0.05
score_link = 0.5
[coarse]
coarse_topk = 7
agreement_weight = 0.75
coarse_ties = "order"
[[method]]
solver = "rr"
k = "hkb"
[[method]]
name = "oracle"
solver = "rrr"
k = "oracle_elem"
)",
                        {0x5f62fa040cf2ffea, 0xbfa62ece985f7c33, 0xcbe1afc96c50de5},
                        {0x311bc7ca81e337a, 0x5566f274c437bfe, 0xcbe1afc96c50de5}},
                 Golden{R"(
trials = 64
[photo]
detections = 3
widest_spread_deg = 15.0
[coarse]
starts = "grid"
start_spacing_m = 2.0
[[method]]
solver = "lm"
)",
                        {0x4652e63ba86fad65, 0xea154b6e435b9f69},
                        {0xc08e3500ab727f00, 0xea154b6e435b9f69}}));
}

TEST_CASE("numbers of detected objects change only with the version of the experiment") {
  const auto [settings, digest] = GENERATE(table<std::string, std::uint64_t>({
      {"trials = 1024\n[object]\nleast_detections = 3\n", 0xe0b813b5ca8c4afa},
      {"trials = 200\nseed = 7\n[building]\nmap = { random = 4 }\n[photo]\nwidest_spread_deg = 20.0\nroll_sigma_deg = "
       "3.0\n[detector]\nheight_sigma = 0.02\n[object]\nobject_class = \"door\"\ndistance = \"far\"\n",
       0x9909f7cf3309fda5},
  }));
  check("detection", 2, {settings.c_str(), {digest}, {digest}});
}
