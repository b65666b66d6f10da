#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "app/build_info.hpp"
#include "app/continuation.hpp"
#include "app/exit_code.hpp"
#include "app/output.hpp"
#include "app/result_probe.hpp"
#include "app/verbs.hpp"
#include "core/error.hpp"
#include "results/store/result_file.hpp"
#include "results/store/result_merge.hpp"
#include "results/summary/completeness.hpp"
#include "results/util/file_system.hpp"
#include "studies/plan/plan.hpp"
#include "studies/plan/union.hpp"

namespace ridgeloc::app {

namespace {

struct Input {
  std::string path;
  results::Header header;
};

/// The inputs in an order that does not depend on that of the command line: the widest study first, which gives the
/// title and the figures.
std::vector<Input> read_inputs(const std::vector<std::string>& paths) {
  std::vector<Input> inputs;
  for (const std::string& path : paths) {
    probe(path, [&] { results::read_completely(path); });
    inputs.push_back({path, results::read_result_header(path)});
  }
  std::ranges::stable_sort(inputs, [](const Input& a, const Input& b) {
    const auto rank = [](const results::Header& h) {
      return std::tuple(-static_cast<double>(h.cells.size() * h.methods.size()), -static_cast<double>(h.trials));
    };
    return std::tuple(rank(a.header), a.header.study_toml) < std::tuple(rank(b.header), b.header.study_toml);
  });
  return inputs;
}

/// The instruction set that the merged result states.
std::string common_isa(const std::vector<Input>& inputs, bool mix) {
  const Input& first = inputs.front();
  for (const Input& input : inputs) {
    if (input.header.isa == first.header.isa) continue;
    if (mix) return results::mixed_isa;
    throw core::InputError(
        fmt::format("{} was computed with the instruction set {} and {} with {}: their numbers differ in last bits; "
                    "compute them with one (run --isa), or accept that with --mix-isa",
                    first.path, first.header.isa, input.path, input.header.isa));
  }
  return first.header.isa;
}

}  // namespace

int merge(const MergeOptions& options) {
  results::require_new(options.output);
  const std::vector<Input> inputs = read_inputs(options.results);
  std::optional<studies::Study> all;
  for (const Input& input : inputs) {
    studies::Study study = study_of(input.header, input.path);
    if (all) {
      const std::string difference = difference_to(*all, input.header, input.path);
      if (!difference.empty())
        throw core::InputError(
            fmt::format("{}: {} and cannot be merged with {}", input.path, difference, inputs.front().path));
      all = studies::united(std::move(*all), study);
    } else {
      all = std::move(study);
    }
  }
  results::Header header = studies::make_plan(*all).header;
  header.isa = common_isa(inputs, options.mix_isa);

  results::Provenance provenance = build_provenance();
  results::complete(provenance);
  std::vector<std::filesystem::path> paths;
  std::set<std::string> contributions;
  for (const Input& input : inputs) {
    paths.emplace_back(input.path);
    for (std::string& line : results::contributions_of(input.path)) contributions.insert(std::move(line));
  }
  provenance.contributions.assign(contributions.begin(), contributions.end());
  results::merge_results(paths, options.output, header, provenance);
  say(fmt::format("{}: {}\n", options.output, results::completeness_text(results::read_result(options.output))));
  fmt::print("{}\n", options.output);
  return Success;
}

}  // namespace ridgeloc::app
