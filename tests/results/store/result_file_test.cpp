#include "results/store/result_file.hpp"

#include <sys/stat.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "core/error.hpp"
#include "results/hdf5/hdf5.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"
#include "tests/support/same_bits.hpp"
#include "tests/support/sample_result.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace ridgeloc;
using namespace ridgeloc::results;
namespace fs = std::filesystem;

namespace {

/// Changes one bit of the first place in a file where a text stands.
void damage_text(const fs::path& path, const std::string& text) {
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(file), {}};
  const std::size_t place = content.find(text);
  REQUIRE(place != std::string::npos);
  file.seekp(static_cast<std::streamoff>(place));
  file.put(static_cast<char>(text[0] ^ 1));
}

}  // namespace

TEST_CASE("a sealed result gives back its header") {
  const tests::ScratchFolder folder;
  Header header = tests::sample_header();
  header.axes[1].values = {0.1, std::string("street")};
  tests::write_sample(folder / "r.h5", header);
  const Header read = read_result_header(folder / "r.h5");

  CHECK(read.title == header.title);
  CHECK(read.aims == header.aims);
  CHECK(read.experiment == header.experiment);
  CHECK(read.experiment_version == header.experiment_version);
  CHECK(read.study_hash == header.study_hash);
  CHECK(read.study_toml == header.study_toml);
  CHECK(read.seed == header.seed);
  CHECK(read.trials == header.trials);
  CHECK(read.block_trials == header.block_trials);
  CHECK(read.kept_trials == header.kept_trials);
  CHECK(read.isa == header.isa);
  CHECK(read.schema.statuses == header.schema.statuses);
  REQUIRE(read.schema.metrics.size() == header.schema.metrics.size());
  for (std::size_t m = 0; m < header.schema.metrics.size(); ++m) {
    CHECK(read.schema.metrics[m].name == header.schema.metrics[m].name);
    CHECK(read.schema.metrics[m].unit == header.schema.metrics[m].unit);
    CHECK(read.schema.metrics[m].description == header.schema.metrics[m].description);
    CHECK(read.schema.metrics[m].heavy_tailed == header.schema.metrics[m].heavy_tailed);
    CHECK(read.schema.metrics[m].whole_numbers == header.schema.metrics[m].whole_numbers);
    CHECK(read.schema.metrics[m].yes_no == header.schema.metrics[m].yes_no);
    CHECK(read.schema.metrics[m].alarm == header.schema.metrics[m].alarm);
  }
  REQUIRE(read.schema.events.size() == header.schema.events.size());
  CHECK(read.schema.events[2].name == "diverged");
  CHECK(read.schema.events[2].description == "it was not");
  REQUIRE(read.axes.size() == 2);
  CHECK(read.axes[0].name == "points");
  CHECK(read.axes[1].unit == "m");
  CHECK(read.axes[1].description == "noise");
  CHECK(read.axes[0].values == header.axes[0].values);
  CHECK(read.axes[1].values == header.axes[1].values);
  REQUIRE(read.cells.size() == header.cells.size());
  CHECK(read.cells[4].hash == "c4");
  CHECK(read.cells[4].indices == header.cells[4].indices);
  REQUIRE(read.methods.size() == header.methods.size());
  CHECK(read.methods[1].label == header.methods[1].label);
  CHECK(read.methods[1].hash == header.methods[1].hash);
  CHECK(read.methods[1].description == header.methods[1].description);
  REQUIRE(read.figures.size() == 2);
  CHECK(read.figures[1].kind == "ecdf");
  CHECK(read.figures[1].x.empty());
  const FigureSpec& figure = read.figures[0];
  CHECK(figure.name == "error");
  CHECK(figure.title == "Error");
  CHECK(figure.kind == "curve");
  CHECK(figure.x == "points");
  CHECK(figure.y == header.figures[0].y);
  CHECK(figure.statistic == "median");
  CHECK(figure.group == header.figures[0].group);
  CHECK(figure.facet.empty());
  CHECK(figure.methods.empty());
  CHECK(figure.where == header.figures[0].where);
  CHECK(figure.log_y);
  CHECK_FALSE(figure.bounds);
  CHECK(read.figures[1].bounds);
  CHECK(read.schema.metrics[0].bound == "crb_m");
  CHECK(read.schema.metrics[1].bound.empty());
  CHECK(read.schema.metrics[0].chi_square == 0);
  CHECK(read.schema.metrics[1].chi_square == 3);
  CHECK(read.cells[0].bound == BoundKind::None);
  CHECK(read.cells[1].bound == BoundKind::Quantiles);
  CHECK(read.cells[4].bound == BoundKind::RootMeanSquare);
}

