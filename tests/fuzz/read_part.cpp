// Any bytes as a part, with the right checksum behind them.

#include "results/util/digest.hpp"
#include "tests/fuzz/memory_file.hpp"
#include "tests/fuzz/read_everything.hpp"

using namespace ridgeloc;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const tests::MemoryFile file;
  const std::span bytes(reinterpret_cast<const char*>(data), size);
  results::Digest64 checksum;
  checksum.update(std::as_bytes(bytes));
  file.write(bytes, fmt::format("{:016x}", checksum.value()));
  tests::read_part(file.path());
  return 0;
}
