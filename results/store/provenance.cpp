#include "results/store/provenance.hpp"

#include <fmt/chrono.h>

#include <ctime>
#include <fstream>

#include "results/hdf5/hdf5.hpp"

namespace ridgeloc::results {

std::string processor_model() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

void complete(Provenance& provenance) {
  provenance.processor = processor_model();
  provenance.date = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  provenance.libraries.emplace_back("HDF5", hdf5::library_version());
}

}  // namespace ridgeloc::results
