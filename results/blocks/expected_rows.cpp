#include "results/blocks/expected_rows.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

namespace ridgeloc::results {
namespace {

/// Chance that is the same whenever it is asked: counts that are all multiples of one number would compress too well.
using Chance = std::mt19937_64;

std::uint64_t scaled(std::uint64_t count, double factor) {
  return static_cast<std::uint64_t>(std::llround(static_cast<double>(count) * factor));
}

/// A count as it comes about by chance where a share of these trials, or so many times as many, are run.
std::uint64_t drawn_count(std::uint64_t count, double factor, Chance& chance) {
  if (factor < 1.0) return std::binomial_distribution<std::uint64_t>(count, factor)(chance);
  // More trials leave no bin empty that had one.
  return std::max(std::poisson_distribution<std::uint64_t>(static_cast<double>(count) * factor)(chance),
                  std::uint64_t{1});
}

std::vector<Histogram::Bin> drawn_bins(const Histogram& histogram, double factor, Chance& chance) {
  std::vector<Histogram::Bin> bins;
  for (const Histogram::Bin& bin : histogram.bins())
    if (const std::uint64_t count = drawn_count(bin.count, factor, chance); count > 0)
      bins.push_back({bin.number, count});
  return bins;
}

/// Adds what more trials find, in the gaps and above. The later one is found the fewer trials it has in the end.
void add_found(std::vector<Histogram::Bin>& bins, double found, double factor) {
  const std::size_t known = bins.size();
  std::uint32_t number = bins.front().number;
  auto next = std::size_t{0};
  for (double i = 0.5; i < found && number < Histogram::infinite_bin; ++number) {
    if (next < known && bins[next].number == number) {
      ++next;
      continue;
    }
    bins.push_back({number, std::max(scaled(1, std::pow(factor, 1.0 - i / found)), std::uint64_t{1})});
    ++i;
  }
  std::ranges::sort(bins, {}, &Histogram::Bin::number);
}

Histogram expected_histogram(const Histogram& histogram, double factor, Chance& chance) {
  std::vector<Histogram::Bin> bins = drawn_bins(histogram, factor, chance);
  if (factor > 1.0 && !bins.empty()) {
    const auto alone = std::ranges::count(histogram.bins(), std::uint64_t{1}, &Histogram::Bin::count);
    add_found(bins, static_cast<double>(alone) * std::log(factor), factor);
  }
  return Histogram(std::move(bins));
}

Row expected_row(const Row& row, std::uint64_t number, std::uint64_t trials, Chance& chance) {
  const double factor = static_cast<double>(trials) / static_cast<double>(row.statistics.trials);
  Row expected = row;
  expected.first_block = number;
  expected.blocks = 1;
  expected.digests = {chance()};
  expected.statistics.trials = trials;
  for (std::uint64_t& event : expected.statistics.events) event = scaled(event, factor);
  for (MetricStatistics& metric : expected.statistics.metrics) {
    metric.moments.n = scaled(metric.moments.n, factor);
    metric.beyond = scaled(metric.beyond, factor);
    metric.histogram = expected_histogram(metric.histogram, factor, chance);
  }
  return expected;
}

}  // namespace

std::vector<Row> expected_rows(const Row& row, std::uint64_t trials, std::uint64_t block_trials) {
  Chance chance(row.digests.front());
  std::vector<Row> rows;
  const auto add = [&](std::uint64_t of_row) { rows.push_back(expected_row(row, rows.size(), of_row, chance)); };
  for (std::uint64_t blocks = trials / block_trials; blocks > 0; blocks -= std::bit_floor(blocks))
    add(std::bit_floor(blocks) * block_trials);
  if (trials % block_trials > 0) add(trials % block_trials);
  return rows;
}

}  // namespace ridgeloc::results
