#include "results/pictures/gnuplot.hpp"

#include <fmt/core.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "core/error.hpp"
#include "results/util/file_system.hpp"
#include "results/util/shell.hpp"

namespace ridgeloc::results {
namespace {

/// A script in the folder for temporary files, removed at the end.
class ScriptFile {
 public:
  explicit ScriptFile(const std::string& text) : path_(temporary_name()) {
    const int descriptor = mkstemp(path_.data());
    if (descriptor < 0) {
      throw core::IoError(fmt::format("cannot create '{}' for gnuplot; set TMPDIR to a writable folder", path_));
    }
    std::FILE* file = fdopen(descriptor, "w");
    if (file == nullptr) close(descriptor);
    const bool written = file != nullptr && std::fwrite(text.data(), 1, text.size(), file) == text.size();
    if (file == nullptr || std::fclose(file) != 0 || !written) {
      std::filesystem::remove(path_);
      throw core::IoError(fmt::format("cannot write '{}' for gnuplot; is the disk full?", path_));
    }
  }
  ~ScriptFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  ScriptFile(const ScriptFile&) = delete;
  ScriptFile& operator=(const ScriptFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// A message of several lines as one.
std::string one_line(const std::string& output) {
  std::string line;
  for (const char c : output) {
    if (c == '\n' || c == '\t' || c == '\r') {
      if (!line.empty() && line.back() != ' ') line += ' ';
    } else {
      line += c;
    }
  }
  return line;
}

constexpr int command_not_found = 127;  // the shell's exit status

}  // namespace

void run_gnuplot(const std::string& script) {
  const ScriptFile file(script);
  // The script goes through a file so that the pipe is free for messages, and a missing gnuplot raises no
  // SIGPIPE.
  const std::string command = "gnuplot --default-settings " + shell_word(file.path()) + " 2>&1";
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw core::IoError("cannot start gnuplot: the system is out of processes or memory");
  std::string output;
  std::array<char, 512> buffer{};
  while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe) != nullptr) output += buffer.data();
  const int status = pclose(pipe);
  if (WIFEXITED(status) && WEXITSTATUS(status) == command_not_found) {
    throw core::InputError("figures need gnuplot, which is not on PATH: install the package gnuplot-nox");
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw core::IoError(fmt::format("gnuplot failed: {}", one_line(output)));
  }
}

std::string gnuplot_string(std::string_view text) {
  // Only what means nothing to gnuplot anywhere stands as it is: quotes, backquotes, macros and comments are looked for
  // in a line before its strings are.
  std::string quoted = "\"";
  bool after_escape = false;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool control = byte < 0x20U || byte == 0x7fU;
    // A digit after an escape would be read as a part of it.
    const bool is_letter = std::isalpha(byte) != 0 || (std::isdigit(byte) != 0 && !after_escape);
    const bool plain = byte >= 0x80U || is_letter || byte == ' ' || control;
    if (plain) {
      quoted += control ? ' ' : c;
    } else {
      quoted += fmt::format("\\{:03o}", byte);
    }
    after_escape = !plain;
  }
  return quoted + "\"";
}

std::string gnuplot_tick_label(std::string_view text) {
  std::string doubled;
  for (const char c : text) doubled += c == '%' ? std::string("%%") : std::string(1, c);
  return gnuplot_string(doubled);
}

}  // namespace ridgeloc::results
