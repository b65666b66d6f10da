#include "results/result_writer.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <random>
#include <thread>

#include "catch.hpp"
#include "core/error.hpp"
#include "results/result_file.hpp"
#include "results/sample_study.hpp"

using namespace ridgeloc;
using namespace ridgeloc::results;
namespace fs = std::filesystem;

namespace {

using Tasks = std::vector<std::pair<std::size_t, std::uint64_t>>;

void add(ResultWriter& writer, const Header& header, std::size_t cell, std::uint64_t block) {
  std::vector<BlockSink> blocks;
  blocks.push_back(test::sample_block(header, cell, block));
  writer.add(std::move(blocks));
}

const std::vector<std::size_t> all_methods = {0, 1, 2};

bool is_missing(const ResultWriter& writer, const Header& header, std::size_t cell, std::uint64_t block) {
  return !writer.missing_methods(cell, block, test::sample_trials_of(header, block), all_methods).empty();
}

/// How many of the tasks were taken over.
std::size_t adopted(const ResultWriter& writer, const Header& header) {
  return static_cast<std::size_t>(std::ranges::count_if(test::sample_tasks(header), [&](const auto& task) {
    return !is_missing(writer, header, task.first, task.second);
  }));
}

/// Computes what is missing, as a runner does, and counts it.
std::size_t run_missing(ResultWriter& writer, const Header& header, const Tasks& tasks) {
  std::size_t computed = 0;
  for (const auto& [cell, block] : tasks) {
    if (!is_missing(writer, header, cell, block)) continue;
    add(writer, header, cell, block);
    ++computed;
  }
  return computed;
}

std::string digest_of_plain_run(const fs::path& path) {
  const Header header = test::sample_header();
  ResultWriter writer(path, header);
  run_missing(writer, header, test::sample_tasks(header));
  writer.seal({});
  return data_digest(path);
}

fs::path parts_of(const fs::path& path) {
  return path.string() + ".parts";
}

fs::path first_part(const fs::path& path) {
  return *fs::directory_iterator(parts_of(path));
}

/// Adds the first half of the tasks as two parts and stops.
void run_half(const fs::path& path, const Header& header, const Tasks& tasks) {
  ResultWriter writer(path, header);
  for (std::size_t i = 0; i < tasks.size() / 2; ++i) {
    add(writer, header, tasks[i].first, tasks[i].second);
    if (i == tasks.size() / 4) writer.flush();
  }
}

/// Changes one bit of the first place where a value stands in a file.
void damage(const fs::path& path, double value) {
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(file), {}};
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  const std::size_t place = content.find(bytes);
  REQUIRE(place != std::string::npos);
  file.seekp(static_cast<std::streamoff>(place));
  file.put(static_cast<char>(content[place] ^ 1));
}

double some_value(const Header& header) {
  return test::sample_block(header, 0, 0).take_columns().back().metrics[2][3];
}

}  // namespace

TEST_CASE("a result has the same data for any order of blocks, any parts and any number of threads") {
  const test::ScratchFolder folder;
  const Header header = test::sample_header();
  const std::string reference = digest_of_plain_run(folder / "reference.h5");
  const fs::path path = folder / "other.h5";

  SECTION("shuffled, in several parts") {
    Tasks tasks = test::sample_tasks(header);
    std::shuffle(tasks.begin(), tasks.end(), std::mt19937(3));
    ResultWriter writer(path, header);
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      add(writer, header, tasks[i].first, tasks[i].second);
      if (i % 4 == 0) writer.flush();
    }
    writer.seal({});
  }
  SECTION("by two threads") {
    const Tasks tasks = test::sample_tasks(header);
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
  CHECK_FALSE(fs::exists(parts_of(path)));
}

