#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "results/summary/measure.hpp"
#include "results/summary/summary.hpp"

/// Which method is best, and whether the trials show it.
namespace ridgeloc::results {

/// The measures by which methods can be ranked, less being better: the metrics by which they are compared, of those
/// that have the unit of the first.
std::vector<Measure> ranking_measures(const Summary& summary);

/// The one of them that all trials have, so that no method gains by failing where it would be bad; else the first. None
/// where methods are not compared.
std::optional<Measure> ranking_measure(const Summary& summary);

/// The methods of one cell, from which the best one stands out or not.
struct Ranking {
  std::size_t best = 0;             ///< the method with the smallest leading number
  std::vector<std::size_t> rivals;  ///< those that are not shown to be worse

  bool is_significant() const { return rivals.empty(); }
};

/// Ranks methods in a cell by one of the `ranking_measures`. None where fewer than two of them have values.
///
/// The best one is better than another of which the difference of means, trial by trial, is below 0 with a two-sided
/// confidence of 1 - 0.05 / k, k the number of others (Bonferroni), and reliable. Where the two are not compared with
/// each other, the standard error of the difference of the means a and b is taken as s(a) + s(b), or, if that is less
/// and both are compared with c, as s(a - c) + s(b - c): what it is at most, however the trials go together.
///
/// Where the leading number is the median, means may be of no use, and the best one is also better than another whose
/// median is larger by that measure: the standard errors that the two 95 % intervals stand for, added. Each of the two
/// looks then has half of the chance to be wrong.
std::optional<Ranking> ranking_of(const Summary& summary, std::size_t cell, const std::vector<std::size_t>& methods,
                                  const Measure& measure);

}  // namespace ridgeloc::results
