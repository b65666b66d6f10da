#include <hdf5.h>

#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iterator>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "results/store/part.hpp"
#include "results/store/parts_folder.hpp"
#include "results/store/result_writer.hpp"
#include "results/util/digest.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"
#include "tests/support/sample_study.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace ridgeloc;
using namespace ridgeloc::results;
namespace fs = std::filesystem;

namespace {

/// The only part of a result with one block.
fs::path one_part(const fs::path& path) {
  const Header header = tests::sample_header();
  ResultWriter writer(path, header);
  std::vector<BlockSink> blocks;
  blocks.push_back(tests::sample_block(header, 0, 0));
  writer.add(std::move(blocks));
  writer.flush();
  return parts_folder(path) / "part-000000.h5";
}

}  // namespace

TEST_CASE("a part of an earlier program is called that, and not damaged") {
  const tests::ScratchFolder folder;
  const fs::path part = one_part(folder / "result.h5");
  // The checksum was a SHA-256.
  fs::resize_file(part, fs::file_size(part) - 16);
  std::ofstream(part, std::ios::app | std::ios::binary) << std::string(64, 'a');
  const std::string message = tests::message_of([&] { ResultWriter(folder / "result.h5", tests::sample_header()); });
  CHECK(tests::lacking(message, {"format version 3", "finish with the program that began"}) == "");
  CHECK(fs::exists(part));
}

TEST_CASE("a part with right checksum that says what no block has is damaged, and nothing is read outside memory") {
  const tests::ScratchFolder folder;
  const fs::path part = one_part(folder / "result.h5");
  const Header header = tests::sample_header();
  Part crafted{Ledger(header.block_trials), {}, {}};
  BlockSink block = tests::sample_block(header, 0, 0);
  for (Row& row : block.take_rows()) crafted.ledger.insert(std::move(row));
  crafted.columns = block.take_columns();
  crafted.columns[0].trials = std::uint64_t{1} << 63;
  write_part(part, header, crafted);
  CHECK_THROWS_AS(read_part_blocks(part, header), core::IoError);
}

TEST_CASE("a part whose flags are neither yes nor no is damaged") {
  const tests::ScratchFolder folder;
  const fs::path part = one_part(folder / "result.h5");
  const Header header = tests::sample_header();
  REQUIRE_NOTHROW(read_part_blocks(part, header));
  const std::string flag = GENERATE("/columns/has_status", "/columns/has_metric");
  // Into the HDF5 content, without its checksum, which is made anew.
  fs::resize_file(part, fs::file_size(part) - 16);
  {
    const hid_t file = H5Fopen(part.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t dataset = H5Dopen2(file, flag.c_str(), H5P_DEFAULT);
    const hid_t space = H5Dget_space(dataset);
    std::vector<std::uint8_t> flags(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)), 2);
    REQUIRE(H5Dwrite(dataset, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, flags.data()) >= 0);
    H5Sclose(space);
    H5Dclose(dataset);
    H5Fclose(file);
  }
  std::ifstream in(part, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(in), {}};
  Digest64 checksum;
  checksum.update(std::as_bytes(std::span(content)));
  std::ofstream(part, std::ios::app | std::ios::binary)
      << std::hex << std::setw(16) << std::setfill('0') << checksum.value();
  CHECK(tests::lacking(tests::message_of([&] { read_part_blocks(part, header); }),
                       {"is damaged: /columns says what no block has"}) == "");
}

TEST_CASE("a changed bit in any byte of a part is found, and never reaches HDF5") {
  const tests::ScratchFolder folder;
  const Header header = tests::sample_header();
  const fs::path path = folder / "result.h5";
  {
    ResultWriter writer(path, header);
    std::vector<BlockSink> blocks;
    blocks.push_back(tests::sample_block(header, 0, 0));
    writer.add(std::move(blocks));
  }
  REQUIRE(headers_at(path).size() == 1);
  const fs::path part = folder / "result.h5.parts/part-000000.h5";
  const std::uintmax_t size = fs::file_size(part);
  std::fstream file(part, std::ios::in | std::ios::out | std::ios::binary);
  std::mt19937 random(7);
  std::size_t unnoticed = 0;
  for (std::uintmax_t place = 0; place < size; ++place) {
    const auto offset = static_cast<std::streamoff>(place);
    const int byte = file.seekg(offset).get();
    file.seekp(offset).put(static_cast<char>(byte ^ 1 << random() % 8)).flush();
    unnoticed += headers_at(path).size();
    file.seekp(offset).put(static_cast<char>(byte)).flush();
  }
  INFO("bytes: " << size);
  CHECK(unnoticed == 0);
  CHECK(headers_at(path).size() == 1);
}
