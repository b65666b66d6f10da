#include "results/store/result_seal.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <iterator>
#include <limits>

#include "core/error.hpp"
#include "results/hdf5/hdf5.hpp"
#include "results/store/failure_file.hpp"
#include "results/store/header_file.hpp"
#include "results/store/ledger_file.hpp"
#include "results/store/result_file.hpp"
#include "results/store/result_layout.hpp"
#include "results/store/summary_group.hpp"
#include "results/util/file_system.hpp"

namespace ridgeloc::results {
namespace {

namespace fs = std::filesystem;

void write_provenance(hdf5::File& file, const Header& header, const Provenance& provenance) {
  const std::string group = "/provenance";
  file.create_group(group);
  file.write_attribute(group, "study", header.study_toml);
  file.write_attribute(group, "program_version", provenance.program_version);
  file.write_attribute(group, "git_commit", provenance.git_commit);
  file.write_attribute(group, "git_dirty", std::uint64_t{provenance.git_dirty});
  file.write_attribute(group, "compiler", provenance.compiler);
  file.write_attribute(group, "flags", provenance.flags);
  file.write_attribute(group, "processor", provenance.processor);
  file.write_attribute(group, "threads", std::uint64_t{provenance.threads});
  file.write_attribute(group, "date", provenance.date);
  // As one text: HDF5 allows a list in an attribute some 4000 entries, and more shares than that may be merged.
  file.write_attribute(group, "contributions", fmt::format("{}", fmt::join(provenance.contributions, "\n")));
  file.create_group(group + "/libraries");
  for (const auto& [name, version] : provenance.libraries) file.write_attribute(group + "/libraries", name, version);
  file.create_group(group + "/wall_time_s");
  for (const auto& [phase, seconds] : provenance.wall_time_s)
    file.write_attribute(group + "/wall_time_s", phase, seconds);
}

using Columns = std::vector<const TrialColumns*>;

/// Whether compressing a column pays: whole numbers, yes and no, and values of few trials, NaN in all others, have
/// mantissas that end in zeros. Those of noise do not, and shrink by a tenth in ten times the time.
bool is_compressible(const std::vector<double>& values) {
  constexpr std::uint64_t lower_half = 0xffffffff;
  const auto ends_in_zeros = [](double value) { return (std::bit_cast<std::uint64_t>(value) & lower_half) == 0; };
  return 8 * std::ranges::count_if(values, ends_in_zeros) >= 7 * std::ssize(values);
}

bool is_compressible(const std::vector<std::uint8_t>&) {
  return true;
}

/// Joins a column of all blocks; a block that lacks it while another has it is filled with `missing`.
template <typename T, typename ColumnOf>
void write_joined(hdf5::File& file, const std::string& path, const Columns& blocks, T missing, ColumnOf&& column_of) {
  if (std::ranges::all_of(blocks, [&](const TrialColumns* block) { return column_of(*block).empty(); })) return;
  std::vector<T> joined;
  std::size_t size = 0;
  for (const TrialColumns* block : blocks) size += block->trials;
  joined.reserve(size);
  for (const TrialColumns* block : blocks) {
    const std::vector<T>& column = column_of(*block);
    joined.insert(joined.end(), column.begin(), column.end());
    if (column.empty()) joined.insert(joined.end(), block->trials, missing);
  }
  file.write(path, joined, {joined.size()},
             is_compressible(joined) ? hdf5::Layout::Compressed : hdf5::Layout::Contiguous);
}

void write_method_trials(hdf5::File& file, const Header& header, const Columns& blocks) {
  const TrialColumns& first = *blocks.front();
  const std::string group = layout::trials_group(first.cell, header.methods[first.method].label);
  file.create_group(group);
  std::vector<std::uint64_t> numbers, counts;
  for (const TrialColumns* block : blocks) {
    numbers.push_back(block->block);
    counts.push_back(block->trials);
  }
  file.write(group + "/block", numbers);
  file.write(group + "/block_trials", counts);
  write_joined(
      file, group + "/status", blocks, std::uint8_t{0}, [](const TrialColumns& c) -> auto& { return c.status; });
  for (std::size_t m = 0; m < header.schema.metrics.size(); ++m)
    write_joined(
        file, fmt::format("{}/{}", group, header.schema.metrics[m].name), blocks,
        std::numeric_limits<double>::quiet_NaN(), [m](const TrialColumns& c) -> auto& { return c.metrics[m]; });
}

/// Columns come sorted by method and block.
void write_cell_trials(hdf5::File& file, const Header& header, const std::vector<TrialColumns>& cell) {
  if (cell.empty()) return;
  file.create_group(layout::trials_group(cell.front().cell));
  for (auto begin = cell.begin(); begin != cell.end();) {
    const auto end = std::find_if(begin, cell.end(), [&](const auto& c) { return c.method != begin->method; });
    Columns blocks;
    for (auto block = begin; block != end; ++block) blocks.push_back(&*block);
    write_method_trials(file, header, blocks);
    begin = end;
  }
}

}  // namespace

void write_result(const fs::path& path, const Header& header, const BlockUnion& blocks, const Provenance& provenance) {
  TemporaryFile temporary(path);
  hdf5::File file = hdf5::File::create(temporary.path());
  file.write_attribute("/", "filetype", std::string(layout::filetype));
  file.write_attribute("/", "version", std::vector<std::uint64_t>{layout::major_version, layout::minor_version});
  write_header(file, header);
  write_summary(file, summarize(header, blocks.ledger()));
  write_ledger(file, blocks.ledger(), header.schema);
  write_failures(file, blocks.failures(), header.schema);
  file.create_group("/trials");
  for (std::size_t cell = 0; cell < header.cells.size(); ++cell) write_cell_trials(file, header, blocks.columns(cell));
  write_provenance(file, header, provenance);
  const std::string digest = file.written_digest();
  file.write_attribute("/", layout::digest_attribute, digest);
  file.write_attribute("/", layout::totals_digest_attribute, file.written_digest(hdf5::File::Extent::Totals));
  const std::string attributes = file.attributes_digest();
  file.write_attribute("/", layout::attributes_digest_attribute, attributes);
  file.close();
  const hdf5::File written = hdf5::File::open(temporary.path());
  if (written.content_digest() != digest || written.attributes_digest() != attributes)
    throw core::IoError(fmt::format("{} reads back with other values than were written; check the disk and run again",
                                    temporary.path().string()));
  temporary.publish();
}

}  // namespace ridgeloc::results
