// Any bytes as a result, and as a part behind which the right checksum stands. What crashes here is mostly HDF5 itself,
// which the program meets in a child process only (app/result_probe.hpp), or behind a checksum.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <span>

#include "results/util/digest.hpp"
#include "tests/fuzz/read_everything.hpp"
#include "tests/support/scratch_folder.hpp"

namespace fs = std::filesystem;
using namespace ridgeloc;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const tests::ScratchFolder folder;
  const std::span bytes(reinterpret_cast<const char*>(data), size);
  const auto write = [&](const fs::path& path) -> std::ofstream {
    std::ofstream file(path, std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return file;
  };
  write(folder / "result.h5");
  tests::read_everything(folder / "result.h5");

  fs::create_directory(folder / "other.h5.parts");
  results::Digest64 checksum;
  checksum.update(std::as_bytes(bytes));
  write(folder / "other.h5.parts/part-000000.h5") << std::hex << std::setfill('0') << std::setw(16) << checksum.value();
  tests::continue_from_parts(folder / "other.h5");
  return 0;
}