TEST_CASE("a stopped run is taken over by the next one") {
  const test::ScratchFolder folder;
  const Header header = test::sample_header();
  Tasks tasks = test::sample_tasks(header);
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

TEST_CASE("a killed run loses its unfinished part alone and leaves no trace") {
  const test::ScratchFolder folder;
  const Header header = test::sample_header();
  const Tasks tasks = test::sample_tasks(header);
  const fs::path path = folder / "result.h5";
  const pid_t child = ::fork();
  if (child == 0) {
    ResultWriter writer(path, header);
    for (std::size_t i = 0; i < 10; ++i) {
      add(writer, header, tasks[i].first, tasks[i].second);
      if (i == 6) writer.flush();
    }
    std::ofstream(parts_of(path) / "part-000001.h5.77.ridgeloc-tmp") << "half a part";
    ::_exit(0);
  }
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  REQUIRE(status == 0);

  ResultWriter writer(path, header);
  CHECK_FALSE(fs::exists(parts_of(path) / "part-000001.h5.77.ridgeloc-tmp"));
  CHECK(adopted(writer, header) == 7);
  run_missing(writer, header, tasks);
  writer.seal({});
  CHECK(data_digest(path) == digest_of_plain_run(folder / "reference.h5"));
  CHECK_FALSE(fs::exists(parts_of(path)));
}

TEST_CASE("a full disk is an error like any other, and the finished parts stay") {
  const test::ScratchFolder folder;
  const Header header = test::sample_header();
  const Tasks tasks = test::sample_tasks(header);
  const fs::path path = folder / "result.h5";
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    // A limit on the size of files fails writes as a full disk does. The child leaves by exit(), as a program
    // would: that HDF5 does not crash on the way out is part of the test.
    std::signal(SIGXFSZ, SIG_IGN);
    const std::string message = test::message_of([&] {
      ResultWriter writer(path, header);
      add(writer, header, tasks[0].first, tasks[0].second);
      writer.flush();
      const rlimit limit{fs::file_size(first_part(path)) + 4096, RLIM_INFINITY};
      ::setrlimit(RLIMIT_FSIZE, &limit);
      for (std::size_t i = 1; i < tasks.size(); ++i) add(writer, header, tasks[i].first, tasks[i].second);
      writer.seal({});
    });
    std::exit(test::lacking(message, {"cannot write", "part-000001.h5", "File too large"}).empty() ? 0 : 1);
  }
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  REQUIRE(status == 0);

  ResultWriter writer(path, header);
  CHECK(writer.warnings().empty());
  CHECK(adopted(writer, header) == 1);
  run_missing(writer, header, tasks);
  writer.seal({});
  CHECK(data_digest(path) == digest_of_plain_run(folder / "reference.h5"));
}

TEST_CASE("a damaged part is reported and its blocks are computed again") {
  const test::ScratchFolder folder;
  const Header header = test::sample_header();
  const Tasks tasks = test::sample_tasks(header);
  const fs::path path = folder / "result.h5";
  {
    ResultWriter writer(path, header);
    for (std::size_t i = 0; i < 5; ++i) add(writer, header, tasks[i].first, tasks[i].second);
  }
  SECTION("a bit of a value has changed") {
    damage(first_part(path), some_value(header));
  }
  SECTION("a bit of HDF5's own bookkeeping has changed") {
    std::fstream file(first_part(path), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(100);
    file.put('\xff');
  }
  SECTION("the file was cut short") {
    fs::resize_file(first_part(path), fs::file_size(first_part(path)) / 2);
  }
  SECTION("the file is empty") {
    fs::resize_file(first_part(path), 0);
  }

  ResultWriter writer(path, header);
  REQUIRE(writer.warnings().size() == 1);
  CHECK(test::lacking(writer.warnings()[0], {"part-000000.h5", "computed again"}) == "");
  CHECK(adopted(writer, header) == 0);
  CHECK(run_missing(writer, header, tasks) == tasks.size());
  writer.seal({});
  CHECK(data_digest(path) == digest_of_plain_run(folder / "reference.h5"));
  CHECK_FALSE(fs::exists(parts_of(path)));
}

TEST_CASE("a result that would lack computed blocks is not sealed") {
  const test::ScratchFolder folder;
  const Header header = test::sample_header();
  const Tasks tasks = test::sample_tasks(header);
  const fs::path path = folder / "result.h5";
  {
    ResultWriter writer(path, header);
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      add(writer, header, tasks[i].first, tasks[i].second);
      if (i == 0 || i == 1) writer.flush();
    }
    fs::copy(parts_of(path) / "part-000001.h5", folder / "copy.h5");
    fs::copy(parts_of(path) / "part-000001.h5", parts_of(path) / "part-000000.h5",
             fs::copy_options::overwrite_existing);
    CHECK(test::lacking(test::message_of([&] { writer.seal({}); }), {"3 of 15 pairs", "lack trials"}) == "");
    CHECK_FALSE(fs::exists(path));
  }
  ResultWriter writer(path, header);
  CHECK(adopted(writer, header) == tasks.size() - 1);
  run_missing(writer, header, tasks);
  writer.seal({});
  CHECK(data_digest(path) == digest_of_plain_run(folder / "reference.h5"));
}