TEST_CASE("a sealed result gives back the totals and the rows behind them") {
  const tests::ScratchFolder folder;
  const Header header = tests::sample_header();
  tests::write_sample(folder / "r.h5", header);
  Ledger expected(header.block_trials);
  for (const auto& [cell, block] : tests::sample_tasks(header))
    for (Row& row : tests::sample_block(header, cell, block).take_rows()) expected.insert(std::move(row));

  const Ledger ledger = read_result_ledger(folder / "r.h5");
  CHECK(std::vector<Row>(ledger.rows().begin(), ledger.rows().end()) ==
        std::vector<Row>(expected.rows().begin(), expected.rows().end()));
  const Summary summary = read_result(folder / "r.h5");
  for (std::size_t cell = 0; cell < header.cells.size(); ++cell)
    for (std::size_t method = 0; method < header.methods.size(); ++method)
      CHECK(summary.of(cell, method) == expected.total(cell, method));
}

TEST_CASE("a sealed result gives back its provenance") {
  const tests::ScratchFolder folder;
  tests::write_sample(folder / "r.h5", tests::sample_header());
  const Provenance read = read_provenance(folder / "r.h5");
  CHECK(read.program_version == "0.1.0");
  CHECK(read.processor == processor_model());
  CHECK(read.date.size() == std::string("2018-10-01T00:00:00Z").size());
  CHECK(read.contributions.empty());
  REQUIRE(read.libraries.size() == 2);
  CHECK(read.libraries[0] == std::pair<std::string, std::string>("Eigen", "3.4.0"));
  CHECK(read.libraries[1] == std::pair<std::string, std::string>("HDF5", hdf5::library_version()));
  CHECK(read.wall_time_s == std::vector<std::pair<std::string, double>>{{"run", 1.5}});
  CHECK_THROWS_AS(read_provenance(folder / "missing.h5"), core::InputError);
}

TEST_CASE("a sealed result gives back the kept trials") {
  const tests::ScratchFolder folder;
  const Header header = tests::sample_header();
  tests::write_sample(folder / "r.h5", header);
  const TrialTable table = read_trials(folder / "r.h5", 3, 1);
  REQUIRE(table.trial.size() == header.kept_trials);
  for (std::uint64_t t = 0; t < table.trial.size(); ++t) REQUIRE(table.trial[t] == t);

  std::vector<std::uint8_t> status;
  std::vector<double> error;
  for (std::uint64_t block = 0; block * header.block_trials < header.kept_trials; ++block) {
    const TrialColumns columns = tests::sample_block(header, 3, block).take_columns()[1];
    status.insert(status.end(), columns.status.begin(), columns.status.end());
    error.insert(error.end(), columns.metrics[0].begin(), columns.metrics[0].end());
  }
  CHECK(table.status == status);
  CHECK(tests::same_bits(table.metrics[0], error));
  CHECK(table.metrics[2].empty());

  const TrialTable scene = read_trials(folder / "r.h5", 3, 2);
  CHECK(scene.status.empty());
  CHECK(scene.metrics[0].empty());
  CHECK(scene.metrics[2].size() == table.trial.size());
  CHECK_THROWS_AS(read_trials(folder / "r.h5", 5, 0), core::InputError);
}

TEST_CASE("a study without sweep and without kept trials is a result like any other") {
  const tests::ScratchFolder folder;
  Header header = tests::sample_header();
  header.axes.clear();
  header.cells = {{"only", {}}};
  header.figures.clear();
  header.kept_trials = 0;
  tests::write_sample(folder / "r.h5", header);
  const Summary summary = read_result(folder / "r.h5");
  CHECK(summary.header.axes.empty());
  CHECK(summary.of(0, 0).trials == header.trials);
  CHECK(read_trials(folder / "r.h5", 0, 0).trial.empty());
  const hdf5::File file = hdf5::File::open(folder / "r.h5");
  CHECK(file.shape("/summary/error_m") == hdf5::Shape{3, 25});
}

TEST_CASE("the summary is a grid where all its points are cells, and else as large as the cells") {
  const tests::ScratchFolder folder;
  const auto written = [&](const Header& header) {
    tests::write_sample(folder / "r.h5", header);
    return hdf5::File::open(folder / "r.h5");
  };
  Header header = tests::sample_header();
  {
    const hdf5::File file = written(header);
    CHECK(file.shape("/summary/error_m") == hdf5::Shape{5, 3, 25});
    CHECK(file.read<std::int64_t>("/summary/cell") == std::vector<std::int64_t>{0, 1, 2, 3, 4});
    CHECK(file.read<std::int64_t>("/summary/points") == std::vector<std::int64_t>{3, 3, 4, 4, 7});
    CHECK(file.read<double>("/summary/sigma_m") == std::vector<double>{0.1, 1.0 / 3.0, 0.1, 1.0 / 3.0, 1.0 / 3.0});
    CHECK(file.text_attribute("/summary/error_m", "coordinates") == "points sigma_m");
  }
  header.cells.insert(header.cells.begin() + 4, {"c5", {2, 0}});
  const hdf5::File file = written(header);
  CHECK(file.shape("/summary/error_m") == hdf5::Shape{3, 2, 3, 25});
  CHECK(file.read<std::int64_t>("/summary/points") == std::vector<std::int64_t>{3, 4, 7});
  CHECK_FALSE(file.contains("/summary/cell"));
  CHECK_FALSE(file.has_attribute("/summary/error_m", "coordinates"));
}

