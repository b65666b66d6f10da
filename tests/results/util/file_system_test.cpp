#include "results/util/file_system.hpp"

#include <fstream>

#include "core/error.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace ridgeloc;
using namespace ridgeloc::results;
namespace fs = std::filesystem;

namespace {

void write_text(const fs::path& path, const std::string& text) {
  std::ofstream(path) << text;
}

std::string read_text(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_CASE("a name from elsewhere stays in its folder") {
  for (const char* good : {"fig3a", "my study", "größe", "a+b", "x..y", "-x"}) CHECK(is_plain_file_name(good));
  for (const std::string bad : {"", ".", "..", ".hidden", "../x", "/etc/passwd", "a/b", "a\\b", "a\nb", "a\x7f"})
    CHECK_FALSE(is_plain_file_name(bad));
  CHECK_FALSE(is_plain_file_name(std::string("a\0b", 3)));
  CHECK_FALSE(is_plain_file_name(std::string(201, 'x')));
}

TEST_CASE("an output path is checked without leaving anything behind") {
  const tests::ScratchFolder folder;
  CHECK_NOTHROW(require_writable(folder / "new.h5"));
  CHECK(fs::is_empty(folder.path()));

  write_text(folder / "old.h5", "old");
  CHECK_NOTHROW(require_writable(folder / "old.h5"));
  CHECK(read_text(folder / "old.h5") == "old");
}

TEST_CASE("an impossible output path is refused with a line that says what to do") {
  const tests::ScratchFolder folder;
  const fs::path missing = folder / "no/such.h5";
  const auto message = [](const fs::path& path) { return tests::message_of([&] { require_writable(path); }); };
  CHECK(tests::lacking(message(missing), {"cannot write " + missing.string(), "does not exist; create it"}) == "");
  CHECK_THROWS_AS(require_writable(missing), core::InputError);
  CHECK(tests::lacking(message(folder.path()), {"it is a folder"}) == "");
  write_text(folder / "file", "");
  CHECK(tests::lacking(message(folder / "file/x.h5"), {"is not a folder"}) == "");
}

TEST_CASE("a temporary file takes its name when published and vanishes otherwise") {
  const tests::ScratchFolder folder;
  const fs::path file = folder / "result.h5";
  {
    const TemporaryFile abandoned(file);
    write_text(abandoned.path(), "half");
    CHECK(TemporaryFile::is_temporary(abandoned.path()));
  }
  CHECK(fs::is_empty(folder.path()));

  write_text(file, "old");
  TemporaryFile complete(file);
  write_text(complete.path(), "new");
  CHECK(read_text(file) == "old");
  complete.publish();
  CHECK(read_text(file) == "new");
  CHECK_FALSE(fs::exists(complete.path()));
}

TEST_CASE("temporaries of one file are apart, and have the rights that new files have") {
  const tests::ScratchFolder folder;
  const TemporaryFile first(folder / "result.h5");
  const TemporaryFile second(folder / "result.h5");
  CHECK(first.path() != second.path());
  write_text(folder / "plain", "");
  CHECK(fs::status(first.path()).permissions() == fs::status(folder / "plain").permissions());
  CHECK_THROWS_AS(TemporaryFile(folder / "no/such.h5"), core::IoError);
}

TEST_CASE("leftovers of a file are removed, and those of another one whose name begins alike are not") {
  const tests::ScratchFolder folder;
  const fs::path of_another = folder / "result.h5.csv.123.ridgeloc-tmp";
  write_text(folder / "result.h5.123.ridgeloc-tmp", "half");
  write_text(of_another, "half");
  TemporaryFile::remove_leftovers(folder / "result.h5");
  CHECK(fs::exists(of_another));
  CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 1);
}

TEST_CASE("publishing what is not there is an error") {
  const tests::ScratchFolder folder;
  TemporaryFile nothing(folder / "result.h5");
  fs::remove(nothing.path());
  CHECK_THROWS_AS(nothing.publish(), core::IoError);
}
