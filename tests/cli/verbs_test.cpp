#include <algorithm>
#include <sstream>

#include "tests/cli/program.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/sample_result.hpp"

using namespace ridgeloc::tests;

namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// A folder with the result of a small study with two figures.
struct WithResult : WorkingFolder {
  WithResult() {
    write("study.toml", R"(title = "A small study"
experiment = "ranging"
trials = 40
[sweep]
points = [3, 5]
range_sigma_m = [0.1, 0.3]
[[method]]
solver = "rrr"
[[method]]
solver = "lm"
[[figure]]
x = "points"
y = "error_all_m"
group = ["method", "range_sigma_m"]
[[figure]]
name = "rate"
x = "points"
y = "converged"
group = "range_sigma_m"
facet = "method"
methods = ["rrr", "lm"]
)");
    REQUIRE(ridgeloc("run study.toml -o result.h5").exit_code == 0);
  }
};

}  // namespace

TEST_CASE("list names what there is") {
  const WorkingFolder folder;
  const std::string all = folder.ridgeloc("list").out;
  for (const char* name : {"ols", "rrr", "kibria_gm", "oracle_elem", "normal", "student_t", "empirical", "eta_first",
                           "converged", "ranging", "fig3a", "fig3bcd"}) {
    CHECK(contains(all, name));
  }
  CHECK(lines_of(folder.ridgeloc("list solvers").out).size() == 9);
  CHECK(contains(folder.ridgeloc("list weights").out, "igg3"));
  CHECK(contains(folder.ridgeloc("list maps").out, "paper  two corridors and a room, 58 objects"));
  CHECK(contains(folder.ridgeloc("list metrics").out, "building: 2-D position error of located photos (m)"));
  CHECK(contains(folder.ridgeloc("list studies").out, "fig3a           Fig. 3a: similarity of estimated and true K"));
}

TEST_CASE("plan says what a study amounts to, and writes nothing") {
  const WorkingFolder folder;
  const auto outcome = folder.ridgeloc("plan fig3a --trials 1e6 --threads 2");
  REQUIRE(outcome.exit_code == 0);
  CHECK(contains(outcome.out, "cells    15\n"));
  CHECK(contains(outcome.out, "trials   15000000 (1000000 per cell)"));
  CHECK(contains(outcome.out, "blocks   3675 of 4096 trials"));
  CHECK(contains(outcome.out, "on 2 threads"));
  CHECK(folder.entries().empty());
}

TEST_CASE("summary shows every cell, method and failure with its error") {
  const WithResult folder;
  const auto outcome = folder.ridgeloc("summary --all result.h5");
  REQUIRE(outcome.exit_code == 0);
  CHECK(contains(outcome.out, "A small study"));
  CHECK(contains(outcome.out, "points = 5, range_sigma_m = 0.3: lm"));
  CHECK(contains(outcome.out, "singular"));
  CHECK(contains(outcome.out, "crb_m"));
}

TEST_CASE("summary begins with what matters, and shows what is asked for") {
  const WithResult folder;
  const auto whole = folder.ridgeloc("summary result.h5");
  REQUIRE(whole.exit_code == 0);
  for (const char* piece :
       {"A small study\n", "complete: 4 cells", "Differences on the same trials, first minus second: mean ± error",
        "Failures, 4 cells together:"}) {
    INFO(piece << " in " << whole.out);
    CHECK(contains(whole.out, piece));
  }
  const auto part =
      folder.ridgeloc("summary result.h5 --cell points=5 --method lm --metric iterations --metric converged");
  REQUIRE(part.exit_code == 0);
  CHECK(contains(part.out, "in every row: points = 5\n"));
  CHECK(contains(part.out, "iterations"));
  CHECK(contains(part.out, "converged"));
  CHECK_FALSE(contains(part.out, "rrr"));
  for (const auto& [arguments, said] : {std::pair{"--metric eror_m", "did you mean \"error_m\"?"},
                                        std::pair{"--method ml", "--method \"ml\" is unknown"},
                                        std::pair{"--cell points=9", "points = 9 is not in the sweep"},
                                        std::pair{"--all --metric error_m", "--metric"}}) {
    const auto refused = folder.ridgeloc(std::string("summary result.h5 ") + arguments);
    CHECK(refused.exit_code == 2);
    CHECK(line_count(refused.error) == 1);
    INFO(refused.error);
    CHECK(contains(refused.error, said));
  }
}

