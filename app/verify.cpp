#include <fmt/format.h>

#include <random>
#include <string>
#include <utility>

#include "app/exit_code.hpp"
#include "app/recomputation.hpp"
#include "app/result_probe.hpp"
#include "app/stop_text.hpp"
#include "app/verbs.hpp"
#include "results/schema/text.hpp"
#include "results/store/result_file.hpp"
#include "results/summary/completeness.hpp"
#include "studies/run/verification.hpp"

namespace ridgeloc::app {

namespace {

/// Computes some blocks again; returns whether all are what the result has.
bool recompute(const VerifyOptions& options, const results::Ledger& ledger) {
  const Recomputation result = recomputation_of(options.result);
  const std::uint64_t seed = options.seed.value_or(std::random_device()());
  const auto all = studies::all_blocks(ledger);
  const auto blocks = studies::random_choice(all, options.blocks, seed);
  const auto differences =
      studies::differing_blocks(result.study, result.plan, ledger, blocks, *studies::thread_queue(options.threads));
  for (const studies::BlockDifference& difference : differences) {
    fmt::print("different: block {} of cell {} ({}), method {}\n", difference.where.block, difference.where.cell,
               results::cell_text(result.header, difference.where.cell),
               result.header.methods[difference.method].label);
  }
  fmt::print("blocks       {} of {} computed again with {} and compared bit for bit, all methods: {} (--seed {})\n",
             blocks.size(), all.size(), result.header.isa,
             differences.empty() ? "equal" : fmt::format("{} different", differences.size()), seed);
  return differences.empty();
}

}  // namespace

int verify(const VerifyOptions& options) {
  if (options.digest) {
    fmt::print("{}\n", read_probed(options.result, [&] { return results::data_digest(options.result); }));
    return Success;
  }
  const auto [digest, summary] = read_probed(options.result, [&] {
    results::read_all_trials(options.result);
    return std::pair(results::data_digest(options.result), results::read_result(options.result));
  });
  fmt::print("data         {}, as written\n", digest);
  fmt::print("ledger       {}\n", results::completeness_text(summary));
  if (const std::string reached = reached_text(summary, options.result); !reached.empty())
    fmt::print("stop         {}\n", reached);
  if (options.blocks == 0) return Success;
  return recompute(options, results::read_result_ledger(options.result)) ? Success : Different;
}

}  // namespace ridgeloc::app
