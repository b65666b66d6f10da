#include "results/store/snapshot.hpp"

#include <atomic>
#include <chrono>
#include <fstream>
#include <thread>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "results/store/parts_folder.hpp"
#include "results/store/run_record.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"
#include "tests/support/sample_writer.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace ridgeloc;
using namespace ridgeloc::results;
using namespace ridgeloc::tests;
namespace fs = std::filesystem;

namespace {

std::vector<Row> rows_of(const Ledger& ledger) {
  return {ledger.rows().begin(), ledger.rows().end()};
}

/// Blocks of all cells and methods.
std::uint64_t blocks_of(const Ledger& ledger) {
  std::uint64_t blocks = 0;
  for (const Row& row : ledger.rows()) blocks += row.blocks;
  return blocks;
}

}  // namespace

TEST_CASE("a snapshot of parts has what the sealed result will have") {
  const ScratchFolder folder;
  const Header header = sample_header();
  const fs::path path = folder / "result.h5";
  {
    ResultWriter writer(path, header);
    for (const auto& [cell, block] : sample_tasks(header)) {
      add(writer, header, cell, block);
      if (block == 1) writer.flush();
    }
  }
  const Snapshot parts = read_snapshot(path);
  CHECK_FALSE(parts.is_sealed);
  CHECK_FALSE(summarize(parts).is_sealed);
  { ResultWriter(path, header).seal({}); }
  const Snapshot sealed = read_snapshot(path);
  CHECK(sealed.is_sealed);
  CHECK(rows_of(parts.ledger) == rows_of(sealed.ledger));
  CHECK(parts.failures == sealed.failures);
  CHECK(parts.header.study_hash == sealed.header.study_hash);
  CHECK(parts.header.cells.size() == sealed.header.cells.size());
}

TEST_CASE("a result that is widened is shown as it was sealed, or with its new parts") {
  const ScratchFolder folder;
  const Header header = sample_header();
  const fs::path path = folder / "result.h5";
  Header narrow = header;
  narrow.cells = {{"c0", {0, 0}}, {"c2", {1, 0}}};
  {
    ResultWriter writer(path, narrow);
    run_missing(writer, narrow, sample_tasks(narrow));
    writer.seal({});
  }
  {
    ResultWriter writer(path, header);
    add(writer, header, 1, 0);
  }
  CHECK(read_snapshot(path).header.cells.size() == 2);
  const Snapshot all = read_snapshot(path, SnapshotOf::ResultAndParts);
  CHECK_FALSE(all.is_sealed);
  CHECK(all.header.cells.size() == header.cells.size());
  CHECK(all.ledger.contains(0, 0, 0));
  CHECK(all.ledger.contains(1, 0, 0));
  CHECK(blocks_of(all.ledger) > blocks_of(read_snapshot(path).ledger));
}

TEST_CASE("where nothing is to be seen, a line says why") {
  const ScratchFolder folder;
  const fs::path path = folder / "result.h5";
  const auto message = [&] { return refusal_of([&] { read_snapshot(path); }); };
  CHECK(lacking(message(), {path.string(), "does not exist"}) == "");
  const ResultWriter writer(path, sample_header());
  CHECK(lacking(message(), {path.string(), "holds no finished block", "look again"}) == "");
}

TEST_CASE("a damaged part is passed over, a part of another study is refused") {
  const ScratchFolder folder;
  const Header header = sample_header();
  const fs::path path = folder / "result.h5";
  run_half(path, header, sample_tasks(header));
  const std::uint64_t before = blocks_of(read_snapshot(path).ledger);
  const fs::path last = content_of(parts_folder(path)).parts.back();
  SECTION("damaged") {
    fs::resize_file(last, fs::file_size(last) - 100);
    const std::uint64_t after = blocks_of(read_snapshot(path).ledger);
    CHECK(after > 0);
    CHECK(after < before);
  }
  SECTION("of another study") {
    Header other = header;
    other.study_hash += "0";
    run_half(folder / "other.h5", other, sample_tasks(other));
    fs::rename(content_of(parts_folder(folder / "other.h5")).parts.front(), last);
    CHECK(lacking(refusal_of([&] { read_snapshot(path); }), {"belongs to another study"}) == "");
  }
}

