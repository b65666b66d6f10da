#pragma once
// Internal to results: names that the writer and the readers of sealed results share.

#include <cstdint>
#include <string>

namespace ridgeloc::results::layout {

inline constexpr const char* filetype = "ridgeloc-result";
inline constexpr std::uint64_t major_version = 2;
inline constexpr std::uint64_t minor_version = 0;
inline constexpr const char* digest_attribute = "data_sha256";
inline constexpr const char* totals_digest_attribute = "totals_sha256";
inline constexpr const char* attributes_digest_attribute = "attributes_sha256";

inline std::string trials_group(std::size_t cell) {
  return "/trials/" + std::to_string(cell);
}
inline std::string trials_group(std::size_t cell, const std::string& method) {
  return trials_group(cell) + "/" + method;
}

}  // namespace ridgeloc::results::layout
