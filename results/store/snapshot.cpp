#include "results/store/snapshot.hpp"

#include <fmt/format.h>

#include <optional>
#include <ranges>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "results/store/block_source.hpp"
#include "results/store/block_union.hpp"
#include "results/store/part.hpp"
#include "results/store/parts_folder.hpp"
#include "results/store/result_file.hpp"
#include "results/util/file_system.hpp"

namespace ridgeloc::results {
namespace {

namespace fs = std::filesystem;

/// A run has united parts into one, or sealed them, while they were read.
struct Vanished {};

/// What `read` returns of a part; none if the part is damaged. Throws Vanished.
template <typename Read>
auto read_if_intact(const fs::path& part, Read&& read) {
  std::optional<decltype(read(part))> content;
  try {
    content = read(part);
  } catch (const core::IoError&) {
    if (!path_exists(part)) throw Vanished();
  }
  return content;
}

/// That of the newest part, which knows all cells and methods of those before it.
std::optional<Header> newest_header(const std::vector<fs::path>& parts) {
  for (const fs::path& part : std::views::reverse(parts))
    if (auto header = read_if_intact(part, read_part_header)) return header;
  return std::nullopt;
}

BlockSource sealed_blocks(const fs::path& path, const Header& wanted) {
  Snapshot sealed = read_sealed(path);
  require_same_study(sealed.header, wanted, path.string());
  BlockSource source{path, std::move(sealed.ledger), std::move(sealed.failures), {}};
  renumber(source, sealed.header, wanted);
  return source;
}

/// None where no part can be read. Throws Vanished.
std::optional<Snapshot> united(const fs::path& path, bool with_result) {
  const std::vector<fs::path> parts = content_of(parts_folder(path)).parts;
  const std::optional<Header> header = newest_header(parts);
  if (!header) return std::nullopt;
  BlockUnion blocks(*header);
  if (with_result) blocks.add(sealed_blocks(path, *header));
  for (const fs::path& part : parts) {
    auto source = read_if_intact(part, [&](const fs::path& file) { return read_part_blocks(file, *header); });
    if (source) blocks.add(std::move(*source));
  }
  return Snapshot{*header, blocks.ledger(), blocks.failures(), false};
}

Snapshot taken(const fs::path& path, SnapshotOf of) {
  const bool has_result = path_exists(path);
  if (has_result && of == SnapshotOf::Result) return read_sealed(path);
  if (auto snapshot = united(path, has_result)) {
    // Parts that were sealed and removed before they were listed are in the result.
    if (!has_result && path_exists(path)) throw Vanished();
    return std::move(*snapshot);
  }
  if (!path_exists(path) && path_exists(parts_folder(path)))
    throw core::InputError(fmt::format(
        "{} is not there yet, and {} holds no finished block; look again when the run has gone on for some seconds",
        path.string(), parts_folder(path).string()));
  return read_sealed(path);
}

}  // namespace

Snapshot read_snapshot(const fs::path& path, SnapshotOf of) {
  // A run unites parts once in minutes, and seals them once.
  constexpr int most_attempts = 20;
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    try {
      return taken(path, of);
    } catch (const Vanished&) {
      continue;
    }
  }
  throw core::InputError(fmt::format("{} changes faster than it can be read; try again", parts_folder(path).string()));
}

Summary summarize(const Snapshot& snapshot) {
  Summary summary = summarize(snapshot.header, snapshot.ledger);
  summary.is_sealed = snapshot.is_sealed;
  return summary;
}

}  // namespace ridgeloc::results
