#include "results/blocks/block.hpp"

#include <cmath>
#include <stdexcept>

#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "tests/support/catch.hpp"
#include "tests/support/same_bits.hpp"
#include "tests/support/sample_study.hpp"

using namespace ridgeloc;
using namespace ridgeloc::results;

namespace {

const std::vector<std::uint8_t> codes = {1, 2, 1, 1};
const std::vector<std::uint8_t> flags = {1, 0, 0, 1};
const std::vector<double> errors = {0.5, std::nan(""), 2.0, 0.25};

BlockSink filled(std::uint64_t block = 0) {
  BlockSink sink(tests::sample_header(), 1, block, 4);
  sink.status(0, codes);
  sink.event(0, 3, flags);
  sink.metric(0, 0, errors);
  return sink;
}

}  // namespace

TEST_CASE("a block is reduced to counts and statistics per method") {
  const std::vector<Row> rows = filled().take_rows();
  REQUIRE(rows.size() == 3);
  CHECK(rows[0].cell == 1);
  CHECK(rows[0].statistics.trials == 4);
  CHECK(rows[0].statistics.events == std::vector<std::uint64_t>{0, 3, 1, 2});
  CHECK(rows[0].statistics.metrics[0] == statistics_of(errors));
  CHECK(rows[0].statistics.metrics[1] == MetricStatistics{});
  CHECK(rows[1].statistics.events.empty());
  CHECK(rows[1].statistics.trials == 4);
}

TEST_CASE("columns are kept for the first trials of a cell alone") {
  const Header header = tests::sample_header();
  const std::vector<TrialColumns> kept = filled().take_columns();
  REQUIRE(kept.size() == 1);
  CHECK(kept[0].status == codes);
  CHECK(kept[0].metrics[0].size() == 4);
  CHECK(kept[0].metrics[0][3] == errors[3]);
  CHECK(kept[0].metrics[1].empty());
  const auto kept_of_block = [](std::uint64_t kept_trials) {
    Header few = tests::sample_header();
    few.kept_trials = kept_trials;
    BlockSink sink = tests::sample_block(few, 1, 1, few.block_trials);
    return sink.take_columns();
  };
  const std::uint64_t block = header.block_trials;
  CHECK(kept_of_block(block).empty());
  const std::vector<TrialColumns> whole = kept_of_block(2 * block);
  const std::vector<TrialColumns> part = kept_of_block(block + 3);
  REQUIRE(part.size() == whole.size());
  for (std::size_t m = 0; m < part.size(); ++m) {
    CHECK(part[m].trials == 3);
    CHECK(whole[m].trials == block);
    CHECK(std::ranges::equal(part[m].status, std::span(whole[m].status).first(part[m].status.size())));
    for (std::size_t k = 0; k < part[m].metrics.size(); ++k) {
      CHECK(part[m].metrics[k].size() == (whole[m].metrics[k].empty() ? 0 : 3));
      const std::vector<double> first(
          whole[m].metrics[k].begin(),
          whole[m].metrics[k].begin() + static_cast<std::ptrdiff_t>(part[m].metrics[k].size()));
      CHECK(tests::same_bits(part[m].metrics[k], first));
    }
  }
}

TEST_CASE("the digest of a method changes with every value it was given") {
  const auto digest = [](std::uint8_t code, std::uint8_t flag, double error, std::size_t metric) {
    BlockSink sink(tests::sample_header(), 1, 0, 1);
    sink.status(0, std::vector<std::uint8_t>{code});
    sink.event(0, 3, std::vector<std::uint8_t>{flag});
    sink.metric(0, metric, std::vector<double>{error});
    return sink.take_rows()[0].digests.at(0);
  };
  const std::uint64_t reference = digest(1, 1, 0.5, 0);
  CHECK(digest(1, 1, 0.5, 0) == reference);
  CHECK(digest(2, 1, 0.5, 0) != reference);
  CHECK(digest(1, 0, 0.5, 0) != reference);
  CHECK(digest(1, 1, std::nextafter(0.5, 1.0), 0) != reference);
  CHECK(digest(1, 1, 0.5, 1) != reference);
}

