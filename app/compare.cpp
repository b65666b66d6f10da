#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "app/continuation.hpp"
#include "app/exit_code.hpp"
#include "app/result_probe.hpp"
#include "app/verbs.hpp"
#include "core/error.hpp"
#include "results/schema/text.hpp"
#include "results/store/result_file.hpp"
#include "results/summary/agreement.hpp"
#include "studies/plan/union.hpp"

namespace ridgeloc::app {

namespace {

constexpr std::size_t most_shown = 10;

/// The same study may have been computed by another version, on another machine, or with another seed. Where neither
/// version nor seed differ, nobody needs to read it.
void require_comparable(const CompareOptions& options, const results::Header& first, const results::Header& second) {
  if (first.study_hash == second.study_hash) return;
  std::vector<std::string> texts =
      studies::differences(study_of(first, options.first), study_of(second, options.second));
  std::erase_if(texts, [](std::string_view text) { return text.starts_with("seed "); });
  if (!texts.empty()) {
    throw core::InputError(
        fmt::format("{} and {} are different studies ({})", options.first, options.second, fmt::join(texts, ", ")));
  }
}

}  // namespace

int compare(const CompareOptions& options) {
  const auto read = [](const std::string& path) {
    return read_probed(path, [&] { return std::pair(results::data_digest(path), results::read_result(path)); });
  };
  const auto [first_digest, first] = read(options.first);
  const auto [second_digest, second] = read(options.second);
  require_comparable(options, first.header, second.header);
  if (first_digest == second_digest) {
    fmt::print("equal: both hold the same numbers, bit for bit\n");
    return Success;
  }
  const results::Agreement agreement = results::agreement_of(first, second);
  if (agreement.pairs.empty()) {
    throw core::InputError(fmt::format("{} and {} have no cell and method in common", options.first, options.second));
  }
  fmt::print("largest differences, in standard errors of independent trials\n");
  for (std::size_t i = 0; i < std::min(agreement.pairs.size(), most_shown); ++i) {
    const results::NumberPair& pair = agreement.pairs[i];
    const std::string cell = results::cell_text(first.header, pair.cell);
    fmt::print("  {:>8.3g}  {}{}{}: {} of {}, {:.6g} against {:.6g}\n", pair.standard_errors, cell,
               cell.empty() ? "" : ": ", first.header.methods[pair.method].label, pair.statistic, pair.metric,
               pair.first, pair.second);
  }
  fmt::print("{}: {} numbers compared, limit {:.2f} standard errors; {} without a reliable error left out\n",
             agreement.holds ? "agree" : "disagree", agreement.pairs.size(), agreement.limit, agreement.untested);
  return agreement.holds ? Success : Different;
}

}  // namespace ridgeloc::app