TEST_CASE("the audit shows in the summary, and can be switched off") {
  const WithResult folder;
  // 4 cells of 40 trials, all of them audited; rrr and lm.
  const std::string table = folder.ridgeloc("summary --all result.h5").out;
  CHECK(contains(table, "ref_gap_m [m]"));
  CHECK(contains(table, "ref_converged"));
  std::size_t quiet = 0;
  for (const std::string& line : lines_of(table))
    quiet += contains(line, "ref_disagrees") && contains(line, "0 [<= 0.0");
  CHECK(quiet == 8);
  REQUIRE(folder.ridgeloc("run study.toml --audit 0 -o quiet.h5").exit_code == 0);
  CHECK_FALSE(contains(folder.ridgeloc("summary --all quiet.h5").out, "ref_"));
  CHECK(contains(folder.ridgeloc("summary result.h5").out, "audited by Ceres: "));
  CHECK(contains(folder.ridgeloc("summary quiet.h5").out, "not audited: no trial was checked independently\n"));
  CHECK(folder.ridgeloc("run study.toml -o result.h5 --audit 0.5").exit_code == 2);  // another study
  const auto refused = folder.ridgeloc("run study.toml --audit 2 -o x.h5");
  CHECK(refused.exit_code == 2);
  CHECK(contains(refused.error, "audit = 2 is not allowed"));
}

TEST_CASE("audit solves failed trials again and changes nothing") {
  const WithResult folder;
  const std::string before = folder.read("result.h5");
  const auto outcome = folder.ridgeloc("audit result.h5");
  REQUIRE(outcome.exit_code == 0);
  CHECK(contains(outcome.out, "points = 5, range_sigma_m = 0.3\n"));
  CHECK(contains(outcome.out, "from truth"));
  CHECK(folder.ridgeloc("audit result.h5 --threads 3").out == outcome.out);
  CHECK(folder.read("result.h5") == before);
  CHECK(folder.ridgeloc("audit result.h5 --trials 0").exit_code == 2);
  CHECK(folder.ridgeloc("audit nothing.h5").exit_code == 2);
}

TEST_CASE("export writes the long form, a row per cell, method and metric") {
  const WithResult folder;
  const auto lines = lines_of(folder.ridgeloc("export result.h5 --csv").out);
  // 4 cells; rrr: 9 metrics, 6 of the audit and 6 events, lm: 7 (no K, but nees), 6 and 6, scene: 3, lm - rrr: 4, lm /
  // rrr: 4.
  REQUIRE(lines.size() == 1 + 4 * (21 + 19 + 3 + 4 + 4));
  CHECK(lines[0].starts_with(
      "points,range_sigma_m,method,metric,unit,n,mean,mcse,sd,min,p05,p25,p50,p75,p95,max,lo,hi,trusted"));
  CHECK(lines[1].starts_with("3,0.1,rrr,error_m,m,"));
  REQUIRE(folder.ridgeloc("export result.h5 -o table.csv").exit_code == 0);
  CHECK(lines_of(folder.read("table.csv")) == lines);
}

TEST_CASE("export writes a row per trial with every metric") {
  const WithResult folder;
  const auto lines = lines_of(folder.ridgeloc("export result.h5 --trials").out);
  REQUIRE(lines.size() == 1 + 4 * 3 * 40);
  CHECK(lines[0] ==
        "points,range_sigma_m,trial,method,status,error_m,error_all_m,iterations,eta_first,eta_last,eta_mean,"
        "residual_rms_m,crb_m,gdop,condition,squared_error_m2,error_x_m,ref_gap_m,ref_objective_gap,ref_converged,"
        "ref_same_basin,ref_truth_basin,ref_disagrees,nees");
  CHECK(lines[1].starts_with("3,0.1,0,rrr,"));
  CHECK(lines[40].starts_with("3,0.1,39,rrr,"));
  CHECK(lines[41].starts_with("3,0.1,0,lm,"));
}