TEST_CASE("snapshots beside a writer never fail, and what they count never shrinks") {
  const ScratchFolder folder;
  Header header = sample_header();
  header.trials = 30 * sample_block_trials;  // 150 blocks in parts of one each: these are united twice
  const fs::path path = folder / "result.h5";
  std::atomic<bool> over{false};
  std::jthread run([&] {
    ResultWriter writer(path, header);
    for (const auto& [cell, block] : sample_tasks(header)) {
      add(writer, header, cell, block);
      writer.flush();
    }
    writer.seal({});
    over = true;
  });
  while (content_of(parts_folder(path)).parts.empty() && !over) std::this_thread::yield();
  std::uint64_t before = 0;
  std::size_t looks = 0;
  for (bool is_last = false; !is_last; ++looks) {
    is_last = over;
    const Snapshot snapshot = read_snapshot(path, looks % 2 == 0 ? SnapshotOf::Result : SnapshotOf::ResultAndParts);
    const std::uint64_t now = blocks_of(snapshot.ledger);
    REQUIRE(now >= before);
    before = now;
  }
  CHECK(looks > 2);
  CHECK(before == blocks_of(read_result_ledger(path)));
}

TEST_CASE("a run says how far it is while it lives, and that it has stopped when it ends") {
  const ScratchFolder folder;
  const Header header = sample_header();
  const fs::path path = folder / "result.h5";
  const auto record = [&] { return find_run_record(parts_folder(path)); };
  {
    ResultWriter writer(path, header);
    CHECK_FALSE(record());
    writer.record([] {
      RunRecord said;
      said.seconds = 1.5;
      said.workers = 2;
      said.blocks_total = 7;
      said.trials_done = 70;
      return said;
    });
    while (!record()) std::this_thread::yield();
    CHECK(record()->record.state == RunRecord::State::Computing);
    CHECK(record()->record.seconds == 1.5);
    CHECK(record()->record.workers == 2);
    CHECK(record()->record.blocks_total == 7);
    CHECK(record()->record.trials_done == 70);
    CHECK(record()->record.process > 0);
    CHECK_FALSE(record()->record.machine.empty());
    CHECK(record()->age_s < 60.0);
    add(writer, header, 0, 0);
  }
  CHECK(record()->record.state == RunRecord::State::Stopped);
  { ResultWriter(path, header).seal({}); }
  CHECK_FALSE(fs::exists(parts_folder(path)));
}

TEST_CASE("a run lives if its record goes on, whatever the dates of files say") {
  const ScratchFolder folder;
  const fs::path file = run_record_file(folder.path());
  const auto write = [&](const std::string& seconds, const std::string& state) {
    std::ofstream(file.string() + ".new") << "state " << state << "\nseconds " << seconds << "\nprocess 7\n";
    fs::last_write_time(file.string() + ".new", fs::file_time_type::clock::now() - std::chrono::hours(1));
    fs::rename(file.string() + ".new", file);
  };
  CHECK_FALSE(find_living_run(folder.path()));
  write("1", "0");
  {
    const std::jthread run([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      write("3", "0");
    });
    const auto living = find_living_run(folder.path());
    REQUIRE(living);
    CHECK(living->process == 7);
  }
  // The last thing that it says may be that it stops.
  {
    const std::jthread run([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      write("4", "2");
    });
    CHECK_FALSE(find_living_run(folder.path()));
  }
  // One that was killed a moment ago, of a machine whose clock is ahead.
  write("5", "0");
  fs::last_write_time(file, fs::file_time_type::clock::now() + std::chrono::hours(1));
  CHECK_FALSE(find_living_run(folder.path()));
}

TEST_CASE("a record that cannot be read is none, and one that cannot be written harms nobody") {
  const ScratchFolder folder;
  CHECK_FALSE(find_run_record(folder.path()));
  for (const char* text : {"", "blocks_done many\n", "state 9\n"}) {
    std::ofstream(run_record_file(folder.path())) << text;
    CHECK_FALSE(find_run_record(folder.path()));
  }
  {
    const RunRecorder recorder(folder / "not_there", [] { return RunRecord(); });
  }
  CHECK_FALSE(fs::exists(folder / "not_there"));
}
