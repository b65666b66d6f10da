#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <string_view>

#include "bench/check.hpp"
#include "bench/counted.hpp"
#include "bench/rows.hpp"
#include "bench/workload.hpp"

namespace {

constexpr char usage[] =
    "usage: ridgeloc_bench --check                       compare the peers' answers with ours\n"
    "       ridgeloc_bench --write-problems FILE POINTS  write the problems for a peer outside this program\n"
    "       ridgeloc_bench --pass rrr|block COUNT        work to be counted by bench/instructions.py\n"
    "       ridgeloc_bench [OPTION OF GOOGLE BENCHMARK]...\n";

int run_rows(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  ridgeloc::bench::register_rows();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view verb = argc > 1 ? argv[1] : "";
  try {
    if (verb == "--check" && argc == 2) return ridgeloc::bench::check_peers() ? 0 : 1;
    if (verb == "--write-problems" && argc == 4) {
      ridgeloc::bench::workload(std::stoul(argv[3])).problems.write_csv(argv[2]);
      return 0;
    }
    if (verb == "--pass" && argc == 4) {
      ridgeloc::bench::pass(argv[2], std::stoul(argv[3]));
      return 0;
    }
    if (verb == "--check" || verb == "--write-problems" || verb == "--pass") {
      std::fputs(usage, stderr);
      return 2;
    }
    return run_rows(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ridgeloc_bench: %s\n", error.what());
    return 1;
  }
}
