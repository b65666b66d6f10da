#include "results/store/result_writer.hpp"

#include <algorithm>
#include <random>
#include <thread>

#include "core/error.hpp"
#include "results/store/parts_folder.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"
#include "tests/support/sample_writer.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace ridgeloc;
using namespace ridgeloc::results;
using namespace ridgeloc::tests;
namespace fs = std::filesystem;

TEST_CASE("a result has the same data for any order of blocks, any parts and any number of threads") {
  const ScratchFolder folder;
  const Header header = sample_header();
  const std::string reference = digest_of_plain_run(folder / "reference.h5");
  const fs::path path = folder / "other.h5";

  SECTION("shuffled, in several parts") {
    Tasks tasks = sample_tasks(header);
    std::shuffle(tasks.begin(), tasks.end(), std::mt19937(3));
    ResultWriter writer(path, header);
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      add(writer, header, tasks[i].first, tasks[i].second);
      if (i % 4 == 0) writer.flush();
    }
    writer.seal({});
  }
  SECTION("by two threads") {
    const Tasks tasks = sample_tasks(header);
    ResultWriter writer(path, header);
    const auto work = [&](std::size_t first) {
      for (std::size_t i = first; i < tasks.size(); i += 2) {
        add(writer, header, tasks[i].first, tasks[i].second);
        if (i % 5 == 0) writer.flush();
      }
    };
    std::thread other(work, 1);
    work(0);
    other.join();
    writer.seal({});
  }
  CHECK(data_digest(path) == reference);
  CHECK_FALSE(fs::exists(parts_folder(path)));
}

TEST_CASE("a stopped run is taken over by the next one") {
  const ScratchFolder folder;
  const Header header = sample_header();
  Tasks tasks = sample_tasks(header);
  std::shuffle(tasks.begin(), tasks.end(), std::mt19937(4));
  const fs::path path = folder / "result.h5";
  run_half(path, header, tasks);
  CHECK_FALSE(fs::exists(path));

  ResultWriter writer(path, header);
  CHECK(writer.warnings().empty());
  CHECK(adopted(writer, header) == tasks.size() / 2);
  CHECK(run_missing(writer, header, tasks) == tasks.size() - tasks.size() / 2);
  writer.seal({});
  CHECK(data_digest(path) == digest_of_plain_run(folder / "reference.h5"));
}

TEST_CASE("a sealed result is continued with what it lacks: other blocks, a longer last block, other cells") {
  const ScratchFolder folder;
  const Header header = sample_header();
  const fs::path path = folder / "result.h5";
  Header narrow = header;
  narrow.study_toml = "title = \"narrow\"\n";
  narrow.trials = 2 * sample_block_trials + 5;
  narrow.axes[0].values = {std::int64_t{3}, std::int64_t{4}};
  narrow.cells = {{"c0", {0, 0}}, {"c2", {1, 0}}, {"c3", {1, 1}}};
  {
    ResultWriter writer(path, narrow);
    run_missing(writer, narrow, sample_tasks(narrow));
    writer.seal({});
  }
  ResultWriter writer(path, header);
  CHECK(adopted(writer, header) == 2 * narrow.cells.size());  // the last block is too short
  CHECK_FALSE(writer.is_current());
  run_missing(writer, header, sample_tasks(header));
  writer.seal({});
  CHECK(data_digest(path) == digest_of_plain_run(folder / "reference.h5"));
}

TEST_CASE("many small parts become few") {
  const ScratchFolder folder;
  Header header = sample_header();
  header.trials = 40 * sample_block_trials;
  const Tasks tasks = sample_tasks(header);
  const fs::path path = folder / "result.h5";
  {
    ResultWriter writer(path, header);
    std::size_t most = 0;
    for (const auto& [cell, block] : tasks) {
      add(writer, header, cell, block);
      writer.flush();
      most = std::max(most, content_of(parts_folder(path)).parts.size());
    }
    CHECK(tasks.size() == 200);
    CHECK(most < 64);
  }
  ResultWriter writer(path, header);
  CHECK(writer.warnings().empty());
  CHECK(adopted(writer, header) == tasks.size());
  writer.seal({});

  ResultWriter plain(folder / "reference.h5", header);
  run_missing(plain, header, tasks);
  plain.seal({});
  CHECK(data_digest(path) == data_digest(folder / "reference.h5"));
}

TEST_CASE("a writer that took no trial leaves nothing behind") {
  const ScratchFolder folder;
  { const ResultWriter writer(folder / "result.h5", sample_header()); }
  CHECK(fs::is_empty(folder.path()));
  CHECK_THROWS_AS(ResultWriter(folder / "no/result.h5", sample_header()), core::InputError);
  CHECK(fs::is_empty(folder.path()));
}

TEST_CASE("two runs cannot write the same result at once") {
  const ScratchFolder folder;
  const ResultWriter writer(folder / "result.h5", sample_header());
  const std::string message = message_of([&] { ResultWriter(folder / "result.h5", sample_header()); });
  CHECK(lacking(message, {"another run is writing"}) == "");
}
