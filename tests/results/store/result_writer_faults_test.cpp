// What goes wrong around a writer: nothing finished is lost, and nothing damaged or foreign gets into the result.

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>

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

namespace {

fs::path first_part(const fs::path& path) {
  return content_of(parts_folder(path)).parts.front();
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
  return sample_block(header, 0, 0).take_columns().back().metrics[2][3];
}

}  // namespace

TEST_CASE("a killed run loses its unfinished part alone and leaves no trace") {
  const ScratchFolder folder;
  const Header header = sample_header();
  const Tasks tasks = sample_tasks(header);
  const fs::path path = folder / "result.h5";
  const pid_t child = ::fork();
  if (child == 0) {
    ResultWriter writer(path, header);
    for (std::size_t i = 0; i < 10; ++i) {
      add(writer, header, tasks[i].first, tasks[i].second);
      if (i == 6) writer.flush();
    }
    std::ofstream(parts_folder(path) / "part-000001.h5.77.ridgeloc-tmp") << "half a part";
    ::_exit(0);
  }
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  REQUIRE(status == 0);

  ResultWriter writer(path, header);
  CHECK_FALSE(fs::exists(parts_folder(path) / "part-000001.h5.77.ridgeloc-tmp"));
  CHECK(adopted(writer, header) == 7);
  run_missing(writer, header, tasks);
  writer.seal({});
  CHECK(data_digest(path) == digest_of_plain_run(folder / "reference.h5"));
  CHECK_FALSE(fs::exists(parts_folder(path)));
}

TEST_CASE("a full disk is an error like any other, and the finished parts stay") {
  const ScratchFolder folder;
  const Header header = sample_header();
  const Tasks tasks = sample_tasks(header);
  const fs::path path = folder / "result.h5";
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    // A limit on the size of files fails writes as a full disk does. The child leaves by exit(), as a program
    // would: that HDF5 does not crash on the way out is part of the test.
    std::signal(SIGXFSZ, SIG_IGN);
    const std::string message = message_of([&] {
      ResultWriter writer(path, header);
      add(writer, header, tasks[0].first, tasks[0].second);
      writer.flush();
      const rlimit limit{fs::file_size(first_part(path)) + 4096, RLIM_INFINITY};
      ::setrlimit(RLIMIT_FSIZE, &limit);
      for (std::size_t i = 1; i < tasks.size(); ++i) add(writer, header, tasks[i].first, tasks[i].second);
      writer.seal({});
    });
    std::exit(lacking(message, {"cannot write", "part-000001.h5", "File too large"}).empty() ? 0 : 1);
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
  const ScratchFolder folder;
  const Header header = sample_header();
  const Tasks tasks = sample_tasks(header);
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
  CHECK(lacking(writer.warnings()[0], {"part-000000.h5", "computed again"}) == "");
  CHECK(adopted(writer, header) == 0);
  CHECK(run_missing(writer, header, tasks) == tasks.size());
  writer.seal({});
  CHECK(data_digest(path) == digest_of_plain_run(folder / "reference.h5"));
  CHECK_FALSE(fs::exists(parts_folder(path)));
}

TEST_CASE("a result that would lack computed blocks is not sealed") {
  const ScratchFolder folder;
  const Header header = sample_header();
  const Tasks tasks = sample_tasks(header);
  const fs::path path = folder / "result.h5";
  {
    ResultWriter writer(path, header);
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      add(writer, header, tasks[i].first, tasks[i].second);
      if (i == 0 || i == 1) writer.flush();
    }
    fs::copy(parts_folder(path) / "part-000001.h5", folder / "copy.h5");
    fs::copy(parts_folder(path) / "part-000001.h5", parts_folder(path) / "part-000000.h5",
             fs::copy_options::overwrite_existing);
    CHECK(lacking(message_of([&] { writer.seal({}); }), {"3 of 15 pairs", "lack trials"}) == "");
    CHECK_FALSE(fs::exists(path));
  }
  ResultWriter writer(path, header);
  CHECK(adopted(writer, header) == tasks.size() - 1);
  run_missing(writer, header, tasks);
  writer.seal({});
  CHECK(data_digest(path) == digest_of_plain_run(folder / "reference.h5"));
}

TEST_CASE("files in the folder of parts that are none of the program's stay as they are") {
  const ScratchFolder folder;
  const Header header = sample_header();
  const fs::path path = folder / "result.h5";
  fs::create_directory(parts_folder(path));
  for (const char* name : {"mine.h5", "readme.txt"}) std::ofstream(parts_folder(path) / name) << "mine";
  {
    ResultWriter writer(path, header);
    CHECK(writer.warnings().empty());
    run_missing(writer, header, sample_tasks(header));
    writer.seal({});
  }
  CHECK(fs::exists(parts_folder(path) / "mine.h5"));
  CHECK(fs::exists(parts_folder(path) / "readme.txt"));
}

TEST_CASE("what a killed program left of its result is removed by the next run") {
  const ScratchFolder folder;
  const Header header = sample_header();
  std::ofstream(folder / "result.h5.4711.ridgeloc-tmp") << "half a result";
  std::ofstream(folder / "other.h5.4711.ridgeloc-tmp") << "of another";
  const ResultWriter writer(folder / "result.h5", header);
  CHECK_FALSE(fs::exists(folder / "result.h5.4711.ridgeloc-tmp"));
  CHECK(fs::exists(folder / "other.h5.4711.ridgeloc-tmp"));
}

TEST_CASE("a part that is damaged during the run stops the seal and keeps the others") {
  const ScratchFolder folder;
  const Header header = sample_header();
  const fs::path path = folder / "result.h5";
  {
    ResultWriter writer(path, header);
    add(writer, header, 0, 0);
    writer.flush();
    add(writer, header, 1, 0);
    damage(parts_folder(path) / "part-000000.h5", some_value(header));
    CHECK_THROWS_AS(writer.seal({}), core::IoError);
    CHECK_FALSE(fs::exists(path));
  }
  CHECK(adopted(ResultWriter(path, header), header) == 1);
}

TEST_CASE("parts of another study, experiment or instruction set are refused") {
  const ScratchFolder folder;
  const Header header = sample_header();
  const fs::path path = folder / "result.h5";
  run_half(path, header, sample_tasks(header));
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
  const std::string message = message_of([&] { ResultWriter(path, other); });
  CHECK(lacking(message, {parts_folder(path).string(), reason}) == "");
  CHECK(adopted(ResultWriter(path, header), header) > 0);
}

TEST_CASE("a result that another program has written meanwhile is not replaced, and the parts stay") {
  const ScratchFolder folder;
  const Header header = sample_header();
  const std::string digest = digest_of_plain_run(folder / "other.h5");
  {
    ResultWriter writer(folder / "r.h5", header);
    add(writer, header, 0, 0);
    fs::copy_file(folder / "other.h5", folder / "r.h5");
    CHECK_THROWS_AS(writer.seal({}), core::IoError);
  }
  CHECK(data_digest(folder / "r.h5") == digest);
  CHECK(fs::exists(parts_folder(folder / "r.h5")));
}
