#include "results/store/part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "results/hdf5/hdf5.hpp"
#include "results/store/failure_file.hpp"
#include "results/store/header_file.hpp"
#include "results/store/ledger_file.hpp"
#include "results/util/digest.hpp"
#include "results/util/file_system.hpp"

namespace ridgeloc::results {
namespace {

namespace fs = std::filesystem;

constexpr const char* filetype = "ridgeloc-part";
constexpr std::uint64_t format_version = 4;

/// Hexadecimal digits of the XXH3 that ends a part file. Parts are read once or twice, by the program that wrote them:
/// what has to be found is damage, and SHA-256 would take longer than all else.
constexpr std::uintmax_t checksum_size = 16;

/// Up to version 3 it was SHA-256.
constexpr std::uintmax_t checksum_size_before = 64;

core::IoError damaged(const fs::path& path, std::string_view reason) {
  return core::IoError(fmt::format("{} is damaged: {}", path.string(), reason));
}

/// XXH3 of the bytes from the current place of a file to `size` bytes further on.
std::string checksum_of(std::ifstream& file, std::uintmax_t size) {
  Digest64 digest;
  std::vector<char> piece(1 << 20);
  while (size > 0 && file) {
    file.read(piece.data(), static_cast<std::streamsize>(std::min<std::uintmax_t>(size, piece.size())));
    digest.update(std::as_bytes(std::span(piece.data(), static_cast<std::size_t>(file.gcount()))));
    size -= static_cast<std::uintmax_t>(file.gcount());
  }
  return fmt::format("{:016x}", digest.value());
}

/// The checksum stands behind the HDF5 content, where HDF5 does not look: so it covers every byte, and is
/// checked before the HDF5 library, which can crash on damaged files, gets to see them.
void append_checksum(const fs::path& path) {
  std::ifstream content(path, std::ios::binary);
  const std::string checksum = checksum_of(content, fs::file_size(path));
  std::ofstream file(path, std::ios::binary | std::ios::app);
  file << checksum;
  file.close();
  if (!content || !file) throw core::IoError(fmt::format("cannot write the checksum of {}", path.string()));
}

std::string ending_of(const fs::path& path, std::uintmax_t size, std::uintmax_t length) {
  std::string ending(std::min(size, length), '\0');
  std::ifstream file(path, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(size - ending.size()));
  file.read(ending.data(), static_cast<std::streamsize>(ending.size()));
  return file ? ending : std::string();
}

/// Whether a file ends as parts did up to version 3. HDF5 content before a checksum of now does not end in 48 digits.
bool ends_as_before(const fs::path& path, std::uintmax_t size) {
  const std::string ending = ending_of(path, size, checksum_size_before);
  return ending.size() == checksum_size_before && ending.find_first_not_of("0123456789abcdef") == std::string::npos;
}

core::InputError of_other_version(const fs::path& path, const std::string& version) {
  return core::InputError(
      fmt::format("{} has format version {}, this program writes {}; finish with the program that began, "
                  "or delete the folder",
                  path.string(), version, format_version));
}

void require_intact(const fs::path& path) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  if (error || size < checksum_size) throw damaged(path, "it is too short");
  if (ends_as_before(path, size)) throw of_other_version(path, "3 or older");
  std::ifstream file(path, std::ios::binary);
  const std::string computed = checksum_of(file, size - checksum_size);
  std::string stored(checksum_size, '\0');
  file.read(stored.data(), static_cast<std::streamsize>(checksum_size));
  if (!file || stored != computed) throw damaged(path, "its checksum does not match");
}

void append(std::vector<std::uint8_t>& status, std::vector<double>& values, const TrialColumns& columns) {
  status.insert(status.end(), columns.status.begin(), columns.status.end());
  for (const std::vector<double>& metric : columns.metrics) values.insert(values.end(), metric.begin(), metric.end());
}

void write_columns(hdf5::File& file, const std::vector<TrialColumns>& list, std::size_t metrics) {
  std::vector<std::uint64_t> cell, method, block, trials;
  std::vector<std::uint8_t> has_status, has_metric, status;
  std::vector<double> values;
  std::size_t size = 0;
  for (const TrialColumns& columns : list)
    for (const std::vector<double>& metric : columns.metrics) size += metric.size();
  values.reserve(size);
  for (const TrialColumns& columns : list) {
    cell.push_back(columns.cell);
    method.push_back(columns.method);
    block.push_back(columns.block);
    trials.push_back(columns.trials);
    has_status.push_back(columns.status.empty() ? 0 : 1);
    for (const std::vector<double>& metric : columns.metrics) has_metric.push_back(metric.empty() ? 0 : 1);
    append(status, values, columns);
  }
  file.create_group("/columns");
  file.write("/columns/cell", cell);
  file.write("/columns/method", method);
  file.write("/columns/block", block);
  file.write("/columns/trials", trials);
  file.write("/columns/has_status", has_status);
  file.write("/columns/has_metric", has_metric, {list.size(), metrics});
  file.write("/columns/status", status, {status.size()}, hdf5::Layout::Compressed);
  file.write("/columns/value", values);
}

std::vector<StoredColumns> read_stored(const hdf5::File& file, std::size_t metrics, std::uint64_t block_trials) {
  const auto cell = file.read<std::uint64_t>("/columns/cell");
  const auto method = file.read<std::uint64_t>("/columns/method");
  const auto block = file.read<std::uint64_t>("/columns/block");
  const auto trials = file.read<std::uint64_t>("/columns/trials");
  const auto has_status = file.read<std::uint8_t>("/columns/has_status");
  const auto has_metric = file.read<std::uint8_t>("/columns/has_metric");
  const std::size_t size = cell.size();
  if (method.size() != size || block.size() != size || trials.size() != size || has_status.size() != size ||
      has_metric.size() != size * metrics)
    throw damaged(file.path(), "the datasets of /columns differ in length");
  const auto is_flag = [](std::uint8_t flag) { return flag <= 1; };
  // Offsets are sums of products of these: none may wrap.
  if (std::ranges::any_of(trials, [&](std::uint64_t n) { return n > block_trials; }) ||
      !std::ranges::all_of(has_status, is_flag) || !std::ranges::all_of(has_metric, is_flag))
    throw damaged(file.path(), "/columns says what no block has");
  std::vector<StoredColumns> list;
  std::uint64_t status_offset = 0;
  std::uint64_t value_offset = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const auto flags = has_metric.begin() + static_cast<std::ptrdiff_t>(i * metrics);
    StoredColumns stored{
        cell[i],       method[i],   block[i],           trials[i],
        trials[i],     "",          has_status[i] != 0, {flags, flags + static_cast<std::ptrdiff_t>(metrics)},
        status_offset, value_offset};
    if (stored.has_status) status_offset += stored.trials;
    for (const std::uint8_t given : stored.has_metric) value_offset += given * stored.trials;
    list.push_back(std::move(stored));
  }
  return list;
}