TEST_CASE("a sealed result is continued with what it lacks: other blocks, a longer last block, other cells") {
  const test::ScratchFolder folder;
  const Header header = test::sample_header();
  const fs::path path = folder / "result.h5";
  Header narrow = header;
  narrow.study_toml = "title = \"narrow\"\n";
  narrow.trials = 2 * test::sample_block_trials + 5;
  narrow.axes[0].values = {std::int64_t{3}, std::int64_t{4}};
  narrow.cells = {{"c0", {0, 0}}, {"c2", {1, 0}}, {"c3", {1, 1}}};
  {
    ResultWriter writer(path, narrow);
    run_missing(writer, narrow, test::sample_tasks(narrow));
    writer.seal({});
  }
  ResultWriter writer(path, header);
  CHECK(adopted(writer, header) == 2 * narrow.cells.size());  // the last block is too short
  CHECK_FALSE(writer.is_current());
  run_missing(writer, header, test::sample_tasks(header));
  writer.seal({});
  CHECK(data_digest(path) == digest_of_plain_run(folder / "reference.h5"));
}

TEST_CASE("many small parts become few") {
  const test::ScratchFolder folder;
  Header header = test::sample_header();
  header.trials = 40 * test::sample_block_trials;
  const Tasks tasks = test::sample_tasks(header);
  const fs::path path = folder / "result.h5";
  {
    ResultWriter writer(path, header);
    std::size_t most = 0;
    for (const auto& [cell, block] : tasks) {
      add(writer, header, cell, block);
      writer.flush();
      most = std::max(most, static_cast<std::size_t>(std::distance(fs::directory_iterator(parts_of(path)), {})));
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

TEST_CASE("what a killed program left of its result is removed by the next run") {
  const test::ScratchFolder folder;
  const Header header = test::sample_header();
  std::ofstream(folder / "result.h5.4711.ridgeloc-tmp") << "half a result";
  std::ofstream(folder / "other.h5.4711.ridgeloc-tmp") << "of another";
  const ResultWriter writer(folder / "result.h5", header);
  CHECK_FALSE(fs::exists(folder / "result.h5.4711.ridgeloc-tmp"));
  CHECK(fs::exists(folder / "other.h5.4711.ridgeloc-tmp"));
}

TEST_CASE("a part that is damaged during the run stops the seal and keeps the others") {
  const test::ScratchFolder folder;
  const Header header = test::sample_header();
  const fs::path path = folder / "result.h5";
  {
    ResultWriter writer(path, header);
    add(writer, header, 0, 0);
    writer.flush();
    add(writer, header, 1, 0);
    damage(parts_of(path) / "part-000000.h5", some_value(header));
    CHECK_THROWS_AS(writer.seal({}), core::IoError);
    CHECK_FALSE(fs::exists(path));
  }
  CHECK(adopted(ResultWriter(path, header), header) == 1);
}

TEST_CASE("parts of another study, experiment or instruction set are refused") {
  const test::ScratchFolder folder;
  const Header header = test::sample_header();
  const fs::path path = folder / "result.h5";
  run_half(path, header, test::sample_tasks(header));
  Header other = header;
  std::string reason;
  SECTION("study") {
    other.study_hash += "0";
    reason = "another study";
  }
  SECTION("experiment") {
    ++other.experiment_version;
    reason = "by version 3 of the experiment";
  }
  SECTION("instruction set") {
    other.isa = "avx2";
    reason = "--isa baseline";
  }
  CHECK_THROWS_AS(ResultWriter(path, other), core::InputError);
  const std::string message = test::message_of([&] { ResultWriter(path, other); });
  CHECK(test::lacking(message, {parts_of(path).string(), reason}) == "");
  CHECK(adopted(ResultWriter(path, header), header) > 0);
}

TEST_CASE("a writer that took no trial leaves nothing behind") {
  const test::ScratchFolder folder;
  { const ResultWriter writer(folder / "result.h5", test::sample_header()); }
  CHECK(fs::is_empty(folder.path()));
  CHECK_THROWS_AS(ResultWriter(folder / "no/result.h5", test::sample_header()), core::InputError);
  CHECK(fs::is_empty(folder.path()));
}

TEST_CASE("a result that another program has written meanwhile is not replaced, and the parts stay") {
  const test::ScratchFolder folder;
  const Header header = test::sample_header();
  const std::string digest = digest_of_plain_run(folder / "other.h5");
  {
    ResultWriter writer(folder / "r.h5", header);
    add(writer, header, 0, 0);
    fs::copy_file(folder / "other.h5", folder / "r.h5");
    CHECK_THROWS_AS(writer.seal({}), core::IoError);
  }
  CHECK(data_digest(folder / "r.h5") == digest);
  CHECK(fs::exists(parts_of(folder / "r.h5")));
}

TEST_CASE("two runs cannot write the same result at once") {
  const test::ScratchFolder folder;
  const ResultWriter writer(folder / "result.h5", test::sample_header());
  const std::string message = test::message_of([&] { ResultWriter(folder / "result.h5", test::sample_header()); });
  CHECK(test::lacking(message, {"another run is writing"}) == "");
}
