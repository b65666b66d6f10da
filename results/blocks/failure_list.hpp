#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "results/schema/schema.hpp"

namespace ridgeloc::results {

/// What a list of failures is about: a method in a cell, and why its trials failed, as an index into
/// `failure_reasons`.
struct FailureKey {
  std::size_t cell = 0;
  std::size_t method = 0;
  std::size_t reason = 0;

  friend auto operator<=>(const FailureKey&, const FailureKey&) = default;
};

/// The first failed trials of each cell, method and reason, so that they can be looked at one by one. Their numbers in
/// all are among the events and metrics.
///
/// It holds the lowest trial numbers of all that were inserted: a union does not depend on the order.
class FailureList {
 public:
  /// Trials kept per cell, method and reason.
  static constexpr std::size_t limit = 100;

  /// Precondition: trials ascend.
  void insert(const FailureKey& key, std::span<const std::uint64_t> trials);
  void insert(const FailureList& other);

  /// Trial numbers, ascending, by key.
  const std::map<FailureKey, std::vector<std::uint64_t>>& trials() const { return trials_; }
  bool empty() const { return trials_.empty(); }

  friend bool operator==(const FailureList&, const FailureList&) = default;

 private:
  std::map<FailureKey, std::vector<std::uint64_t>> trials_;
};

/// Names of the reasons: the statuses that are failures, then the metrics that raise an alarm.
std::vector<std::string> failure_reasons(const Schema& schema);

}  // namespace ridgeloc::results