TEST_CASE("totals that have changed since the result was sealed are not read") {
  const tests::ScratchFolder folder;
  const Header header = tests::sample_header();
  tests::write_sample(folder / "r.h5", header);
  const double value = read_result(folder / "r.h5").of(0, 0).metrics[0].min;
  std::fstream file(folder / "r.h5", std::ios::in | std::ios::out | std::ios::binary);
  std::string bytes(fs::file_size(folder / "r.h5"), '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  const std::string pattern(reinterpret_cast<const char*>(&value), sizeof value);
  std::size_t changed = 0;
  for (auto at = bytes.find(pattern); at != std::string::npos; at = bytes.find(pattern, at + 1), ++changed) {
    file.seekp(static_cast<std::streamoff>(at));
    file.put(static_cast<char>(bytes[at] ^ 1));
  }
  file.close();
  REQUIRE(changed > 0);
  CHECK_THROWS_AS(read_result(folder / "r.h5"), core::InputError);
}

TEST_CASE("the digest of a result ignores provenance, title and figures, and not the numbers") {
  const tests::ScratchFolder folder;
  Header header = tests::sample_header();
  tests::write_sample(folder / "a.h5", header);
  header.title = "another";
  header.figures.clear();
  tests::write_sample(folder / "b.h5", header);
  CHECK(data_digest(folder / "a.h5") == data_digest(folder / "b.h5"));
  header.trials -= 1;
  tests::write_sample(folder / "c.h5", header);
  CHECK(data_digest(folder / "a.h5") != data_digest(folder / "c.h5"));
}

TEST_CASE("what is no readable result is refused with a line that says so") {
  const tests::ScratchFolder folder;
  const fs::path path = folder / "r.h5";
  std::string reason;
  SECTION("missing") {
    reason = "does not exist";
  }
  SECTION("folder") {
    fs::create_directory(path);
    reason = "is a folder";
  }
  SECTION("text") {
    std::ofstream(path) << "trial,error\n1,0.5\n";
    reason = "is not an HDF5 file";
  }
  SECTION("empty") {
    std::ofstream(path) << "";
    reason = "is not an HDF5 file";
  }
  SECTION("other HDF5") {
    hdf5::File::create(path).close();
    reason = "no ridgeloc result";
  }
  SECTION("newer") {
    hdf5::File file = hdf5::File::create(path);
    file.write_attribute("/", "filetype", std::string("ridgeloc-result"));
    file.write_attribute("/", "version", std::vector<std::uint64_t>{3, 0});
    file.close();
    reason = "format version 3.0";
  }
  SECTION("truncated") {
    tests::write_sample(path, tests::sample_header());
    fs::resize_file(path, fs::file_size(path) - 1);
    reason = "truncated or damaged";
  }
  SECTION("no file, but something to wait for") {
    REQUIRE(::mkfifo(path.c_str(), 0600) == 0);
    reason = "no regular file";
  }
  SECTION("incomplete") {
    hdf5::File file = hdf5::File::create(path);
    file.write_attribute("/", "filetype", std::string("ridgeloc-result"));
    file.write_attribute("/", "version", std::vector<std::uint64_t>{1, 0});
    file.close();
    reason = "truncated or damaged";
  }
  CHECK_THROWS_AS(read_result(path), core::InputError);
  CHECK(tests::lacking(tests::message_of([&] { read_result(path); }), {path.string(), reason}) == "");
}

TEST_CASE("a changed bit of a text is found, whoever reads: HDF5 has no checksum over texts") {
  const tests::ScratchFolder folder;
  const fs::path path = folder / "r.h5";
  Header header = tests::sample_header();
  header.title = "a title that stands nowhere else";
  header.study_toml += "# a comment that stands nowhere else\n";
  tests::write_sample(path, header);
  const std::string text = GENERATE("title that stands", "comment that stands", "it was not");
  damage_text(path, text);
  const auto is_found = [&](auto&& read) {
    return tests::lacking(tests::message_of(read), {path.string(), "not those that were written"});
  };
  CHECK(is_found([&] { read_result(path); }) == "");
  CHECK(is_found([&] { read_result_header(path); }) == "");
  CHECK(is_found([&] { read_result_ledger(path); }) == "");
  CHECK(is_found([&] { read_result_failures(path); }) == "");
  CHECK(is_found([&] { read_completely(path); }) == "");
  CHECK(is_found([&] { data_digest(path); }) == "");
}
