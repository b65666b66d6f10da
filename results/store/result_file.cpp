#include "results/store/result_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>
#include <utility>

#include "core/error.hpp"
#include "results/hdf5/hdf5.hpp"
#include "results/store/block_source.hpp"
#include "results/store/failure_file.hpp"
#include "results/store/header_file.hpp"
#include "results/store/ledger_file.hpp"
#include "results/store/parts_folder.hpp"
#include "results/store/provenance.hpp"
#include "results/store/result_layout.hpp"

namespace ridgeloc::results {
namespace {

namespace fs = std::filesystem;

hdf5::File open_result(const fs::path& path) {
  const std::string name = path.string();
  std::error_code error;
  if (!fs::exists(path, error) && fs::exists(parts_folder(path), error))
    throw core::InputError(
        fmt::format("{} is not there yet: its run has not come to its end, see `ridgeloc status {}`", name, name));
  if (!fs::exists(path, error)) throw core::InputError(fmt::format("{} does not exist; check the path", name));
  if (fs::is_directory(path, error))
    throw core::InputError(fmt::format("{} is a folder; name a result file (.h5)", name));
  if (!fs::is_regular_file(path, error))
    throw core::InputError(fmt::format("{} is no regular file; name a result file (.h5)", name));
  if (!std::ifstream(path, std::ios::binary))
    throw core::InputError(fmt::format("{} cannot be read; check its permissions", name));
  if (!hdf5::is_hdf5(path))
    throw core::InputError(fmt::format("{} is not an HDF5 file; name a result of `ridgeloc run`", name));
  hdf5::File file = hdf5::File::open(path);
  if (!file.has_attribute("/", "filetype") || file.text_attribute("/", "filetype") != layout::filetype)
    throw core::InputError(fmt::format("{} is HDF5, but no ridgeloc result; name a result of `ridgeloc run`", name));
  const std::vector<std::uint64_t> version = file.numbers_attribute("/", "version");
  if (version.size() != 2) throw core::IoError(fmt::format("{} has no version", name));
  if (version[0] > layout::major_version)
    throw core::InputError(fmt::format("{} has format version {}.{}, this program reads up to {}.x; update ridgeloc",
                                       name, version[0], version[1], layout::major_version));
  return file;
}

/// Compares what the file holds with the digests that were stored when the result was sealed.
void require_as_written(const hdf5::File& file, hdf5::File::Extent extent) {
  const bool is_all = extent == hdf5::File::Extent::All;
  const char* digest = is_all ? layout::digest_attribute : layout::totals_digest_attribute;
  if (file.content_digest(extent) != file.text_attribute("/", digest))
    throw core::IoError("its numbers are not those that were written");
  const bool has_attributes_digest = file.numbers_attribute("/", "version") >= std::vector<std::uint64_t>{1, 3};
  if (has_attributes_digest &&
      file.attributes_digest() != file.text_attribute("/", layout::attributes_digest_attribute))
    throw core::IoError("its attributes are not those that were written");
}

/// Runs a reader on an opened result; what fails inside is damage, for which the file is to blame and not the
/// machine.
template <typename Read>
auto with_result(const fs::path& path, Read&& read) {
  try {
    return read(open_result(path));
  } catch (const core::IoError& error) {
    throw core::InputError(
        fmt::format("{} is truncated or damaged; compute it again or restore it ({})", path.string(), error.what()));
  }
}

/// The same, with the totals and attributes checked before.
template <typename Read>
auto with_checked_totals(const fs::path& path, Read&& read) {
  return with_result(path, [&](const hdf5::File& file) {
    require_as_written(file, hdf5::File::Extent::Totals);
    return read(file);
  });
}

/// Numbers of the trials of blocks which together have `trials` trials.
std::vector<std::uint64_t> trial_numbers(const hdf5::File& file, const std::string& group, const Header& header,
                                         std::size_t trials) {
  const auto blocks = file.read<std::uint64_t>(group + "/block");
  const auto counts = file.read<std::uint64_t>(group + "/block_trials");
  if (blocks.size() != counts.size()) throw core::IoError(fmt::format("the datasets of {} differ in length", group));
  std::vector<std::uint64_t> numbers;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (counts[b] > header.block_trials || counts[b] > trials - numbers.size())
      throw core::IoError(fmt::format("{} has an impossible block", group));
    for (std::uint64_t t = 0; t < counts[b]; ++t) numbers.push_back(blocks[b] * header.block_trials + t);
  }
  if (numbers.size() != trials) throw core::IoError(fmt::format("{} has values of other trials", group));
  return numbers;
}

/// A column of trials, empty if it is not there; all of a table are equally long.
template <typename T>
std::vector<T> read_column(const hdf5::File& file, const std::string& path, std::optional<std::size_t>& trials) {
  if (!file.contains(path)) return {};
  std::vector<T> values = file.read<T>(path);
  if (values.size() != trials.value_or(values.size()))
    throw core::IoError(fmt::format("{} has {} values for {} trials", path, values.size(), *trials));
  trials = values.size();
  return values;
}

TrialTable read_table(const hdf5::File& file, const Header& header, std::size_t cell, std::size_t method) {
  if (cell >= header.cells.size() || method >= header.methods.size())
    throw core::InputError(fmt::format("{} has {} cells and {} methods; there is no cell {} with method {}",
                                       file.path().string(), header.cells.size(), header.methods.size(), cell, method));
  TrialTable table;
  table.metrics.resize(header.schema.metrics.size());
  const std::string group = layout::trials_group(cell, header.methods[method].label);
  if (!file.contains(group)) return table;
  std::optional<std::size_t> trials;
  table.status = read_column<std::uint8_t>(file, group + "/status", trials);
  if (std::ranges::any_of(table.status, [&](std::uint8_t status) { return status >= header.schema.statuses; }))
    throw core::IoError(fmt::format("{} has a status that the result does not name", group));
  for (std::size_t m = 0; m < table.metrics.size(); ++m)
    table.metrics[m] = read_column<double>(file, fmt::format("{}/{}", group, header.schema.metrics[m].name), trials);
  table.trial = trial_numbers(file, group, header, trials.value_or(0));
  return table;
}

/// Where the values of single trials lie that a result keeps of one method in one cell.
void append_stored(const hdf5::File& file, const Header& header, std::size_t cell, std::size_t method,
                   std::vector<StoredColumns>& list) {
  const std::string group = layout::trials_group(cell, header.methods[method].label);
  if (!file.contains(group)) return;
  const auto blocks = file.read<std::uint64_t>(group + "/block");
  const auto counts = file.read<std::uint64_t>(group + "/block_trials");
  if (blocks.size() != counts.size()) throw core::IoError(fmt::format("the datasets of {} differ in length", group));
  const bool has_status = file.contains(group + "/status");
  std::vector<std::uint8_t> has_metric;
  for (const MetricInfo& metric : header.schema.metrics)
    has_metric.push_back(file.contains(fmt::format("{}/{}", group, metric.name)) ? 1 : 0);
  std::uint64_t offset = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    list.push_back({cell, method, blocks[b], counts[b], counts[b], group, has_status, has_metric, offset, offset});
    offset += counts[b];
  }
}

}  // namespace

