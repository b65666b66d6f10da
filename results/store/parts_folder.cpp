#include "results/store/parts_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>

#include "core/error.hpp"
#include "results/store/part.hpp"
#include "results/store/result_file.hpp"
#include "results/util/file_system.hpp"

namespace ridgeloc::results {

namespace fs = std::filesystem;

namespace {

constexpr const char* part_prefix = "part-";
constexpr const char* part_extension = ".h5";

}  // namespace

fs::path parts_folder(const fs::path& result) {
  return result.string() + ".parts";
}

std::string part_name(std::uint64_t number) {
  return fmt::format("{}{:06}{}", part_prefix, number, part_extension);
}

std::uint64_t part_number(const fs::path& part) {
  const std::string stem = part.stem().string();
  const std::string_view prefix = part_prefix;
  std::uint64_t number = 0;
  if (stem.starts_with(prefix)) std::from_chars(stem.data() + prefix.size(), stem.data() + stem.size(), number);
  return number;
}

PartsFolderContent content_of(const fs::path& folder) {
  PartsFolderContent content;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    if (TemporaryFile::is_temporary(entry.path())) {
      content.temporaries.push_back(entry.path());
    } else if (entry.path().extension() == part_extension &&
               entry.path().filename().string().starts_with(part_prefix)) {
      content.parts.push_back(entry.path());
    }
  }
  std::ranges::sort(content.parts, {}, [](const fs::path& part) { return std::tuple(part_number(part), part); });
  return content;
}

std::uintmax_t stored_bytes(const fs::path& path) {
  std::vector<fs::path> files = content_of(parts_folder(path)).parts;
  files.push_back(path);
  std::uintmax_t bytes = 0;
  for (const fs::path& file : files) {
    std::error_code absent;
    const std::uintmax_t size = fs::file_size(file, absent);
    if (!absent) bytes += size;
  }
  return bytes;
}

std::vector<Header> headers_at(const fs::path& path) {
  std::vector<Header> headers;
  std::error_code unknown;
  if (fs::exists(path, unknown)) headers.push_back(read_result_header(path));
  for (const fs::path& part : content_of(parts_folder(path)).parts) {
    try {
      Header header = read_part_header(part);
      const bool is_known = std::ranges::find(headers, header.study_toml, &Header::study_toml) != headers.end();
      if (!is_known) headers.push_back(std::move(header));
    } catch (const core::IoError&) {
      continue;
    }
  }
  return headers;
}

}  // namespace ridgeloc::results
