#include "studies/files/text_file.hpp"

#include <fstream>

#include "core/error.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;

TEST_CASE("a text is read whole, and not beyond its limit") {
  const tests::ScratchFolder folder;
  const std::string text(std::size_t{1} << 20, 'x');
  std::ofstream(folder / "all") << text;
  CHECK(read_text_file(folder / "all", 1) == text);
  std::ofstream(folder / "more") << text << 'x';
  CHECK(tests::refusal_of([&] { read_text_file(folder / "more", 1); }) ==
        (folder / "more").string() + ": is larger than 1 MiB, the most that is read of such a file");
  std::ofstream(folder / "none");
  CHECK(read_text_file(folder / "none", 1).empty());
}

TEST_CASE("what never ends or cannot be read is refused") {
  CHECK(tests::lacking(tests::refusal_of([] { read_text_file("/dev/zero", 1); }), {"/dev/zero: is larger than"}) == "");
  for (const char* unreadable : {"/", "nowhere"})
    CHECK(tests::lacking(tests::refusal_of([&] { read_text_file(unreadable, 1); }), {"cannot be read"}) == "");
}
