// Any text as a study: it is refused in one line, or says of itself what it amounts to, which reads back as the same.

#include "studies/files/study_reader.hpp"
#include "studies/files/study_writer.hpp"
#include "studies/plan/plan.hpp"
#include "studies/registry.hpp"
#include "tests/fuzz/refused.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t most_cells = 100;
  Study study;
  const std::string text = tests::text_of(data, size);
  if (tests::is_refused([&] { study = read_study({"fuzz", "fuzz.toml", text, false}); })) return 0;
  const std::string resolved = resolved_toml(study);
  if (resolved_toml(read_study({"fuzz", "fuzz.toml", resolved, false})) != resolved) __builtin_trap();
  std::size_t cells = 1;
  for (const SweepAxis& axis : study.sweep) cells *= axis.values.size();
  if (cells <= most_cells) tests::is_refused([&] { make_plan(study); });
  return 0;
}
