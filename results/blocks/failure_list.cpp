#include "results/blocks/failure_list.hpp"

#include <algorithm>
#include <iterator>

namespace ridgeloc::results {

void FailureList::insert(const FailureKey& key, std::span<const std::uint64_t> trials) {
  if (trials.empty()) return;
  std::vector<std::uint64_t>& known = trials_[key];
  if (known.size() == limit && trials.front() >= known.back()) return;
  std::vector<std::uint64_t> both;
  std::ranges::set_union(known, trials, std::back_inserter(both));
  both.resize(std::min(both.size(), limit));
  known = std::move(both);
}

void FailureList::insert(const FailureList& other) {
  for (const auto& [key, trials] : other.trials_) insert(key, trials);
}

std::vector<std::string> failure_reasons(const Schema& schema) {
  std::vector<std::string> names;
  for (std::size_t s = 0; s < schema.statuses; ++s)
    if (schema.events[s].is_failure) names.push_back(schema.events[s].name);
  for (const MetricInfo& metric : schema.metrics)
    if (!metric.alarm.empty()) names.push_back(metric.name);
  return names;
}

}  // namespace ridgeloc::results
