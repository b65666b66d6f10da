#include <filesystem>
#include <fstream>
#include <random>

#include "results/store/parts_folder.hpp"
#include "results/store/result_writer.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/sample_study.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace ridgeloc;
using namespace ridgeloc::results;
namespace fs = std::filesystem;

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
