#pragma once

#include <filesystem>
#include <utility>
#include <vector>

#include "results/store/provenance.hpp"
#include "results/store/result_writer.hpp"
#include "tests/support/sample_study.hpp"

namespace ridgeloc::results::test {

/// The sealed result of a study like `sample_header`.
inline void write_sample(const std::filesystem::path& path, const Header& header) {
  ResultWriter writer(path, header);
  for (const auto& [cell, block] : sample_tasks(header)) {
    std::vector<BlockSink> blocks;
    blocks.push_back(sample_block(header, cell, block));
    writer.add(std::move(blocks));
  }
  Provenance provenance;
  provenance.program_version = "0.1.0";
  provenance.libraries = {{"Eigen", "3.4.0"}};
  provenance.wall_time_s = {{"run", 1.5}};
  complete(provenance);
  writer.seal(provenance);
}

}  // namespace ridgeloc::results::test
