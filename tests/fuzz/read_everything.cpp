#include "tests/fuzz/read_everything.hpp"

#include <sstream>

#include "core/error.hpp"
#include "results/store/parts_folder.hpp"
#include "results/store/result_file.hpp"
#include "results/store/result_writer.hpp"
#include "results/summary/completeness.hpp"
#include "results/tables/csv.hpp"
#include "results/tables/table.hpp"

namespace ridgeloc::tests {

using namespace results;

namespace {

template <typename Read>
void attempt(Read&& read) {
  try {
    read();
  } catch (const core::InputError&) {
  }
}

}  // namespace

void read_everything(const std::filesystem::path& result) {
  std::ostringstream out;
  attempt([&] { read_completely(result); });  // the digest of the data and the ledger among all else
  attempt([&] { contributions_of(result); });
  attempt([&] {
    const Summary summary = read_result(result);
    out << summary_table(summary) << completeness_text(summary);
    write_summary_csv(summary, out);
  });
  attempt([&] { write_failures_csv(read_result_header(result), read_result_failures(result), out); });
  attempt([&] {
    const Header header = read_result_header(result);
    for (std::size_t cell = 0; cell < header.cells.size(); ++cell)
      for (std::size_t method = 0; method < header.methods.size(); ++method)
        write_trials_csv(header, cell, method, read_trials(result, cell, method), out);
  });
}

void continue_from_parts(const std::filesystem::path& result) {
  try {
    const std::vector<Header> headers = headers_at(result);
    if (headers.empty()) return;
    ResultWriter writer(result, headers.front());
    writer.seal({});
  } catch (const core::InputError&) {
  } catch (const core::IoError&) {
  }
}

}  // namespace ridgeloc::tests
