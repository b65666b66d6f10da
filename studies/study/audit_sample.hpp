#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/stream.hpp"
#include "studies/study/experiment.hpp"

namespace ridgeloc::studies {

/// Trials below this number are audited whatever the share, unless that is 0.
inline constexpr std::uint64_t always_audited = 100;

/// Which trials of every cell are solved again by the reference: trial t if t < `always_audited` or u(t) < share, where
/// u(t) is uniform on (0, 1), drawn from the seed on the grid (k + 1/2) 2^-32. A share of 0 audits nothing.
class AuditSample {
 public:
  explicit AuditSample(const StudyKey& key) : share_(key.audit), stream_(key.seed, "audit") {}

  /// Those among the trials of a block, counted from its first.
  std::vector<std::size_t> slots(TrialRange range) const;

 private:
  double share_;
  core::Stream stream_;
};

}  // namespace ridgeloc::studies
