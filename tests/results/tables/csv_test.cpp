#include "results/tables/csv.hpp"

#include <algorithm>
#include <limits>
#include <sstream>
#include <vector>

#include "core/error.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/synthetic_summary.hpp"

namespace {

using namespace ridgeloc;
using namespace ridgeloc::results;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::size_t begin = 0;
  for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', begin)) {
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  REQUIRE(begin == text.size());
  return lines;
}

std::string summary_csv(const Summary& summary) {
  std::ostringstream out;
  write_summary_csv(summary, out);
  return out.str();
}

TEST_CASE("summary in long form: header and rows") {
  const std::vector<std::string> lines = lines_of(summary_csv(synthetic_summary()));
  REQUIRE(lines.size() == 1 + 4 * 2 * 5);
  CHECK(lines[0] ==
        "points,range_sigma_m,method,metric,unit,n,mean,mcse,sd,min,p05,p25,p50,p75,p95,max,lo,hi,trusted,"
        "beyond,"
        "p50_lo,p50_hi,sd_mcse,rms,rms_mcse,rms_lo,rms_hi,p95_lo,p95_hi,rms_trusted");
  CHECK(lines[1] ==
        "3,0.1,rr,error_m,m,4,2.5,0.6454972243679028,1.2909944487358056,1,1.00625,1.03125,2.0625,3.0625,4,4,"
        "0.44821155236395915,4.55178844763604,0,0,nan,nan,0.2581988897471611,"
        "2.7386127875258306,0.5986094998689323,1.3670639332831551,5.486210130632238,nan,nan,0");
  CHECK(lines[2] ==
        "3,0.1,rr,error_all_m,m,5,2.5,0.6454972243679028,1.2909944487358056,1,1.0078125,2.015625,3.03125,4."
        "09375,"
        "inf,inf,0.44821155236395915,4.55178844763604,0,1,nan,nan,0.2581988897471611,"
        "2.7386127875258306,0.5986094998689323,1.3670639332831551,5.486210130632238,nan,nan,0");
  CHECK(lines[3] ==
        "3,0.1,rr,converged,1,5,0.8,0.17888543819998315,nan,nan,nan,nan,nan,nan,nan,nan,0.3755346297625253,"
        "0.9637758913675698,0,0,nan,nan,nan,nan,nan,nan,nan,nan,nan,0");
  CHECK(lines.back().substr(0, 25) == "5,0.5,rrr,stationary,1,5,");
}

TEST_CASE("every row has as many fields as the header") {
  const std::vector<std::string> lines = lines_of(summary_csv(synthetic_summary()));
  for (const std::string& line : lines) CHECK(std::count(line.begin(), line.end(), ',') == 29);
}

TEST_CASE("fields with separators, quotes and line breaks are quoted") {
  Summary summary = synthetic_summary();
  summary.header.methods[0].label = "a,b";
  summary.header.methods[1].label = "say \"x\"\r\n";
  const std::string text = summary_csv(summary);
  CHECK(text.find("3,0.1,\"a,b\",error_m,") != std::string::npos);
  CHECK(text.find("3,0.1,\"say \"\"x\"\"\r\n\",error_m,") != std::string::npos);
}

TEST_CASE("texts that a spreadsheet would compute begin with an apostrophe, numbers stay numbers") {
  Summary summary = synthetic_summary();
  summary.header.methods[0].label = "=1+2";
  summary.header.methods[1].label = "@x,y";
  summary.header.axes[0].values[0] = std::int64_t{-3};
  summary.header.axes[1].values = {-0.5, std::string("+a")};
  const std::string text = summary_csv(summary);
  CHECK(text.find("\n-3,-0.5,'=1+2,error_m,") != std::string::npos);
  CHECK(text.find("\n-3,'+a,\"'@x,y\",error_m,") != std::string::npos);
  for (const std::string& line : lines_of(text)) CHECK(std::string("=+@").find(line.front()) == std::string::npos);
}

TEST_CASE("with decimal commas the cells are separated by semicolons") {
  Summary summary = synthetic_summary();
  summary.header.methods[0].label = "a,b";
  summary.header.methods[1].label = "c;d";
  std::ostringstream out;
  write_summary_csv(summary, out, DecimalMark::Comma);
  const std::vector<std::string> lines = lines_of(out.str());
  CHECK(lines[0].starts_with("points;range_sigma_m;method;"));
  CHECK(lines[1].starts_with("3;0,1;a,b;error_m;m;4;2,5;0,6454972243679028;"));
  CHECK(lines[6].starts_with("3;0,1;\"c;d\";error_m;m;4;1,25;"));
}

TEST_CASE("trials in wide form") {
  const Header header = synthetic_summary().header;
  const std::vector<std::uint8_t> status = {0, 1};
  const std::vector<double> error = {0.1, std::numeric_limits<double>::quiet_NaN()};
  const std::vector<double> error_all = {0.1, std::numeric_limits<double>::infinity()};
  std::ostringstream out;
  write_trials_csv_heading(header, out);
  write_trials_csv(header, 1, 0, {{4096, 4097}, status, {error, error_all}}, out);
  write_trials_csv(header, 3, 1, {{0, 1}, {}, {error, {}}}, out);
  write_trials_csv(header, 2, 1, {}, out);
  CHECK(out.str() ==
        "points,range_sigma_m,trial,method,status,error_m,error_all_m\n"
        "3,0.5,4096,rr,converged,0.1,0.1\n"
        "3,0.5,4097,rr,max_iterations,nan,inf\n"
        "5,0.5,0,rrr,,0.1,nan\n"
        "5,0.5,1,rrr,,nan,nan\n");
}

TEST_CASE("a stream that fails is an I/O error") {
  std::ostringstream out;
  out.setstate(std::ios::badbit);
  CHECK_THROWS_AS(write_summary_csv(synthetic_summary(), out), core::IoError);
}

}  // namespace
