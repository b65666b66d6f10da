#include "results/store/block_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "results/schema/places_by_hash.hpp"

namespace ridgeloc::results {
namespace {

namespace fs = std::filesystem;

/// The places that a cell or method of a file has in another header.
template <typename Info>
auto places_of(const PlacesByHash& wanted, const std::vector<Info>& found, std::size_t number, const fs::path& path,
               const char* what) {
  if (number >= found.size())
    throw core::IoError(fmt::format("{} is damaged: it names an unknown {}", path.string(), what));
  auto places = wanted.of(found[number].hash);
  if (places.empty())
    throw core::InputError(fmt::format(
        "{} holds a {} that the study has not; add it to the study, or choose another -o", path.string(), what));
  return places;
}

/// In a part all columns of a block lie one after the other.
void read_from_part(const hdf5::File& file, const StoredColumns& stored, TrialColumns& columns) {
  if (stored.has_status)
    columns.status = file.read<std::uint8_t>("/columns/status", stored.status_offset, stored.wanted);
  const auto given = stored.has_metric.size() - static_cast<std::size_t>(std::ranges::count(stored.has_metric, 0));
  const auto values = file.read<double>("/columns/value", stored.value_offset, given * stored.trials);
  auto begin = values.begin();
  for (std::size_t m = 0; m < stored.has_metric.size(); ++m) {
    if (stored.has_metric[m] == 0) continue;
    columns.metrics[m].assign(begin, begin + static_cast<std::ptrdiff_t>(stored.wanted));
    begin += static_cast<std::ptrdiff_t>(stored.trials);
  }
}

void read_from_result(const hdf5::File& file, const Schema& schema, const StoredColumns& stored,
                      TrialColumns& columns) {
  if (stored.has_status)
    columns.status = file.read<std::uint8_t>(stored.group + "/status", stored.status_offset, stored.wanted);
  for (std::size_t m = 0; m < stored.has_metric.size(); ++m)
    if (stored.has_metric[m] != 0)
      columns.metrics[m] =
          file.read<double>(stored.group + "/" + schema.metrics[m].name, stored.value_offset, stored.wanted);
}

TrialColumns read_one(const hdf5::File& file, const Schema& schema, const StoredColumns& stored) {
  TrialColumns columns{stored.cell, stored.method, stored.block, stored.wanted, {}, {}};
  columns.metrics.resize(stored.has_metric.size());
  if (stored.group.empty()) {
    read_from_part(file, stored, columns);
  } else {
    read_from_result(file, schema, stored, columns);
  }
  return columns;
}

std::vector<std::string> names_of(const Schema& schema) {
  std::vector<std::string> names;
  for (const MetricInfo& metric : schema.metrics) names.push_back(metric.name);
  for (const EventInfo& event : schema.events) names.push_back(event.name);
  return names;
}

}  // namespace

std::vector<TrialColumns> read_columns(const fs::path& path, const Schema& schema,
                                       const std::vector<StoredColumns>& stored) {
  const hdf5::File file = hdf5::File::open(path);
  std::vector<TrialColumns> list;
  for (const StoredColumns& block : stored) list.push_back(read_one(file, schema, block));
  return list;
}

void require_same_study(const Header& found, const Header& wanted, const std::string& what) {
  if (found.experiment == wanted.experiment && found.experiment_version != wanted.experiment_version)
    throw core::InputError(
        fmt::format("{} was computed by version {} of the experiment {}, this program has {}; compute it again under "
                    "another name",
                    what, found.experiment_version, found.experiment, wanted.experiment_version));
  if (found.study_hash != wanted.study_hash || found.block_trials != wanted.block_trials ||
      names_of(found.schema) != names_of(wanted.schema))
    throw core::InputError(
        fmt::format("{} belongs to another study; finish that one, remove it, or choose another -o", what));
  if (found.isa != wanted.isa && wanted.isa != mixed_isa)
    throw core::InputError(
        fmt::format("{} was computed with the instruction set {}; go on with --isa {}, or choose another -o", what,
                    found.isa, found.isa));
}

void renumber(BlockSource& source, const Header& found, const Header& wanted) {
  const PlacesByHash cells(wanted.cells);
  const PlacesByHash methods(wanted.methods);
  const auto for_each_place = [&](std::size_t cell, std::size_t method, auto&& f) {
    for (const std::size_t c : places_of(cells, found.cells, cell, source.path, "cell"))
      for (const std::size_t m : places_of(methods, found.methods, method, source.path, "method")) f(c, m);
  };

  Ledger ledger(wanted.block_trials);
  for (const Row& row : source.ledger.rows())
    for_each_place(row.cell, row.method, [&](std::size_t cell, std::size_t method) {
      Row moved = row;
      moved.cell = cell;
      moved.method = method;
      ledger.insert(std::move(moved));
    });
  source.ledger = std::move(ledger);

  FailureList failures;
  for (const auto& [key, trials] : source.failures.trials())
    for_each_place(key.cell, key.method, [&, reason = key.reason, &numbers = trials](auto cell, auto method) {
      failures.insert({cell, method, reason}, numbers);
    });
  source.failures = std::move(failures);

  std::vector<StoredColumns> columns;
  for (const StoredColumns& stored : source.columns)
    for_each_place(stored.cell, stored.method, [&](std::size_t cell, std::size_t method) {
      StoredColumns& moved = columns.emplace_back(stored);
      moved.cell = cell;
      moved.method = method;
    });
  source.columns = std::move(columns);
}

}  // namespace ridgeloc::results
