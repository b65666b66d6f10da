#include "tests/cli/small_result.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/sample_result.hpp"

using namespace ridgeloc::tests;

TEST_CASE("plot draws the bound of errors unless it is not wanted") {
  const WithResult folder;
  REQUIRE(folder.ridgeloc("plot result.h5 --y error_all_m --statistic rms --where range_sigma_m=0.1 -o with.svg")
              .exit_code == 0);
  CHECK(contains(folder.read("with.svg"), "bound of unbiased estimates, root mean square"));
  CHECK(contains(folder.read("with.svg"), "range_sigma_m = 0.1"));
  REQUIRE(folder.ridgeloc("plot result.h5 --y error_all_m --no-bounds -o without.svg").exit_code == 0);
  CHECK_FALSE(contains(folder.read("without.svg"), "bound"));
  REQUIRE(folder.ridgeloc("plot result.h5 --figure study --no-bounds -o study.svg").exit_code == 0);
  CHECK_FALSE(contains(folder.read("study.svg"), "bound"));
  REQUIRE(folder.ridgeloc("plot result.h5 --y error_all_m --methods 'lm / rrr' -o ratio.svg").exit_code == 0);
  CHECK(contains(folder.read("ratio.svg"), "ratio of the"));
}

TEST_CASE("plot has the limits, the size and the columns that are asked for") {
  const WithResult folder;
  REQUIRE(folder
              .ridgeloc("plot result.h5 --y error_all_m --statistic p95 --xlim 2:6 --ylim 0.01:10 --log --log-x "
                        "--size 160x100 --columns 2 --facet method --title 'A <title>' -o one.svg")
              .exit_code == 0);
  const std::string svg = folder.read("one.svg");
  CHECK(contains(svg, "width=\"605\" height=\"378\""));
  CHECK(contains(svg, "95 % quantile [m]"));
  CHECK(contains(svg, "<title>A &lt;title&gt;</title>"));
  const std::string digest = folder.ridgeloc("verify result.h5 --digest").out;
  CHECK(contains(svg, "Data: SHA-256 " + digest.substr(0, 64)));
  CHECK(folder.ridgeloc("plot result.h5 --figure rate --columns 2 -o two.pdf --format pdf").exit_code == 0);
  CHECK(folder.read("two.pdf").starts_with("%PDF"));
  const struct {
    const char* options;
    const char* message;
  } wrong[] = {{"--xlim 6:2", "--xlim 6:2: write two numbers, the lower first"},
               {"--ylim 1", "--ylim 1: write two numbers"},
               {"--ylim 0:1 --log --y error_m", "--ylim 0:1: the axis is logarithmic"},
               {"--size 100", "--size 100: write width and height in mm"},
               {"--size 1e9x10", "at most 2000 each"},
               {"--size 30x20", "--size 30x20: this figure needs at least"},
               {"--columns 0", "--columns"},
               {"--figure rate -o two.pdf --format svg", "another --format"}};
  for (const auto& [options, message] : wrong) {
    INFO(options);
    const auto outcome = folder.ridgeloc(std::string("plot result.h5 ") + options);
    CHECK(outcome.exit_code == 2);
    INFO(outcome.error);
    CHECK(lines_of(outcome.error).size() == 1);
    CHECK(contains(outcome.error, message));
  }
}

TEST_CASE("a rate that was never seen is drawn as its upper bound on a logarithmic axis") {
  const WithResult folder;
  REQUIRE(folder.ridgeloc("plot result.h5 --y singular --log -o rate.svg").exit_code == 0);
  const std::string svg = folder.read("rate.svg");
  CHECK(contains(svg, "open triangles: not seen"));
  CHECK_FALSE(contains(svg, "not shown"));
}

TEST_CASE("plot draws all figures, or one, in the formats asked for") {
  const WithResult folder;
  const auto all = folder.ridgeloc("plot result.h5 --format svg --format pdf");
  CHECK(all.exit_code == 0);
  CHECK(lines_of(all.out) == std::vector<std::string>{"study.svg", "study.pdf", "rate.svg", "rate.pdf"});
  CHECK(contains(folder.read("study.svg"), "<svg"));
  CHECK(folder.read("rate.pdf").starts_with("%PDF"));
  CHECK(folder.ridgeloc("plot result.h5 --figure rate -o picture.png").exit_code == 0);
  CHECK(folder.read("picture.png").starts_with("\x89PNG"));

  CHECK(folder.ridgeloc("plot result.h5 -o both.svg").exit_code == 2);
  CHECK(folder.ridgeloc("plot result.h5 --figure rat").exit_code == 2);
  CHECK(folder.ridgeloc("plot result.h5 --figure rate -o picture.jpg").exit_code == 2);
  CHECK(folder.ridgeloc("plot result.h5 -o nowhere/at/all").exit_code == 2);
  for (const char* verb : {"plot", "report"})
    CHECK(contains(folder.shell(std::string("TMPDIR=nowhere '" RIDGELOC_PROGRAM "' ") + verb + " result.h5").error,
                   "set TMPDIR to"));
  CHECK_FALSE(folder.has("nowhere"));
  CHECK(folder.ridgeloc("plot result.h5 -o pictures --figure rate").out == "pictures/rate.svg\n");
}

