#include "tests/cli/small_result.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc::tests;

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
