// The smallest experiment, one setting, one metric and a trial that sleeps, in a program with all verbs.
#include <chrono>
#include <thread>

#include "app/command_line.hpp"
#include "core/random.hpp"
#include "studies/registry.hpp"
#include "studies/study/setting_builders.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;

struct Nap : Simulation {
  Nap(std::uint64_t seed, const Cell& cell) : stream(seed, "nap"), ms(std::get<double>(cell.values.at("nap_ms"))) {}

  bool run_block(TrialRange range, Workspace&, Monitor& monitor, results::BlockSink& sink) const override {
    std::vector<double> minutes(range.count);
    for (std::size_t t = 0; t < range.count && !monitor.stop_requested(); ++t) {
      std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(ms));
      minutes[t] = core::uniform_pair(stream.block(range.first + t, 0))[0];
      monitor.advance(1);
    }
    sink.metric(0, 0, minutes);
    return !monitor.stop_requested();
  }

  core::Stream stream;
  double ms;
};

struct Sleeping : Experiment {
  Sleeping(std::string_view called, std::uint64_t trials) : name_(called), block_(trials) {}
  std::string_view name() const override { return name_; }
  std::string_view summary() const override { return "trials that sleep"; }
  int version() const override { return 1; }
  std::uint64_t block_trials() const override { return block_; }
  std::span<const Setting> settings() const override {
    static const Setting nap = Section("bed").real("nap_ms", 1, {0, 1e6}, "ms", "how long a trial sleeps");
    return {&nap, 1};
  }
  const results::Schema& schema() const override {
    static const results::Schema schema{{{"dream", "min", "length of the dream", false}}, {}, 0};
    return schema;
  }
  std::string_view example() const override { return "[[figure]]\nkind = \"ecdf\"\ny = \"dream\"\n"; }
  std::unique_ptr<const Simulation> prepare(const StudyKey& key, const Cell& cell,
                                            std::span<const Method>) const override {
    return std::make_unique<Nap>(key.seed, cell);
  }
  std::string_view name_;
  std::uint64_t block_;
};

int main(int argc, char** argv) {
  static const Sleeping nap("nap", 1);
  static const Sleeping sleep("sleep", 4096);
  add_experiment(nap);
  add_experiment(sleep);
  return app::run_command_line(argc, argv);
}
