#include "studies/files/text_file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <vector>

#include "core/error.hpp"

namespace ridgeloc::studies {

std::string read_text_file(const std::filesystem::path& path, std::size_t most_mib) {
  const std::size_t most = most_mib << 20;
  std::ifstream file(path, std::ios::binary);
  std::vector<char> piece(std::size_t{1} << 16);
  std::string text;
  while (file && text.size() <= most) {
    file.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    text.append(piece.data(), static_cast<std::size_t>(file.gcount()));
  }
  if (text.size() > most) {
    throw core::InputError(
        fmt::format("{}: is larger than {} MiB, the most that is read of such a file", path.string(), most_mib));
  }
  if (!file.eof() || file.bad())
    throw core::InputError(fmt::format("{}: cannot be read; check its permissions", path.string()));
  return text;
}

}  // namespace ridgeloc::studies
