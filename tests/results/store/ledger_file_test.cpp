#include "results/store/ledger_file.hpp"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "results/summary/summary.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"
#include "tests/support/scratch_folder.hpp"

namespace {

using namespace ridgeloc;
using namespace ridgeloc::results;

Header header_of_one_metric() {
  Header header;
  header.block_trials = 120;
  header.schema.metrics = {{"m", "m", "", false}};
  header.cells = {{"cell", {}}};
  header.methods = {{"rr", "", ""}};
  return header;
}

/// The histograms of version 1: `counts` of the bins `first`, `first` + 1, ... of one row with one metric.
hdf5::File file_before_2(const std::filesystem::path& path, std::uint32_t first,
                         const std::vector<std::uint64_t>& counts, double max) {
  hdf5::File file = hdf5::File::create(path);
  file.create_group("/ledger");
  using Counts = std::vector<std::uint64_t>;
  for (const char* zero : {"cell", "method", "first_block"}) file.write(std::string("/ledger/") + zero, Counts{0});
  file.write("/ledger/blocks", Counts{1});
  file.write("/ledger/trials", Counts{120});
  file.write("/ledger/reports_events", std::vector<std::uint8_t>{0});
  file.write("/ledger/events", Counts{}, {1, 0});
  file.write("/ledger/n", Counts{80}, {1, 1});
  file.write("/ledger/beyond", Counts{40}, {1, 1});
  for (const char* moment : {"mean", "m2", "m3", "m4", "min"})
    file.write(std::string("/ledger/") + moment, std::vector<double>{0.0}, {1, 1});
  file.write("/ledger/max", std::vector<double>{max}, {1, 1});
  file.write("/ledger/histogram_first_bin", std::vector<std::uint32_t>{first}, {1, 1});
  file.write("/ledger/histogram_offset", Counts{0, counts.size()});
  file.write("/ledger/histogram_count", counts);
  file.write("/ledger/digest_offset", Counts{0, 1});
  file.write("/ledger/digest", Counts{7});
  file.close();
  return hdf5::File::open(path);
}

TEST_CASE("histograms of version 1 are read, and what they do not know is not guessed") {
  const tests::ScratchFolder folder;
  const Header header = header_of_one_metric();
  // Bins of 0, of 1 (octave 0 is the 41st) and of all from 2^20 on.
  std::vector<std::uint64_t> counts(1922);
  counts[0] = 20;
  counts[1 + 40 * 32] = 60;
  counts[1921] = 40;
  const double max = GENERATE(4e6, std::numeric_limits<double>::infinity());
  const Ledger ledger = read_ledger(file_before_2(folder / "r.h5", 0, counts, max), header);
  const Statistics& statistics = (*ledger.rows().begin()).statistics;
  using Bins = std::vector<Histogram::Bin>;
  CHECK(statistics.metrics[0].histogram.bins() ==
        Bins{{0, 20}, {Histogram::bin_of(1.0), 60}, {Histogram::infinite_bin, 40}});
  const SummaryRow row = summary_row(header, 0, statistics, "m");
  CHECK(row.p50 == Approx(1.0).epsilon(1.0 / 32));
  // A third of the values lie from 2^20 on. Where the largest is finite, so are all, but where they lie is not known.
  CHECK((std::isfinite(max) ? std::isnan(row.p95) : std::isinf(row.p95)));
  CHECK((std::isfinite(max) ? std::isnan(row.p95_hi) : std::isinf(row.p95_hi)));
}

TEST_CASE("histograms of version 1 that leave the grid are damage") {
  const tests::ScratchFolder folder;
  const auto read = [&](std::uint32_t first, const std::vector<std::uint64_t>& counts) {
    const hdf5::File file = file_before_2(folder / "r.h5", first, counts, 1.0);
    return tests::message_of([&] { static_cast<void>(read_ledger(file, header_of_one_metric())); });
  };
  CHECK(read(1921, {6}) == "");
  for (const auto& [first, counts] :
       {std::pair(1921U, std::vector<std::uint64_t>{3, 3}), std::pair(1923U, std::vector<std::uint64_t>{}),
        std::pair(4000000000U, std::vector<std::uint64_t>{6})}) {
    CHECK(read(first, counts).find("has a histogram with bins outside the grid") != std::string::npos);
  }
}

}  // namespace