/// Opens a part after its checksum has been found right.
hdf5::File open_part(const fs::path& path) {
  require_intact(path);
  hdf5::File file = hdf5::File::open(path);
  if (file.text_attribute("/", "filetype") != filetype) throw damaged(path, "it is not a part of a result");
  if (const std::uint64_t version = file.number_attribute("/", "version"); version != format_version)
    throw of_other_version(path, std::to_string(version));
  return file;
}

}  // namespace

void write_part(const fs::path& path, const Header& header, const Part& part) {
  TemporaryFile temporary(path);
  hdf5::File file = hdf5::File::create(temporary.path(), hdf5::Hash::Xxh3);
  file.write_attribute("/", "filetype", std::string(filetype));
  file.write_attribute("/", "version", std::vector<std::uint64_t>{format_version, 0});
  write_header(file, header);
  write_ledger(file, part.ledger, header.schema);
  write_failures(file, part.failures, header.schema);
  write_columns(file, part.columns, header.schema.metrics.size());
  file.create_group("/provenance");
  file.write_attribute("/provenance", "study", header.study_toml);
  file.close();
  if (hdf5::File::open(temporary.path(), hdf5::Hash::Xxh3).content_digest() != file.written_digest())
    throw damaged(temporary.path(), "it reads back with other values than were written");
  append_checksum(temporary.path());
  temporary.publish();
}

Header read_part_header(const fs::path& path) {
  return read_header(open_part(path));
}

BlockSource read_part_blocks(const fs::path& path, const Header& wanted) {
  const hdf5::File file = open_part(path);
  const Header found = read_header(file);
  require_same_study(found, wanted, path.parent_path().string());
  BlockSource source{path, read_ledger(file, found), read_failures(file, found),
                     read_stored(file, found.schema.metrics.size(), found.block_trials)};
  renumber(source, found, wanted);
  return source;
}

}  // namespace ridgeloc::results
