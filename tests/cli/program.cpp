#include "tests/cli/program.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace ridgeloc::tests {

namespace fs = std::filesystem;

namespace {

std::string contents(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace

Outcome WorkingFolder::ridgeloc(const std::string& arguments) const {
  return shell("'" RIDGELOC_PROGRAM "' " + arguments);
}

Outcome WorkingFolder::shell(const std::string& command) const {
  const fs::path out = path().string() + ".out";
  const fs::path error = path().string() + ".err";
  const std::string line =
      "cd '" + path().string() + "' && ( " + command + " ) > '" + out.string() + "' 2> '" + error.string() + "'";
  const int status = std::system(line.c_str());
  Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(out), contents(error)};
  fs::remove(out);
  fs::remove(error);
  return outcome;
}

void WorkingFolder::write(const std::string& name, const std::string& text) const {
  std::ofstream(path() / name, std::ios::binary) << text;
}

std::string WorkingFolder::read(const std::string& name) const {
  return contents(path() / name);
}

bool WorkingFolder::has(const std::string& name) const {
  return fs::exists(path() / name);
}

std::vector<std::string> WorkingFolder::entries() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(path())) names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

std::size_t line_count(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

}  // namespace ridgeloc::tests
