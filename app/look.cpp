#include "app/look.hpp"

#include <fmt/format.h>

#include "app/output.hpp"
#include "app/result_probe.hpp"
#include "results/summary/completeness.hpp"

namespace ridgeloc::app {

results::Snapshot look(const std::string& result) {
  results::Snapshot snapshot = read_probed(result, [&] { return results::read_snapshot(result); });
  if (!snapshot.is_sealed)
    say(fmt::format("{}: {}\n", result, results::completeness_text(results::summarize(snapshot))));
  return snapshot;
}

}  // namespace ridgeloc::app