TEST_CASE("export compares cells with those at one value of an axis") {
  const WithResult folder;
  const auto lines = lines_of(folder.ridgeloc("export result.h5 --against range_sigma_m=0.1").out);
  CHECK(lines[0].starts_with("points,range_sigma_m,against,method,metric,unit,n,n_against,difference,"));
  CHECK(lines[1].starts_with("3,0.3,\"points = 3, range_sigma_m = 0.1\",rrr,error_m,m,"));
  const auto paired = std::ranges::find_if(lines, [](const std::string& line) {
    return contains(line, ",rrr,error_all_m,m,40,40,") && line.starts_with("5,0.3,");
  });
  REQUIRE(paired != lines.end());
  CHECK((paired->ends_with(",40,0") || paired->ends_with(",40,1")));
  const auto unknown = folder.ridgeloc("export result.h5 --against points=4");
  CHECK(unknown.exit_code == 2);
  CHECK(contains(unknown.error, "points=4: not one value of points (allowed: 3, 5)"));
  CHECK(folder.ridgeloc("export result.h5 --against points=3 --trials").exit_code == 2);
}

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

TEST_CASE("export writes LaTeX tables of cells by methods") {
  const WithResult folder;
  const std::string both = folder.ridgeloc("export result.h5 --latex").out;
  CHECK(both.starts_with("% ridgeloc export result.h5 --latex\n% \\usepackage{booktabs}\n"));
  CHECK(contains(both, "A small study: "));
  CHECK(contains(both, "40 trials per cell, seed 2018, data "));
  CHECK(contains(both, "\\label{tab:error_all_m}"));
  CHECK(contains(both, "\\label{tab:converged}"));
  const std::string one = folder.ridgeloc("export result.h5 --latex --metric gdop").out;
  CHECK(one.starts_with("% ridgeloc export result.h5 --latex --metric gdop\n"));
  CHECK(contains(one, "standard deviation of the range errors in m} & method & 3 & 5 \\\\\n"));
  REQUIRE(folder.ridgeloc("export result.h5 --latex -o t.tex").exit_code == 0);
  CHECK(folder.read("t.tex") == both);

  const auto unknown = folder.ridgeloc("export result.h5 --latex --metric convergd");
  CHECK(unknown.exit_code == 2);
  CHECK(contains(unknown.error, "did you mean \"converged\"?"));
  CHECK(folder.ridgeloc("export result.h5 --latex --trials").exit_code == 2);
  CHECK(contains(folder.ridgeloc("export result.h5 --metric gdop").error, "requires --latex"));
}

