#include <algorithm>

#include "tests/cli/small_result.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc::tests;

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
