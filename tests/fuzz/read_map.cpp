// Any text as a map of a building: it is refused in one line, or written as it reads.

#include "studies/files/map_reader.hpp"
#include "studies/files/toml_document.hpp"
#include "studies/study/setting_builders.hpp"
#include "tests/fuzz/refused.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Setting setting = Section("building").building("map", *find_building("paper"), "");
  tests::is_refused([&] {
    toml::table document = parse_document(tests::text_of(data, size), "map.toml", {});
    document.erase("file");
    const Value map = read_building(document, setting, "map");
    const toml::table written = parse_document("map = " + to_toml(map), "map.toml", {});
    if (read_building(*written.get("map"), setting, "map") != std::get<Building>(map)) __builtin_trap();
  });
  return 0;
}
