#pragma once

#include <filesystem>
#include <utility>
#include <vector>

#include "results/store/provenance.hpp"
#include "results/store/result_writer.hpp"
#include "tests/support/sample_study.hpp"

namespace ridgeloc::tests {

/// The sealed result of a study like `sample_header`.
inline void write_sample(const std::filesystem::path& path, const results::Header& header) {
  results::ResultWriter writer(path, header);
  for (const auto& [cell, block] : sample_tasks(header)) {
    std::vector<results::BlockSink> blocks;
    blocks.push_back(sample_block(header, cell, block));
    writer.add(std::move(blocks));
  }
  results::Provenance provenance;
  provenance.program_version = "0.1.0";
  provenance.libraries = {{"Eigen", "3.4.0"}};
  provenance.wall_time_s = {{"run", 1.5}};
  results::complete(provenance);
  writer.seal(provenance);
}

}  // namespace ridgeloc::tests
