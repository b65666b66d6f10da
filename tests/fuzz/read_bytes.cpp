// Any bytes as a result. What crashes here is mostly HDF5 itself, which the program meets in a child process only
// (app/result_probe.hpp).

#include "tests/fuzz/memory_file.hpp"
#include "tests/fuzz/read_everything.hpp"

using namespace ridgeloc;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const tests::MemoryFile file;
  file.write({reinterpret_cast<const char*>(data), size});
  tests::read_everything(file.path());
  return 0;
}
