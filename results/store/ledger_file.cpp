#include "results/store/ledger_file.hpp"

#include <fmt/format.h>

#include <array>
#include <stdexcept>
#include <utility>

#include "core/error.hpp"

namespace ridgeloc::results {
namespace {

using Counts = std::vector<std::uint64_t>;
using Reals = std::vector<double>;

/// The datasets of /ledger: those per row, per row and event, per row and metric, and ragged ones with
/// offsets.
struct RowColumns {
  Counts cell, method, first_block, blocks, trials;
  std::vector<std::uint8_t> reports_events;
  Counts events;
  Counts n, beyond;
  Reals mean, m2, m3, m4, min, max;
  Counts histogram_offset{0};
  std::vector<std::uint32_t> histogram_bin;
  Counts histogram_count;
  Counts digest_offset{0}, digest;
};

void append_values(RowColumns& columns, const MetricStatistics& metric) {
  columns.n.push_back(metric.moments.n);
  columns.beyond.push_back(metric.beyond);
  columns.mean.push_back(metric.moments.mean);
  columns.m2.push_back(metric.moments.m2);
  columns.m3.push_back(metric.moments.m3);
  columns.m4.push_back(metric.moments.m4);
  columns.min.push_back(metric.min);
  columns.max.push_back(metric.max);
  for (const Histogram::Bin& bin : metric.histogram.bins()) {
    columns.histogram_bin.push_back(bin.number);
    columns.histogram_count.push_back(bin.count);
  }
  columns.histogram_offset.push_back(columns.histogram_count.size());
}

void append_values(RowColumns& columns, const Row& row, std::size_t events) {
  columns.cell.push_back(row.cell);
  columns.method.push_back(row.method);
  columns.first_block.push_back(row.first_block);
  columns.blocks.push_back(row.blocks);
  columns.trials.push_back(row.statistics.trials);
  columns.reports_events.push_back(row.statistics.events.empty() ? 0 : 1);
  columns.events.insert(columns.events.end(), row.statistics.events.begin(), row.statistics.events.end());
  columns.events.resize(columns.cell.size() * events);
  for (const MetricStatistics& metric : row.statistics.metrics) append_values(columns, metric);
  columns.digest.insert(columns.digest.end(), row.digests.begin(), row.digests.end());
  columns.digest_offset.push_back(columns.digest.size());
}

/// Calls f(name, column) for the datasets per row, then g for those per row and metric: one list for both
/// directions.
template <typename AnyColumns, typename PerRow, typename PerMetric>
void visit(AnyColumns& columns, PerRow&& f, PerMetric&& g) {
  f("cell", columns.cell);
  f("method", columns.method);
  f("first_block", columns.first_block);
  f("blocks", columns.blocks);
  f("trials", columns.trials);
  f("reports_events", columns.reports_events);
  g("n", columns.n);
  g("beyond", columns.beyond);
  g("mean", columns.mean);
  g("m2", columns.m2);
  g("m3", columns.m3);
  g("m4", columns.m4);
  g("min", columns.min);
  g("max", columns.max);
}

std::string ledger_path(const char* name) {
  return fmt::format("/ledger/{}", name);
}

[[noreturn]] void fail(const hdf5::File& file, std::string_view what) {
  throw core::IoError(fmt::format("{} is damaged: /ledger {}", file.path().string(), what));
}

void require_offsets(const hdf5::File& file, const Counts& offsets, std::size_t pieces, std::size_t total) {
  bool good = offsets.size() == pieces + 1 && offsets.front() == 0 && offsets.back() == total;
  for (std::size_t i = 0; good && i < pieces; ++i) good = offsets[i] <= offsets[i + 1];
  if (!good) fail(file, "has offsets that do not fit");
}

/// Before version 2.0 a histogram was a first bin and the counts of all from there on, on a grid of 1922 bins: bin 0
/// for all below 2^-40, the last one for all from 2^20 on, which now count as infinite.
std::vector<std::uint32_t> bins_before_2(const hdf5::File& file, const Counts& offsets, std::size_t total) {
  constexpr std::uint32_t last = 1921;
  constexpr std::uint32_t first_of_octave_minus_40 = (1023 - 40) * Histogram::bins_per_octave;
  const auto first_bins = file.read<std::uint32_t>(ledger_path("histogram_first_bin"));
  if (first_bins.size() + 1 != offsets.size()) fail(file, "has histograms without a first bin");
  std::vector<std::uint32_t> bins;
  bins.reserve(total);
  for (std::size_t i = 0; i < first_bins.size(); ++i) {
    const std::uint64_t count = offsets[i + 1] - offsets[i];
    if (first_bins[i] > last + 1 || count > last + 1 - first_bins[i])
      fail(file, "has a histogram with bins outside the grid");
    for (std::uint64_t b = first_bins[i]; b < first_bins[i] + count; ++b) {
      const auto inner = static_cast<std::uint32_t>(first_of_octave_minus_40 + b - 1);
      bins.push_back(b == 0 ? 0 : b == last ? Histogram::infinite_bin : inner);
    }
  }
  return bins;
}

RowColumns read_columns(const hdf5::File& file, const Schema& schema) {
  RowColumns columns;
  const auto read = [&file](const char* name, auto& column, std::size_t size) {
    column = file.read<typename std::decay_t<decltype(column)>::value_type>(ledger_path(name));
    if (column.size() != size) fail(file, fmt::format("has {} values in {} instead of {}", column.size(), name, size));
  };
  const std::size_t rows = file.read<std::uint64_t>(ledger_path("cell")).size();
  const std::size_t metrics = schema.metrics.size();
  visit(
      columns, [&](const char* name, auto& column) { read(name, column, rows); },
      [&](const char* name, auto& column) { read(name, column, rows * metrics); });
  read("events", columns.events, rows * schema.events.size());
  columns.histogram_offset = file.read<std::uint64_t>(ledger_path("histogram_offset"));
  columns.histogram_count = file.read<std::uint64_t>(ledger_path("histogram_count"));
  const std::size_t bins = columns.histogram_count.size();
  require_offsets(file, columns.histogram_offset, rows * metrics, bins);
  if (file.contains(ledger_path("histogram_bin"))) {
    read("histogram_bin", columns.histogram_bin, bins);
  } else {
    columns.histogram_bin = bins_before_2(file, columns.histogram_offset, bins);
  }
  columns.digest_offset = file.read<std::uint64_t>(ledger_path("digest_offset"));
  columns.digest = file.read<std::uint64_t>(ledger_path("digest"));
  require_offsets(file, columns.digest_offset, rows, columns.digest.size());
  return columns;
}

template <typename T>
std::vector<T> piece(const std::vector<T>& values, std::uint64_t begin, std::uint64_t end) {
  const auto at = [&values](std::uint64_t i) { return values.begin() + static_cast<std::ptrdiff_t>(i); };
  return {at(begin), at(end)};
}

MetricStatistics metric_at(const RowColumns& columns, std::size_t i) {
  MetricStatistics metric;
  metric.moments = {columns.n[i], columns.mean[i], columns.m2[i], columns.m3[i], columns.m4[i]};
  metric.beyond = columns.beyond[i];
  metric.min = columns.min[i];
  metric.max = columns.max[i];
  std::vector<Histogram::Bin> bins;
  for (std::uint64_t b = columns.histogram_offset[i]; b < columns.histogram_offset[i + 1]; ++b) {
    // Before version 2.0 empty bins between others were stored.
    if (columns.histogram_count[b] > 0) bins.push_back({columns.histogram_bin[b], columns.histogram_count[b]});
  }
  metric.histogram = Histogram(std::move(bins));
  return metric;
}

Row row_at(const hdf5::File& file, const RowColumns& columns, const Header& header, std::size_t r) {
  Row row{columns.cell[r], columns.method[r], columns.first_block[r], columns.blocks[r], {}, {}};
  if (row.cell >= header.cells.size() || row.method >= header.methods.size())
    fail(file, "has a row of an unknown cell or method");
  row.statistics.trials = columns.trials[r];
  const std::size_t events = header.schema.events.size();
  if (columns.reports_events[r] != 0) row.statistics.events = piece(columns.events, r * events, (r + 1) * events);
  const std::size_t metrics = header.schema.metrics.size();
  for (std::size_t m = 0; m < metrics; ++m) row.statistics.metrics.push_back(metric_at(columns, r * metrics + m));
  row.digests = piece(columns.digest, columns.digest_offset[r], columns.digest_offset[r + 1]);
  return row;
}

}  // namespace

void write_ledger(hdf5::File& file, const Ledger& ledger, const Schema& schema) {
  RowColumns columns;
  for (const Row& row : ledger.rows()) append_values(columns, row, schema.events.size());

  const std::uint64_t rows = ledger.size();
  const auto write = [&file](const char* name, const auto& column, hdf5::Shape shape) {
    using Value = typename std::decay_t<decltype(column)>::value_type;
    const auto layout = std::is_same_v<Value, double> ? hdf5::Layout::Contiguous : hdf5::Layout::Compressed;
    file.write(ledger_path(name), column, std::move(shape), layout);
  };
  file.create_group("/ledger");
  visit(
      columns, [&](const char* name, const auto& column) { write(name, column, {rows}); },
      [&](const char* name, const auto& column) {
        write(name, column, {rows, schema.metrics.size()});
      });
  write("events", columns.events, {rows, schema.events.size()});
  write("histogram_offset", columns.histogram_offset, {columns.histogram_offset.size()});
  write("histogram_bin", columns.histogram_bin, {columns.histogram_bin.size()});
  write("histogram_count", columns.histogram_count, {columns.histogram_count.size()});
  write("digest_offset", columns.digest_offset, {columns.digest_offset.size()});
  file.write(ledger_path("digest"), columns.digest);  // random bits: compression would only cost time
}

Ledger read_ledger(const hdf5::File& file, const Header& header) {
  const RowColumns columns = read_columns(file, header.schema);
  Ledger ledger(header.block_trials);
  try {
    for (std::size_t r = 0; r < columns.cell.size(); ++r) ledger.insert(row_at(file, columns, header, r));
  } catch (const std::invalid_argument& error) {
    fail(file, fmt::format("has an impossible row: {}", error.what()));
  }
  const Row* previous = nullptr;
  for (const Row& row : ledger.rows()) {
    const bool same = previous != nullptr && previous->cell == row.cell && previous->method == row.method;
    if (same && previous->statistics.events.size() != row.statistics.events.size())
      fail(file, "has rows of a method with and without events");
    previous = &row;
  }
  return ledger;
}

}  // namespace ridgeloc::results
