#pragma once
// A writer of the sample study, as a runner uses it.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "results/store/result_file.hpp"
#include "results/store/result_writer.hpp"
#include "tests/support/sample_study.hpp"

namespace ridgeloc::tests {

using Tasks = std::vector<std::pair<std::size_t, std::uint64_t>>;

inline void add(results::ResultWriter& writer, const results::Header& header, std::size_t cell, std::uint64_t block) {
  std::vector<results::BlockSink> blocks;
  blocks.push_back(sample_block(header, cell, block));
  writer.add(std::move(blocks));
}

inline const std::vector<std::size_t> every_method = {0, 1, 2};

inline bool is_missing(const results::ResultWriter& writer, const results::Header& header, std::size_t cell,
                       std::uint64_t block) {
  return !writer.missing_methods(cell, block, sample_trials_of(header, block), every_method).empty();
}

/// How many of the tasks were taken over.
inline std::size_t adopted(const results::ResultWriter& writer, const results::Header& header) {
  return static_cast<std::size_t>(std::ranges::count_if(
      sample_tasks(header), [&](const auto& task) { return !is_missing(writer, header, task.first, task.second); }));
}

/// Computes what is missing, as a runner does, and counts it.
inline std::size_t run_missing(results::ResultWriter& writer, const results::Header& header, const Tasks& tasks) {
  std::size_t computed = 0;
  for (const auto& [cell, block] : tasks) {
    if (!is_missing(writer, header, cell, block)) continue;
    add(writer, header, cell, block);
    ++computed;
  }
  return computed;
}

inline std::string digest_of_plain_run(const std::filesystem::path& path) {
  const results::Header header = sample_header();
  results::ResultWriter writer(path, header);
  run_missing(writer, header, sample_tasks(header));
  writer.seal({});
  return results::data_digest(path);
}

/// Adds the first half of the tasks as two parts and stops.
inline void run_half(const std::filesystem::path& path, const results::Header& header, const Tasks& tasks) {
  results::ResultWriter writer(path, header);
  for (std::size_t i = 0; i < tasks.size() / 2; ++i) {
    add(writer, header, tasks[i].first, tasks[i].second);
    if (i == tasks.size() / 4) writer.flush();
  }
}

}  // namespace ridgeloc::tests