TEST_CASE("export writes CSV that spreadsheets read, and says where no trial is kept") {
  const WithResult folder;
  const std::string text = folder.ridgeloc("export result.h5 --bom --decimal-comma").out;
  CHECK(text.starts_with("\xEF\xBB\xBFpoints;range_sigma_m;method;"));
  CHECK(contains(text, "\n3;0,1;rrr;error_m;m;"));
  CHECK(lines_of(folder.ridgeloc("export result.h5 --trials --bom").out).size() > 100);
  CHECK(folder.ridgeloc("export result.h5 --json --bom").exit_code == 2);
  REQUIRE(folder.ridgeloc("run study.toml --set store.trial_columns_mib=0 -o bare.h5").exit_code == 0);
  const auto none = folder.ridgeloc("export bare.h5 --trials");
  CHECK(none.exit_code == 2);
  CHECK(
      contains(none.error, "bare.h5: keeps no values of single trials; run the study with [store] trial_columns_mib"));
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

TEST_CASE("report writes one page, of one result or of several, and never over a result") {
  const WithResult folder;
  const auto one = folder.ridgeloc("report result.h5");
  CHECK(one.exit_code == 0);
  CHECK(one.out == "result.html\n");
  const std::string page = folder.read("result.html");
  CHECK(page.starts_with("<!DOCTYPE html>"));
  CHECK(contains(page, "<title>A small study</title>"));
  CHECK(page.find(": best in ") < page.find(">Overview</h2>"));
  CHECK(contains(page, "ridgeloc plot result.h5 --figure rate"));
  CHECK(folder.ridgeloc("report result.h5 result.h5").out == "report.html\n");
  CHECK(contains(folder.read("report.html"), "<title>2 studies</title>"));
  REQUIRE(folder.ridgeloc("run study.toml --set 'figure=[]' --trials 60 -o other.h5").exit_code == 0);
  CHECK(folder.ridgeloc("report other.h5 -o pages.html").exit_code == 0);
  CHECK(contains(folder.read("pages.html"), "The study asks for none"));

  const std::string result = folder.read("result.h5");
  CHECK(folder.ridgeloc("report other.h5 -o result.h5").exit_code == 2);
  CHECK(folder.read("result.h5") == result);
  CHECK(folder.ridgeloc("report other.h5 -o nowhere/at/all.html").exit_code == 2);
  CHECK(folder.shell("head -c 20000 result.h5 > cut.h5").exit_code == 0);
  const auto damaged = folder.ridgeloc("report result.h5 cut.h5 -o both.html");
  CHECK(damaged.exit_code == 2);
  CHECK(lines_of(damaged.error).size() == 1);
  CHECK_FALSE(folder.has("both.html"));
}

TEST_CASE("the commands of a report do what they say") {
  const WithResult folder;
  REQUIRE(folder.shell("mv result.h5 \"it's a result.h5\"").exit_code == 0);
  REQUIRE(folder.ridgeloc("report \"it's a result.h5\" -o page.html").exit_code == 0);
  const std::string page = folder.read("page.html");
  const std::string command = "ridgeloc verify 'it'\\''s a result.h5'";
  CHECK(contains(page, command));
  CHECK(folder.ridgeloc(command.substr(std::string("ridgeloc ").size())).exit_code == 0);
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

TEST_CASE("help and version are on standard output") {
  const WorkingFolder folder;
  CHECK(contains(folder.ridgeloc("--help").out, "Exit codes"));
  CHECK(contains(folder.ridgeloc("run --help").out, "--threads"));
  CHECK(folder.ridgeloc("--version").out.starts_with("ridgeloc 0."));
}

TEST_CASE("a full disk under standard output is an I/O failure for every verb") {
  const WithResult folder;
  for (const char* verb : {"export result.h5", "replay result.h5 --cell 0 --trial 1", "export result.h5 --trials",
                           "summary result.h5", "audit result.h5", "list", "plan fig3a", "plot result.h5",
                           "report result.h5", "run study.toml -o again.h5", "new ranging"}) {
    INFO(verb);
    const auto outcome = folder.shell(std::string("'" RIDGELOC_PROGRAM "' ") + verb + " 2>messages > /dev/full");
    CHECK(outcome.exit_code == 3);
    CHECK(contains(folder.read("messages"), "ridgeloc: "));
    CHECK(lines_of(folder.read("messages")).size() <= 2);  // what was run, and what went wrong
  }
}

TEST_CASE("output goes through links, to devices, and never over a neighbour's file") {
  const WithResult folder;
  folder.write("table.csv.tmp", "precious");
  REQUIRE(folder.shell("touch real.csv && ln -s real.csv link.csv").exit_code == 0);
  CHECK(folder.ridgeloc("export result.h5 -o table.csv").exit_code == 0);
  CHECK(folder.read("table.csv.tmp") == "precious");
  CHECK(folder.ridgeloc("export result.h5 -o link.csv").exit_code == 0);
  CHECK(folder.read("real.csv") == folder.read("table.csv"));
  CHECK(folder.shell("test -L link.csv").exit_code == 0);
  REQUIRE(folder.shell("mkdir far && ln -s far/new.csv later.csv").exit_code == 0);
  CHECK(folder.ridgeloc("export result.h5 -o later.csv").exit_code == 0);
  CHECK(folder.read("far/new.csv") == folder.read("table.csv"));
  const std::string result = folder.read("result.h5");
  CHECK(folder.ridgeloc("export result.h5 -o result.h5").exit_code == 2);
  CHECK(folder.shell("cp result.h5 other.svg").exit_code == 0);
  CHECK(folder.ridgeloc("plot result.h5 --figure rate -o other.svg").exit_code == 2);
  CHECK(folder.read("result.h5") == result);
  CHECK(folder.read("other.svg") == result);
  CHECK(folder.ridgeloc("export result.h5 -o /dev/null").exit_code == 0);
  CHECK(folder.shell("test -c /dev/null").exit_code == 0);
  CHECK(folder.ridgeloc("export result.h5 -o $(printf 'x%.0s' $(seq 300)).csv").exit_code == 2);
}