TEST_CASE("plot draws a figure that is asked for instead of the study's") {
  const WithResult folder;
  // Lines are told apart by what the figure does not name: here by noise and method.
  REQUIRE(folder.ridgeloc("plot result.h5 --y error_all_m").out == "error_all_m.svg\n");
  const std::string all = folder.read("error_all_m.svg");
  CHECK(contains(all, "number of points"));
  CHECK(contains(all, "range_sigma_m = 0.3, rrr"));
  REQUIRE(folder
              .ridgeloc("plot result.h5 --y error_all_m --where range_sigma_m=0.30 --methods rrr --methods lm --log "
                        "--title 'Noisy' -o one.svg")
              .exit_code == 0);
  const std::string one = folder.read("one.svg");
  CHECK(contains(one, "Noisy"));
  // It stands under the title, and not with the lines.
  CHECK(contains(one, "range_sigma_m = 0.3"));
  CHECK_FALSE(contains(one, "range_sigma_m = 0.3, rrr"));
  REQUIRE(folder
              .ridgeloc("plot result.h5 --y error_m --y error_all_m --x range_sigma_m --group points --facet method "
                        "--statistic rms --format png")
              .out == "error_m-error_all_m.png\n");
}

TEST_CASE("names in a result from elsewhere write nowhere but into the output folder, and mislead no verb") {
  const WorkingFolder folder;
  ridgeloc::results::Header header = sample_header();
  header.figures.resize(1);
  int number = 0;
  for (const std::string name : {"../escaped", "/tmp/ridgeloc-escaped", ".hidden", "a\nb"}) {
    INFO(name);
    header.figures[0].name = name;
    const std::string file = "inner" + std::to_string(++number) + ".h5";
    write_sample(folder.path() / file, header);
    const auto outcome = folder.ridgeloc("plot " + file + " -o pictures");
    CHECK(outcome.exit_code == 2);
    CHECK(lines_of(outcome.error).size() == 1);
    CHECK(contains(outcome.error, "which can be no file of the output folder"));
    CHECK_FALSE(folder.has("escaped.svg"));
    CHECK_FALSE(folder.has("pictures"));
    CHECK(folder.ridgeloc("plot " + file + " -o one.svg").exit_code == 0);
  }
  header.figures[0].name = "figure";
  header.figures[0].y = {"unheard_of"};
  write_sample(folder.path() / "unknown.h5", header);
  for (const char* verb : {"summary unknown.h5", "export unknown.h5 --latex", "report unknown.h5"}) {
    INFO(verb);
    CHECK(folder.ridgeloc(verb).exit_code == 0);
  }
  const auto plot = folder.ridgeloc("plot unknown.h5");
  CHECK(plot.exit_code == 2);
  CHECK(contains(plot.error, "y = \"unheard_of\" is unknown"));
}

TEST_CASE("plot draws distributions") {
  const WithResult folder;
  REQUIRE(folder.ridgeloc("plot result.h5 --y error_all_m --kind ecdf --where range_sigma_m=0.1 --facet method").out ==
          "error_all_m-ecdf.svg\n");
  CHECK(contains(folder.read("error_all_m-ecdf.svg"), "40 values per line; bands: 95 % intervals at each place"));
  REQUIRE(folder.ridgeloc("plot result.h5 --y iterations --kind histogram -o h.svg").exit_code == 0);
  CHECK(contains(folder.read("h.svg"), "share of the values per whole number"));
}

TEST_CASE("plot refuses what it cannot draw in one line, with the nearest name") {
  const WithResult folder;
  const struct {
    const char* options;
    const char* message;
  } wrong[] = {
      {"--y error_al_m", "nearest valid names: error_all_m"},
      {"--y error_m --x point", "x = \"point\" is unknown; valid names: points"},
      {"--y error_m --group metod", "valid names: method"},
      {"--y error_m --methods rr", "valid names: rrr"},
      {"--y error_m --where point=3", "where = \"point\" is unknown; valid names: points"},
      {"--y error_m --where points=4", "where points = \"4\" is unknown; valid names: 3, 5"},
      {"--y error_m --where points", "AXIS=VALUE"},
      {"--y error_m --where points=3,", "AXIS=VALUE"},
      {"--y error_m --statistic modus", "modus"},
      {"--y error_m --figure rate", "excludes"},
      {"--y error_m --kind ecdf --x points", "takes no x"},
      {"--y converged --kind histogram", "is yes or no"},
      {"--y error_x_m --kind ecdf", "negative values"},
      {"--y error_m --kind edcf", "edcf"},
      {"--x points", "requires --y"},
      {"--where points=3", "requires --y"},
      {"--log --figure rate", "requires --y"},
  };
  for (const auto& [options, message] : wrong) {
    INFO(options);
    const auto outcome = folder.ridgeloc(std::string("plot result.h5 ") + options);
    CHECK(outcome.exit_code == 2);
    CHECK(lines_of(outcome.error).size() == 1);
    INFO(outcome.error);
    CHECK(contains(outcome.error, message));
  }
}