BlockSource read_result_blocks(const fs::path& path, const Header& wanted) {
  return with_result(path, [&](const hdf5::File& file) {
    if (!file.contains("/failures"))
      throw core::InputError(fmt::format(
          "{} was written by an older ridgeloc (format {}); it can be read, but not be continued or merged: "
          "compute it again under another name",
          path.string(), fmt::join(file.numbers_attribute("/", "version"), ".")));
    require_as_written(file, hdf5::File::Extent::All);
    const Header found = read_header(file);
    require_same_study(found, wanted, path.string());
    BlockSource source{path, read_ledger(file, found), read_failures(file, found), {}};
    for (std::size_t cell = 0; cell < found.cells.size(); ++cell)
      for (std::size_t method = 0; method < found.methods.size(); ++method)
        append_stored(file, found, cell, method, source.columns);
    renumber(source, found, wanted);
    return source;
  });
}

Provenance read_provenance(const fs::path& path) {
  return with_result(path, [](const hdf5::File& file) {
    const std::string group = "/provenance";
    Provenance provenance;
    provenance.program_version = file.text_attribute(group, "program_version");
    provenance.git_commit = file.text_attribute(group, "git_commit");
    provenance.git_dirty = file.number_attribute(group, "git_dirty") != 0;
    provenance.compiler = file.text_attribute(group, "compiler");
    provenance.flags = file.text_attribute(group, "flags");
    provenance.processor = file.text_attribute(group, "processor");
    provenance.threads = static_cast<unsigned>(file.number_attribute(group, "threads"));
    provenance.date = file.text_attribute(group, "date");
    if (file.has_attribute(group, "contributions")) {  // since version 1.2, there as a list
      for (const std::string& text : file.texts_attribute(group, "contributions")) {
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) provenance.contributions.push_back(line);
      }
    }
    for (const std::string& name : file.attribute_names(group + "/libraries"))
      provenance.libraries.emplace_back(name, file.text_attribute(group + "/libraries", name));
    for (const std::string& phase : file.attribute_names(group + "/wall_time_s"))
      provenance.wall_time_s.emplace_back(phase, file.real_attribute(group + "/wall_time_s", phase));
    return provenance;
  });
}

