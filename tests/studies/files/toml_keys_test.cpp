#include "studies/files/toml_keys.hpp"

#include <string>

#include "tests/support/catch.hpp"
#include "tests/support/valid_study.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;

namespace {

std::string key_of(std::size_t parts, const std::string& part = "a") {
  std::string key = part;
  for (std::size_t i = 1; i < parts; ++i) key += "." + part;
  return key;
}

}  // namespace

TEST_CASE("keys of many parts are found, wherever they stand") {
  const std::string deep = key_of(most_key_parts + 1);
  for (const std::string& text : {deep + " = 1", "[" + deep + "]", "x = { " + deep + " = 1 }",
                                  key_of(most_key_parts + 1, "\"a.b\"") + " = 1", "x = 'it''s' # \"\n" + deep + " = 1"})
    CHECK(line_of_deep_key(text).has_value());
  CHECK(line_of_deep_key("a = 1\n\n" + deep) == 3U);
  CHECK_FALSE(line_of_deep_key(key_of(most_key_parts) + " = 1").has_value());
}

TEST_CASE("dots in numbers, texts and comments are no keys") {
  std::string numbers = "x = [";
  for (int i = 0; i < 1000; ++i) numbers += "0.5, ";
  const std::string dots(1000, '.');
  for (const std::string& text :
       {numbers + "]", "title = \"" + dots + "\"", "title = '" + dots + "'", "t = \"\"\"a\"\"b" + dots + "\"\"\"",
        "t = '''a\n" + dots + "'''", "t = \"\\\"" + dots + "\"", "# " + dots, std::string("\"")})
    CHECK_FALSE(line_of_deep_key(text).has_value());
}

TEST_CASE("a study with a key of a hundred thousand parts is refused in one line") {
  const std::string message = tests::error_of(tests::valid + key_of(100'000) + " = 1\n");
  CHECK(message == "demo.toml:11: a key has more than 100 parts");
  CHECK(tests::error_of(tests::valid, {key_of(100'000) + "=1"}).find("a key has more than 100 parts") !=
        std::string::npos);
}
