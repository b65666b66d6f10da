#pragma once

#include <functional>
#include <string>

namespace ridgeloc::app {

/// Reads a result file in a child process, whose memory and time are limited in proportion to the file, and drops what
/// was read. The HDF5 library crashes on some damaged files, and files can be made to ask for any amount of memory: the
/// child finds out. Throws core::InputError if it does not survive; errors that `read` throws are left to be found
/// again. Precondition: this process has one thread.
void probe(const std::string& result, const std::function<void()>& read);

/// What `read` returns, after a child process has survived the same.
template <typename Read>
auto read_probed(const std::string& result, Read&& read) {
  probe(result, [&read] { read(); });
  return read();
}

}  // namespace ridgeloc::app
