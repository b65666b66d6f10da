#include "results/blocks/failure_list.hpp"

#include <numeric>

#include "results/blocks/block.hpp"
#include "results/store/result_file.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/sample_result.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace ridgeloc;
using namespace ridgeloc::results;

namespace {

std::vector<std::uint64_t> range(std::uint64_t begin, std::uint64_t end) {
  std::vector<std::uint64_t> numbers(end - begin);
  std::iota(numbers.begin(), numbers.end(), begin);
  return numbers;
}

}  // namespace

TEST_CASE("a failure list keeps the lowest trials of each key, in whatever order they come") {
  const FailureKey key{1, 2, 0};
  const std::vector<std::vector<std::uint64_t>> pieces = {range(500, 580), range(0, 30), range(200, 260),
                                                          range(20, 40)};
  FailureList forward, backward;
  for (const auto& piece : pieces) forward.insert(key, piece);
  for (auto piece = pieces.rbegin(); piece != pieces.rend(); ++piece) {
    FailureList one;
    one.insert(key, *piece);
    backward.insert(one);
  }
  CHECK(forward == backward);
  std::vector<std::uint64_t> expected = range(0, 40);
  const auto more = range(200, 260);
  expected.insert(expected.end(), more.begin(), more.end());
  REQUIRE(expected.size() == FailureList::limit);
  CHECK(forward.trials().at(key) == expected);
  CHECK(forward.trials().size() == 1);
}

TEST_CASE("reasons are the statuses that are failures, then the metrics that raise an alarm") {
  Header header = tests::sample_header();
  CHECK(failure_reasons(header.schema) == std::vector<std::string>{"diverged"});
  header.schema.metrics[1].alarm = "checked";
  CHECK(failure_reasons(header.schema) == std::vector<std::string>{"diverged", "iterations"});
}

TEST_CASE("a block lists its failed trials and alarms by their number in the cell") {
  Header header = tests::sample_header();
  header.schema.metrics[0].alarm = "checked";
  header.schema.metrics[1].alarm = "checked too";
  BlockSink sink(header, 2, 3, 5, {{1, BlockMethods::unwanted}, {}});
  const std::vector<std::uint8_t> status = {2, 1, 1, 2, 0};
  for (const std::size_t method : {0, 1}) {
    sink.status(method, status);
    sink.metric(method, 0, std::vector<double>{0.0, 1.0, std::nan(""), 0.5, 1.0});
    sink.sparse_metric(method, 1, std::vector<std::size_t>{1, 4}, std::vector<double>{0.0, 1.0});
  }
  const std::uint64_t first = 3 * tests::sample_block_trials;
  const auto trials = sink.take_failures().trials();
  REQUIRE(trials.size() == 3);  // nothing of the unwanted method
  CHECK(trials.at({2, 1, 0}) == std::vector<std::uint64_t>{first, first + 3});
  CHECK(trials.at({2, 1, 1}) == std::vector<std::uint64_t>{first + 1, first + 4});
  CHECK(trials.at({2, 1, 2}) == std::vector<std::uint64_t>{first + 4});
}

TEST_CASE("a result lists the failures that its trials have") {
  const tests::ScratchFolder folder;
  const Header header = tests::sample_header();
  tests::write_sample(folder / "result.h5", header);
  const FailureList failures = read_result_failures(folder / "result.h5");
  const Summary summary = read_result(folder / "result.h5");
  std::size_t listed = 0;
  for (std::size_t cell = 0; cell < header.cells.size(); ++cell) {
    for (const std::size_t method : {0, 1}) {
      const auto& trials = failures.trials().at({cell, method, 0});
      CHECK(trials.size() == summary.of(cell, method).events[2]);
      const TrialTable kept = read_trials(folder / "result.h5", cell, method);
      for (std::size_t i = 0; i < kept.trial.size(); ++i)
        CHECK((kept.status[i] == 2) == (std::ranges::find(trials, kept.trial[i]) != trials.end()));
      listed += trials.size();
    }
  }
  CHECK(listed > 50);
}
