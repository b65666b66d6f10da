#include "tests/fuzz/read_everything.hpp"

#include <optional>
#include <sstream>

#include "core/error.hpp"
#include "results/store/part.hpp"
#include "results/store/provenance.hpp"
#include "results/store/result_file.hpp"
#include "results/summary/completeness.hpp"
#include "results/tables/csv.hpp"
#include "results/tables/table.hpp"

namespace ridgeloc::tests {

using namespace results;

namespace {

/// Whether the reader has taken its input.
template <typename Read>
bool attempt(Read&& read) {
  try {
    read();
  } catch (const core::InputError&) {
    return false;
  }
  return true;
}

}  // namespace

void read_everything(const std::filesystem::path& result) {
  std::ostringstream out;
  attempt([&] { read_completely(result); });  // the digest of the data and the ledger among all else
  attempt([&] { contributions_of(result); });
  std::optional<Snapshot> snapshot;
  if (!attempt([&] { snapshot = read_sealed(result); })) return;
  const Header& header = snapshot->header;
  const Summary summary = summarize(*snapshot);
  out << summary_table(summary) << completeness_text(summary);
  write_summary_csv(summary, out);
  write_failures_csv(header, snapshot->failures, out);
  if (!attempt([&] { read_all_trials(result); }) || header.cells.empty()) return;
  for (std::size_t method = 0; method < header.methods.size(); ++method)
    write_trials_csv(header, 0, method, read_trials(result, 0, method), out);
}

void read_part(const std::filesystem::path& part) {
  try {
    const Header header = read_part_header(part);
    const BlockSource source = read_part_blocks(part, header);
    read_columns(part, header.schema, source.columns);
  } catch (const core::InputError&) {
  } catch (const core::IoError&) {
  }
}

}  // namespace ridgeloc::tests
