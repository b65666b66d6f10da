#include "results/store/block_union.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

#include "core/error.hpp"
#include "results/schema/text.hpp"

namespace ridgeloc::results {

BlockUnion::BlockUnion(const Header& header)
    : header_(header), ledger_(header.block_trials), columns_(header.cells.size()) {}

void BlockUnion::add(BlockSource source) {
  try {
    for (const Row& row : source.ledger.rows()) ledger_.insert(row);
  } catch (const BlockConflict& conflict) {
    throw core::IoError(
        fmt::format("{}: block {} of cell {} ({}), method {}, is known with the same trials and other numbers; one of "
                    "the two comes "
                    "from another program or a faulty machine: find out which by `ridgeloc verify`, and leave it out",
                    source.path.string(), conflict.block, conflict.cell, cell_text(header_, conflict.cell),
                    header_.methods[conflict.method].label));
  }
  failures_.insert(source.failures);
  // A narrower study keeps more trials of each cell.
  for (StoredColumns& stored : source.columns) {
    stored.wanted = kept_trials(header_, stored.block, stored.trials);
    if (stored.wanted > 0) columns_[stored.cell][source.path].push_back(std::move(stored));
  }
}

std::vector<TrialColumns> BlockUnion::columns(std::size_t cell) const {
  std::vector<std::pair<const std::filesystem::path*, const StoredColumns*>> there;
  for (const auto& [path, stored] : columns_[cell])
    for (const StoredColumns& block : stored) there.emplace_back(&path, &block);
  // Of a block that is there twice the one of which a file holds more trials comes first and counts, though both may be
  // cut to as many; equally long ones are equal.
  std::ranges::stable_sort(there, {}, [](const auto& place) {
    return std::tuple(place.second->method, place.second->block, ~place.second->trials);
  });
  const auto repeated = std::ranges::unique(
      there, {}, [](const auto& place) { return std::tuple(place.second->method, place.second->block); });
  there.erase(repeated.begin(), repeated.end());
  std::map<std::filesystem::path, std::vector<StoredColumns>> counting;
  for (const auto& [path, block] : there) counting[*path].push_back(*block);
  std::vector<TrialColumns> all;
  for (const auto& [path, stored] : counting)
    std::ranges::move(read_columns(path, header_.schema, stored), std::back_inserter(all));
  std::ranges::sort(all, {}, [](const TrialColumns& c) { return std::tuple(c.method, c.block); });
  return all;
}

}  // namespace ridgeloc::results
