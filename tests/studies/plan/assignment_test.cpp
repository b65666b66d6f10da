#include "studies/plan/assignment.hpp"

#include <algorithm>
#include <set>

#include "studies/files/study_reader.hpp"
#include "studies/registry.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;

namespace {

Plan plan(const std::string& points, const std::string& methods, std::uint64_t trials) {
  return make_plan(read_study({"s", "s.toml",
                               "experiment = \"ranging\"\ntrials = " + std::to_string(trials) +
                                   "\n[sweep]\npoints = " + points + "\n" + methods}));
}

const std::string ols = "[[method]]\nsolver = \"ols\"\n";
const std::string rr = "[[method]]\nsolver = \"rr\"\n";

}  // namespace

TEST_CASE("the shares of a study are all of it, each block once, and of nearly equal size") {
  for (const std::uint64_t trials : {1ULL, 4096ULL, 10'000ULL, 100'000ULL, 10'000'000ULL}) {
    const Plan all = plan("[3, 4, 5, 6, 7]", ols, trials);
    for (const std::uint64_t count : {1ULL, 2ULL, 3ULL, 7ULL, 12ULL, 64ULL}) {
      CAPTURE(trials, count);
      std::set<std::pair<std::size_t, std::uint64_t>> seen;
      std::vector<std::uint64_t> sizes;
      std::uint64_t blocks = 0;
      for (std::uint64_t number = 1; number <= count; ++number) {
        const Assignment share = assignment_of(all, all, {number, count});
        std::uint64_t size = 0;
        for (std::size_t place = 0; place < share.cells.size(); ++place)
          for (std::uint64_t block = 0; block < share.blocks_per_cell(); ++block)
            if (share.contains(place, block)) {
              CHECK(seen.emplace(place, block).second);
              ++size;
            }
        CHECK(size == share.blocks());
        sizes.push_back(size);
        blocks += size;
      }
      CHECK(blocks == everything(all).blocks());
      const auto [least, most] = std::minmax_element(sizes.begin(), sizes.end());
      // One run more or less, and the last run of each of the 5 cells may be shorter than the others.
      const std::uint64_t longest_run = std::max<std::uint64_t>(1, blocks / 5 / (16 * count));
      CHECK(*most - *least <= 1 + 6 * (longest_run - 1));
    }
  }
}

TEST_CASE("an assignment finds cells and methods of a study in a wider one, wherever they stand") {
  const Plan wide = plan("[3, 4, 5, 6, 7]", rr + ols, 1000);
  const Plan asked = plan("[7, 4]", ols, 500);
  const Assignment assignment = assignment_of(wide, asked, {});
  CHECK(assignment.cells == std::vector<std::size_t>{1, 4});
  CHECK(assignment.methods == std::vector<std::size_t>{1, 2});  // ols and the scene
  CHECK(assignment.trials == 500);
  CHECK(assignment.range(0).count == 500);
}

TEST_CASE("the order of the axes does not change what a cell is") {
  const auto hashes = [](const std::string& sweep) {
    std::set<std::string> set;
    const Plan plan = make_plan(read_study({"s", "s.toml", "experiment = \"ranging\"\n[sweep]\n" + sweep + ols}));
    for (const auto& cell : plan.header.cells) set.insert(cell.hash);
    return set;
  };
  CHECK(hashes("points = [3, 4]\nrange_sigma_m = [0.1, 0.2]\n") ==
        hashes("range_sigma_m = [0.2, 0.1]\npoints = [4, 3]\n"));
}
