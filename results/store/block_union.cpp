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
  std::vector<TrialColumns> all;
  for (const auto& [path, stored] : columns_[cell])
    std::ranges::move(read_columns(path, header_.schema, stored), std::back_inserter(all));
  // Of a block that is there twice the longer one comes first and counts, as in the ledger; equally long ones are
  // equal: the ledger has compared their digests.
  std::ranges::sort(all, [](const TrialColumns& a, const TrialColumns& b) {
    return std::tuple(a.method, a.block, b.trials) < std::tuple(b.method, b.block, a.trials);
  });
  const auto repeated =
      std::ranges::unique(all, {}, [](const TrialColumns& c) { return std::tuple(c.method, c.block); });
  all.erase(repeated.begin(), repeated.end());
  return all;
}

}  // namespace ridgeloc::results
