#include "studies/run/verification.hpp"

#include <set>

#include "results/blocks/block.hpp"
#include "studies/files/study_reader.hpp"
#include "studies/plan/assignment.hpp"
#include "studies/registry.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/simulation.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;

namespace {

struct Computed {
  Study study = read_study({"s", "s.toml", R"(
experiment = "ranging"
trials = 9000
[sweep]
points = [3, 5]
[[method]]
solver = "ols"
[[method]]
solver = "rrr"
)"});
  Plan plan = make_plan(study);

  std::vector<results::Row> rows_of(const BlockNumber& where) const {
    const TrialRange range = everything(plan).range(where.block);
    results::BlockSink sink(plan.header, where.cell, where.block, range.count);
    tests::PreparedCell(study, plan.cells[where.cell], plan.isa, study.audit).run(range, sink);
    return sink.take_rows();
  }
};

}  // namespace

TEST_CASE("blocks that are what the ledger says are found equal, and a wrong digest is found") {
  const Computed computed;
  results::Ledger ledger(computed.plan.header.block_trials);
  const std::vector<BlockNumber> blocks = {{0, 0}, {0, 2}, {1, 1}};
  for (const BlockNumber& where : blocks) {
    for (results::Row& row : computed.rows_of(where)) {
      if (where == BlockNumber{0, 2} && row.method == 1) ++row.digests[0];
      ledger.insert(std::move(row));
    }
  }
  for (const int threads : {1, 2}) {
    const auto differences = differing_blocks(computed.study, computed.plan, ledger, blocks, *thread_queue(threads));
    REQUIRE(differences.size() == 1);
    CHECK(differences[0].where == BlockNumber{0, 2});
    CHECK(differences[0].method == 1);
  }
}

TEST_CASE("random blocks are different blocks of the ledger, those of their seed, and never more than there are") {
  const Computed computed;
  results::Ledger ledger(computed.plan.header.block_trials);
  for (const BlockNumber& where : {BlockNumber{0, 0}, BlockNumber{0, 1}, BlockNumber{1, 2}})
    for (results::Row& row : computed.rows_of(where)) ledger.insert(std::move(row));
  const std::vector<BlockNumber> all = all_blocks(ledger);
  CHECK(all == std::vector<BlockNumber>{{0, 0}, {0, 1}, {1, 2}});
  CHECK(all_blocks(results::Ledger(16)).empty());
  CHECK(random_choice(all, 2, 5).size() == 2);
  CHECK(random_choice(all, 1'000'000'000'000, 1) == all);
  CHECK(random_choice({}, 3, 1).empty());
  std::set<std::vector<BlockNumber>> seen;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    CHECK(random_choice(all, 2, seed) == random_choice(all, 2, seed));
    seen.insert(random_choice(all, 2, seed));
  }
  CHECK(seen.size() == 3);  // every pair, but for a chance of 3 (2/3)^100 = 7e-18
}
