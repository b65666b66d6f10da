#include "results/blocks/block.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <stdexcept>
#include <utility>

namespace ridgeloc::results {
namespace {

// Mark what a column is in the digest, so that equal bytes of different meaning differ.
enum Kind : std::uint64_t { kind_status = 1, kind_event = 2, kind_metric = 3, kind_sparse_metric = 4 };

}  // namespace

std::uint64_t kept_trials(const Header& header, std::uint64_t block, std::uint64_t trials) {
  if (block > header.kept_trials / header.block_trials) return 0;
  return std::min(trials, header.kept_trials - block * header.block_trials);
}

std::size_t TrialColumns::bytes() const {
  return sizeof(TrialColumns) + sizeof(std::vector<double>) * metrics.size() + value_bytes();
}

std::size_t TrialColumns::value_bytes() const {
  std::size_t bytes = status.size();
  for (const std::vector<double>& column : metrics) bytes += sizeof(double) * column.size();
  return bytes;
}

BlockMethods all_methods(const Header& header) {
  BlockMethods all;
  for (std::size_t m = 0; m < header.methods.size(); ++m) {
    if (const auto& pair = header.methods[m].difference) {
      all.differences.push_back({m, (*pair)[0], (*pair)[1]});
    } else {
      all.numbers.push_back(m);
    }
  }
  return all;
}

BlockSink::BlockSink(const Header& header, std::size_t cell, std::uint64_t block, std::uint64_t trials,
                     BlockMethods methods)
    : cell_(cell),
      block_(block),
      trials_(trials),
      first_trial_(block * header.block_trials),
      events_(header.schema.events.size()),
      statuses_(header.schema.statuses),
      kept_(kept_trials(header, block, trials)),
      methods_(methods.numbers.size()),
      differences_(std::move(methods.differences)) {
  if (cell >= header.cells.size() || trials == 0 || trials > header.block_trials)
    throw std::invalid_argument(fmt::format("cell {} with {} trials is not a block of the study", cell, trials));
  const std::size_t metrics = header.schema.metrics.size();
  for (std::size_t m = 0; m < methods_.size(); ++m) {
    PerMethod& method = methods_[m];
    method.number = methods.numbers[m];
    method.statistics.trials = trials;
    method.statistics.metrics.resize(metrics);
    method.columns.metrics.resize(metrics);
  }
  for (const BlockMethods::Difference& difference : differences_) {
    for (const std::size_t operand : {difference.minuend, difference.subtrahend}) {
      methods_.at(operand).is_compared = true;
      methods_.at(operand).compared.resize(metrics);
    }
  }
  // The order of `failure_reasons`.
  std::size_t reasons = 0;
  for (std::size_t s = 0; s < statuses_; ++s)
    status_reason_.push_back(header.schema.events[s].is_failure ? reasons++ : no_reason);
  for (const MetricInfo& metric : header.schema.metrics) {
    metric_reason_.push_back(metric.alarm.empty() ? no_reason : reasons++);
    is_compared_.push_back(metric.is_compared ? 1 : 0);
  }
}

BlockSink::PerMethod& BlockSink::begin_column(std::size_t method, std::uint64_t kind, std::size_t index,
                                              std::span<const std::byte> bytes, std::size_t values) {
  if (values != trials_)
    throw std::invalid_argument(fmt::format("a column of {} values for a block of {} trials", values, trials_));
  PerMethod& target = methods_.at(method);
  target.digest.update(kind);
  target.digest.update(index);
  target.digest.update(bytes);
  return target;
}

std::vector<std::uint64_t>& BlockSink::events_of(PerMethod& method) const {
  method.statistics.events.resize(events_);
  return method.statistics.events;
}

void BlockSink::status(std::size_t method, std::span<const std::uint8_t> codes) {
  PerMethod& target = begin_column(method, kind_status, 0, std::as_bytes(codes), codes.size());
  std::vector<std::uint64_t>& counts = events_of(target);
  for (const std::uint8_t code : codes) {
    if (code >= statuses_) throw std::invalid_argument(fmt::format("{} is not a status code of the schema", code));
    ++counts[code];
  }
  note_failures(target, codes);
  target.has_columns = true;
  const auto kept = codes.first(kept_);
  target.columns.status.assign(kept.begin(), kept.end());
}

void BlockSink::note_failures(const PerMethod& method, std::span<const std::uint8_t> codes) {
  if (method.number == BlockMethods::unwanted) return;
  for (std::size_t status = 0; status < statuses_; ++status) {
    const std::uint64_t count = method.statistics.events[status];
    if (status_reason_[status] == no_reason || count == 0) continue;
    std::vector<std::uint64_t> trials;
    const std::size_t wanted = std::min<std::uint64_t>(count, FailureList::limit);
    for (std::size_t t = 0; trials.size() < wanted; ++t)
      if (codes[t] == status) trials.push_back(first_trial_ + t);
    failures_.insert({cell_, method.number, status_reason_[status]}, trials);
  }
}

template <class SlotOf>
void BlockSink::note_alarms(const PerMethod& method, std::size_t metric, std::span<const double> values,
                            SlotOf&& slot_of) {
  const std::size_t reason = metric_reason_[metric];
  if (method.number == BlockMethods::unwanted || reason == no_reason) return;
  std::vector<std::uint64_t> trials;
  for (std::size_t i = 0; i < values.size() && trials.size() < FailureList::limit; ++i)
    if (values[i] == 1.0) trials.push_back(first_trial_ + slot_of(i));
  failures_.insert({cell_, method.number, reason}, trials);
}

void BlockSink::event(std::size_t method, std::size_t event, std::span<const std::uint8_t> flags) {
  if (event < statuses_ || event >= events_)
    throw std::invalid_argument(fmt::format("event {} is not one that is given as flags", event));
  PerMethod& target = begin_column(method, kind_event, event, std::as_bytes(flags), flags.size());
  events_of(target)[event] += static_cast<std::uint64_t>(
      std::count_if(flags.begin(), flags.end(), [](std::uint8_t flag) { return flag != 0; }));
}

void BlockSink::metric(std::size_t method, std::size_t metric, std::span<const double> values) {
  PerMethod& target = begin_column(method, kind_metric, metric, std::as_bytes(values), values.size());
  target.statistics.metrics.at(metric) = statistics_of(values);
  note_alarms(target, metric, values, std::identity());
  if (target.is_compared && is_compared_[metric] != 0) target.compared[metric].assign(values.begin(), values.end());
  target.has_columns = true;
  const auto kept = values.first(kept_);
  target.columns.metrics[metric].assign(kept.begin(), kept.end());
}

void BlockSink::sparse_metric(std::size_t method, std::size_t metric, std::span<const std::size_t> trials,
                              std::span<const double> values) {
  if (trials.size() != values.size() || (!trials.empty() && trials.back() >= trials_))
    throw std::invalid_argument(
        fmt::format("{} values of {} trials for a block of {}", values.size(), trials.size(), trials_));
  PerMethod& target = methods_.at(method);
  target.digest.update(kind_sparse_metric);
  target.digest.update(metric);
  target.digest.update(values.size());
  for (const std::size_t trial : trials) target.digest.update(trial);
  target.digest.update(std::as_bytes(values));
  target.statistics.metrics.at(metric) = statistics_of(values);
  target.has_columns = true;
  note_alarms(target, metric, values, [&](std::size_t i) { return trials[i]; });
  std::vector<double>& column = target.columns.metrics[metric];
  column.assign(kept_, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < trials.size() && trials[i] < kept_; ++i) column[trials[i]] = values[i];
}

Row BlockSink::difference_row(const BlockMethods::Difference& difference) const {
  const PerMethod& a = methods_[difference.minuend];
  const PerMethod& b = methods_[difference.subtrahend];
  Row row{cell_, difference.number, block_, 1, {}, {}};
  row.statistics.trials = trials_;
  row.statistics.metrics.resize(is_compared_.size());
  Digest64 digest;
  std::vector<double> values(trials_);
  for (std::size_t m = 0; m < is_compared_.size(); ++m) {
    if (a.compared[m].empty() || b.compared[m].empty()) continue;
    // Where either is not in the population it is NaN, and so is the difference.
    for (std::size_t t = 0; t < values.size(); ++t) values[t] = a.compared[m][t] - b.compared[m][t];
    digest.update(kind_metric);
    digest.update(m);
    digest.update(std::as_bytes(std::span(values)));
    row.statistics.metrics[m] = statistics_of(values);
  }
  row.digests.push_back(digest.value());
  return row;
}

std::vector<Row> BlockSink::take_rows() {
  std::vector<Row> rows;
  for (PerMethod& method : methods_) {
    if (method.number == BlockMethods::unwanted) continue;
    rows.push_back({cell_, method.number, block_, 1, std::move(method.statistics), {method.digest.value()}});
  }
  for (const BlockMethods::Difference& difference : differences_) rows.push_back(difference_row(difference));
  return rows;
}

std::vector<TrialColumns> BlockSink::take_columns() {
  std::vector<TrialColumns> kept;
  if (kept_ == 0) return kept;
  for (PerMethod& method : methods_) {
    if (!method.has_columns || method.number == BlockMethods::unwanted) continue;
    TrialColumns columns = std::move(method.columns);
    columns.cell = cell_;
    columns.method = method.number;
    columns.block = block_;
    columns.trials = kept_;
    kept.push_back(std::move(columns));
  }
  return kept;
}

FailureList BlockSink::take_failures() {
  return std::move(failures_);
}

}  // namespace ridgeloc::results