std::vector<std::string> contributions_of(const fs::path& path) {
  const Provenance found = read_provenance(path);
  std::vector<std::string> lines = found.contributions;
  // A merge computes nothing: its threads are 0, and its inputs stand in its lines.
  if (found.threads > 0)
    lines.push_back(fmt::format("ridgeloc {} (commit {}{}), {}, {} threads, {}", found.program_version,
                                found.git_commit, found.git_dirty ? ", changed" : "", found.processor, found.threads,
                                found.date));
  return lines;
}

void read_completely(const fs::path& path) {
  read_result_blocks(path, read_result_header(path));
}

FailureList read_result_failures(const fs::path& path) {
  return with_checked_totals(path, [](const hdf5::File& file) { return read_failures(file, read_header(file)); });
}

Summary summarize(const Header& header, const Ledger& ledger) {
  Summary summary{header, {}};
  for (std::size_t cell = 0; cell < header.cells.size(); ++cell)
    for (std::size_t method = 0; method < header.methods.size(); ++method) {
      Statistics total = ledger.total(cell, method);
      total.metrics.resize(header.schema.metrics.size());
      summary.statistics.push_back(std::move(total));
    }
  return summary;
}

Snapshot read_sealed(const fs::path& path) {
  return with_checked_totals(path, [](const hdf5::File& file) {
    const Header header = read_header(file);
    return Snapshot{header, read_ledger(file, header), read_failures(file, header)};
  });
}

Summary read_result(const fs::path& path) {
  return summarize(read_sealed(path));
}

Header read_result_header(const fs::path& path) {
  return with_checked_totals(path, [](const hdf5::File& file) { return read_header(file); });
}

Ledger read_result_ledger(const fs::path& path) {
  return with_checked_totals(path, [](const hdf5::File& file) { return read_ledger(file, read_header(file)); });
}

TrialTable read_trials(const fs::path& path, std::size_t cell, std::size_t method) {
  return with_result(path, [&](const hdf5::File& file) { return read_table(file, read_header(file), cell, method); });
}

void read_all_trials(const fs::path& path) {
  with_result(path, [](const hdf5::File& file) {
    const Header header = read_header(file);
    for (std::size_t cell = 0; cell < header.cells.size(); ++cell)
      for (std::size_t method = 0; method < header.methods.size(); ++method) read_table(file, header, cell, method);
  });
}

void visit_trials(const fs::path& path, std::size_t metric, const TrialVisitor& visit) {
  with_result(path, [&](const hdf5::File& file) {
    const Header header = read_header(file);
    for (std::size_t cell = 0; cell < header.cells.size(); ++cell)
      for (std::size_t method = 0; method < header.methods.size(); ++method) {
        const std::string group = layout::trials_group(cell, header.methods[method].label);
        const std::string column = fmt::format("{}/{}", group, header.schema.metrics.at(metric).name);
        if (!file.contains(group) || !file.contains(column)) continue;
        std::optional<std::size_t> trials;
        const std::vector<double> values = read_column<double>(file, column, trials);
        visit(cell, method, trial_numbers(file, group, header, values.size()), values);
      }
  });
}

std::string data_digest(const fs::path& path) {
  return with_result(path, [](const hdf5::File& file) {
    require_as_written(file, hdf5::File::Extent::All);
    return file.text_attribute("/", layout::digest_attribute);
  });
}

}  // namespace ridgeloc::results
