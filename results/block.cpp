#include "results/block.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace ridgeloc::results {
namespace {

// Mark what a column is in the digest, so that equal bytes of different meaning differ.
enum Kind : std::uint64_t { kind_status = 1, kind_event = 2, kind_metric = 3, kind_sparse_metric = 4 };

}  // namespace

std::size_t TrialColumns::bytes() const {
  std::size_t bytes = sizeof(TrialColumns) + status.size();
  for (const std::vector<double>& column : metrics) bytes += sizeof(column) + sizeof(double) * column.size();
  return bytes;
}

BlockSink::BlockSink(const Header& header, std::size_t cell, std::uint64_t block, std::uint64_t trials)
    : cell_(cell),
      block_(block),
      trials_(trials),
      events_(header.schema.events.size()),
      statuses_(header.schema.statuses),
      keeps_columns_(block < header.trial_column_blocks),
      methods_(header.methods.size()) {
  if (cell >= header.cells.size() || trials == 0 || trials > header.block_trials)
    throw std::invalid_argument(fmt::format("cell {} with {} trials is not a block of the study", cell, trials));
  for (PerMethod& method : methods_) {
    method.statistics.trials = trials;
    method.statistics.metrics.resize(header.schema.metrics.size());
    method.columns.metrics.resize(header.schema.metrics.size());
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
  target.has_columns = true;
  if (keeps_columns_) target.columns.status.assign(codes.begin(), codes.end());
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
  target.has_columns = true;
  if (keeps_columns_) target.columns.metrics[metric].assign(values.begin(), values.end());
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
  if (!keeps_columns_) return;
  std::vector<double>& column = target.columns.metrics[metric];
  column.assign(trials_, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < trials.size(); ++i) column[trials[i]] = values[i];
}

std::vector<Row> BlockSink::take_rows() {
  std::vector<Row> rows;
  for (std::size_t m = 0; m < methods_.size(); ++m)
    rows.push_back({cell_, m, block_, 1, std::move(methods_[m].statistics), {methods_[m].digest.value()}});
  return rows;
}

std::vector<TrialColumns> BlockSink::take_columns() {
  std::vector<TrialColumns> kept;
  if (!keeps_columns_) return kept;
  for (std::size_t m = 0; m < methods_.size(); ++m) {
    if (!methods_[m].has_columns) continue;
    TrialColumns columns = std::move(methods_[m].columns);
    columns.cell = cell_;
    columns.method = m;
    columns.block = block_;
    columns.trials = trials_;
    kept.push_back(std::move(columns));
  }
  return kept;
}

}  // namespace ridgeloc::results