TEST_CASE("a metric of few trials is reduced and kept as its full column would be") {
  const std::vector<std::size_t> trials = {1, 3};
  const std::vector<double> values = {0.5, 2.0};
  BlockSink sink(tests::sample_header(), 1, 0, 5);
  sink.sparse_metric(0, 1, trials, values);
  const auto digest = [&](std::vector<std::size_t> which, std::vector<double> what, std::size_t metric) {
    BlockSink other(tests::sample_header(), 1, 0, 5);
    other.sparse_metric(0, metric, which, what);
    return other.take_rows()[0].digests.at(0);
  };
  const std::vector<TrialColumns> kept = sink.take_columns();
  REQUIRE(kept.size() == 1);
  REQUIRE(kept[0].metrics[1].size() == 5);
  CHECK(kept[0].metrics[1][1] == 0.5);
  CHECK(kept[0].metrics[1][3] == 2.0);
  for (const std::size_t t : {0, 2, 4}) CHECK(std::isnan(kept[0].metrics[1][t]));
  const std::vector<Row> rows = sink.take_rows();
  CHECK(rows[0].statistics.metrics[1] == statistics_of(values));
  CHECK(digest({1, 3}, {0.5, 2.0}, 1) == rows[0].digests.at(0));
  CHECK(digest({1, 4}, {0.5, 2.0}, 1) != rows[0].digests.at(0));
  CHECK(digest({1, 3}, {0.5, 2.5}, 1) != rows[0].digests.at(0));
  CHECK(digest({1, 3}, {0.5, 2.0}, 0) != rows[0].digests.at(0));
  // None at all: the block still reports the metric.
  BlockSink empty(tests::sample_header(), 1, 0, 5);
  empty.sparse_metric(0, 1, {}, {});
  CHECK(empty.take_columns()[0].metrics[1].size() == 5);
}

TEST_CASE("misuse of a block is refused") {
  BlockSink sink(tests::sample_header(), 1, 0, 4);
  CHECK_THROWS_AS(sink.metric(0, 0, std::vector<double>(3)), std::invalid_argument);
  CHECK_THROWS_AS(sink.sparse_metric(0, 0, std::vector<std::size_t>{4}, std::vector<double>(1)), std::invalid_argument);
  CHECK_THROWS_AS(sink.sparse_metric(0, 0, std::vector<std::size_t>{3}, std::vector<double>(2)), std::invalid_argument);
  CHECK_THROWS_AS(sink.status(0, std::vector<std::uint8_t>(4, 3)), std::invalid_argument);
  CHECK_THROWS_AS(sink.event(0, 1, flags), std::invalid_argument);
  CHECK_THROWS_AS(sink.event(0, 4, flags), std::invalid_argument);
  CHECK_THROWS_AS(BlockSink(tests::sample_header(), 5, 0, 4), std::invalid_argument);
  CHECK_THROWS_AS(BlockSink(tests::sample_header(), 0, 0, tests::sample_block_trials + 1), std::invalid_argument);
}

TEST_CASE("a difference of two methods is taken trial by trial, over the trials that both have") {
  Header header = tests::sample_header();
  header.schema.metrics[0].is_compared = true;
  header.methods.push_back({"rrr - ols", "d", "", std::array<std::size_t, 2>{1, 0}});
  BlockSink sink(header, 0, 0, 4, {{0, BlockMethods::unwanted}, {{3, 1, 0}}});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  sink.metric(0, 0, std::vector<double>{1.0, 2.0, nan, 4.0});
  sink.metric(1, 0, std::vector<double>{1.5, nan, 3.0, infinity});
  sink.metric(0, 1, std::vector<double>{1.0, 1.0, 1.0, 1.0});
  sink.metric(1, 1, std::vector<double>{2.0, 2.0, 2.0, 2.0});
  const std::vector<Row> rows = sink.take_rows();
  REQUIRE(rows.size() == 2);  // nothing of the unwanted method
  CHECK(rows[0].method == 0);
  CHECK(rows[1].method == 3);
  CHECK(rows[1].statistics.trials == 4);
  CHECK(rows[1].statistics.events.empty());
  const MetricStatistics& error = rows[1].statistics.metrics[0];
  CHECK(error.moments.n == 1);
  CHECK(error.moments.mean == 0.5);
  CHECK(error.beyond == 1);
  CHECK(rows[1].statistics.metrics[1].moments.n == 0);  // is not compared
}
