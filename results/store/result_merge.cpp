#include "results/store/result_merge.hpp"

#include "results/store/block_union.hpp"
#include "results/store/result_seal.hpp"
#include "results/util/file_system.hpp"

namespace ridgeloc::results {

void merge_results(const std::vector<std::filesystem::path>& inputs, const std::filesystem::path& output,
                   const Header& header, const Provenance& provenance) {
  require_new(output);
  BlockUnion blocks(header);
  for (const std::filesystem::path& input : inputs) blocks.add(read_result_blocks(input, header));
  write_result(output, header, blocks, provenance);
}

}  // namespace ridgeloc::results
