#include "results/report/report.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <functional>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "results/report/html.hpp"
#include "results/report/report_assets.hpp"
#include "results/store/result_file.hpp"
#include "results/util/digest.hpp"
#include "results/util/shell.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/sample_result.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/synthetic_summary.hpp"

using namespace ridgeloc;
using namespace ridgeloc::results;
using tests::contains;

namespace {

std::size_t count(const std::string& text, const std::string& piece) {
  std::size_t found = 0;
  for (auto at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1)) ++found;
  return found;
}

/// The first tag that is not closed by its own end, of those that HTML wants closed; empty if there is none.
std::string unbalanced_tag(std::string html) {
  html = std::regex_replace(html, std::regex("<(style|script)>[^]*?</\\1>"), "");
  std::vector<std::string> open;
  static const std::regex tag("<(/?)([a-zA-Z][a-zA-Z0-9]*)([^<>]*?)(/?)>");
  for (std::sregex_iterator at(html.begin(), html.end(), tag), end; at != end; ++at) {
    const std::string name = (*at)[2];
    if (name == "meta" || name == "br" || (*at)[4] == "/") continue;
    if ((*at)[1] != "/") {
      open.push_back(name);
    } else {
      if (open.empty() || open.back() != name) return name;
      open.pop_back();
    }
  }
  return open.empty() ? "" : open.back();
}

std::vector<std::string> ids(const std::string& html) {
  std::vector<std::string> found;
  static const std::regex id("\\sid=[\"']([^\"']*)");
  for (std::sregex_iterator at(html.begin(), html.end(), id), end; at != end; ++at) found.push_back((*at)[1]);
  std::ranges::sort(found);
  return found;
}

/// A result in memory, with a figure.
ReportSource synthetic_source() {
  ReportSource source;
  source.path = "small.h5";
  source.summary = synthetic_summary();
  source.summary.header.schema.events[1].is_failure = true;
  FigureSpec figure;
  figure.name = "errors";
  figure.title = "Errors";
  figure.x = "points";
  figure.y = {"error_m"};
  figure.group = {"range_sigma_m"};
  figure.facet = "method";
  source.summary.header.figures = {figure};
  source.rows = summary_rows(source.summary);
  return source;
}

const std::string hostile = "</code><script>alert(1)</script>\"'&amp;\x01";

}  // namespace

TEST_CASE("HTML: text stays text") {
  CHECK(html_text("a < b && \"c\" > 'd'\x02\n") == "a &lt; b &amp;&amp; &quot;c&quot; &gt; 'd' \n");
  CHECK(html_code("<b>") == "<code>&lt;b&gt;</code>");
}

TEST_CASE("HTML: a table that is too long is cut off and says so") {
  HtmlTable table("Numbers", {{"i", HtmlTable::Kind::Number}});
  for (std::size_t i = 0; i < HtmlTable::most_rows; ++i) table.add({count_cell(i)});
  CHECK(count(table.html(), "<tr>") == HtmlTable::most_rows + 1);
  CHECK_FALSE(contains(table.html(), "Only the first"));
  table.add({count_cell(0)});
  CHECK(count(table.html(), "<tr>") == HtmlTable::most_rows + 1);
  CHECK(contains(table.html(), "Only the first 5000 of 5001 rows"));
}

TEST_CASE("a word of a shell is quoted where it must be") {
  CHECK(shell_word("out/r.h5") == "out/r.h5");
  CHECK(shell_word("points=5,range_sigma_m=0.3") == "points=5,range_sigma_m=0.3");
  CHECK(shell_word("rrr, K' by component") == "'rrr, K'\\'' by component'");
  CHECK(shell_word("$(rm x)") == "'$(rm x)'");
  CHECK(shell_word("") == "''");
}

TEST_CASE("a report says what was studied, where the numbers come from and how to make them again") {
  const tests::ScratchFolder folder;
  Header header = tests::sample_header();
  header.figures.clear();
  const std::string path = (folder / "a result.h5").string();
  tests::write_sample(path, header);
  const std::string html = report_html({read_report_source(path)});

  for (const char* text : {"<title>Sample: µ and σ</title>", "Is µ &lt; σ?", "18446744073709551615", "Philox4x32-10",
                           "5 of the 6 combinations", "0.1, 0.3333333333333333", "robust ridge, &quot;k&quot; = 0.5",
                           "Cramér-Rao bound", "86 trials per cell", "complete: 5 cells with 86 trials each",
                           "seed = 7", "Eigen 3.4.0", "run: 1.5 s", "rate of failures"}) {
    INFO(text);
    CHECK(contains(html, text));
  }
  const ReportSource source = read_report_source(path);
  CHECK(contains(html, source.digest));
  CHECK(contains(html, source.provenance.processor));
  CHECK(contains(html, "ridgeloc verify '" + path + "'"));
  CHECK(contains(html, "--cell points=3,sigma_m=0.1 --trial "));
  CHECK(contains(html, " --method 'rrr k=0.5'"));
  CHECK_FALSE(contains(html, "--method scene"));
}

TEST_CASE("a report names the worst trials of each solver, infinite ones first") {
  const tests::ScratchFolder folder;
  const Header header = tests::sample_header();
  tests::write_sample(folder / "r.h5", header);
  const ReportSource source = read_report_source((folder / "r.h5").string());
  CHECK(source.worst_metric == 0);
  REQUIRE(source.worst.size() == 10);
  for (std::size_t method = 0; method < 2; ++method) {
    std::vector<double> values;
    for (std::size_t cell = 0; cell < header.cells.size(); ++cell) {
      const TrialTable table = read_trials(folder / "r.h5", cell, method);
      for (const double value : table.metrics[0])
        if (value == value) values.push_back(value);
    }
    std::ranges::sort(values, std::greater());
    for (std::size_t i = 0; i < 5; ++i) {
      const WorstTrial& worst = source.worst[5 * method + i];
      CHECK(worst.method == method);
      CHECK(worst.value == values[i]);
      CHECK(read_trials(folder / "r.h5", worst.cell, method).metrics[0][worst.trial] == worst.value);
    }
  }
}

TEST_CASE("failures are counted per cell and method, those that never happened too") {
  const std::string html = report_html({synthetic_source()});
  // Over four cells: trials, converged, iteration limit, failed, rate.
  CHECK(contains(html,
                 "<th scope=\"row\">rr</th><td class=\"n\">20</td><td class=\"n\">16</td>"
                 "<td class=\"n\">4</td><td class=\"n\">4</td>"));
  CHECK(contains(html,
                 "<th scope=\"row\">5</th><th scope=\"row\">0.5</th><th scope=\"row\">rrr</th>"
                 "<td class=\"n\">5</td><td class=\"n\">4</td><td class=\"n\">1</td>"));
  ReportSource source = synthetic_source();
  for (Statistics& statistics : source.summary.statistics) statistics.events = {5, 0, 5};
  CHECK(contains(report_html({source}), "<td class=\"n\">0</td><td class=\"n\" data-key=\"0\">0 [≤ 0.15]</td>"));
}

TEST_CASE("checks are counted with the bound that they give, and an alarm is a warning") {
  ReportSource source = synthetic_source();
  source.summary.header.schema.metrics.push_back(
      {"ref_disagrees", "1", "trials that another program contradicts", false, true, true, "audited"});
  for (Statistics& statistics : source.summary.statistics)
    statistics.metrics.push_back(statistics_of(std::vector{0.0, 0.0, 0.0, 0.0, 0.0}));
  source.rows = summary_rows(source.summary);
  std::string html = report_html({source});
  CHECK(contains(html, "<li>Audited: 40 checks, disagreements 0"));
  CHECK(contains(html, "ref_disagrees, audited, by method"));
  CHECK(contains(html, "<td class=\"n\">20</td><td class=\"n\">0</td><td class=\"n\" data-key=\"0\">0 [≤ 0.15]"));

  source.summary.statistics[3].metrics.back() = statistics_of(std::vector{0.0, 1.0, 0.0, 0.0, 0.0});
  source.failures.insert({1, 1, 1}, std::vector<std::uint64_t>{1});
  html = report_html({source});
  CHECK(contains(html, "<li class=\"warn\"><strong>Note:</strong> Audited: 40 checks, disagreements 1"));
  CHECK(contains(html,
                 "<td>ref_disagrees</td><td><code>ridgeloc replay small.h5 --cell points=3,range_sigma_m=0.5 --trial 1 "
                 "--method rrr</code></td>"));
}

TEST_CASE("a report of an incomplete result says so and has the rest") {
  ReportSource source = synthetic_source();
  Statistics nothing;
  nothing.metrics.resize(2);
  source.summary.statistics[5] = nothing;
  source.summary.statistics[0] = nothing;
  source.rows = summary_rows(source.summary);
  const std::string html = report_html({source});
  CHECK(contains(html, "<li class=\"warn\"><strong>Note:</strong> The result is incomplete: 2 of 4 cells"));
  CHECK(unbalanced_tag(html).empty());
}

TEST_CASE("a report is one balanced page that asks for nothing, and names are not given twice") {
  ReportSource source = synthetic_source();
  FigureSpec again = source.summary.header.figures.front();
  again.name = "again";
  again.y = {"converged"};
  source.summary.header.figures.push_back(again);
  const std::string html = report_html({source, source});
  CHECK(unbalanced_tag(html) == "");
  CHECK(count(html, "<svg") == 4);
  CHECK(count(html, "role=\"img\" aria-label=\"Errors: ") == 4);
  for (const char* loads : {"http:", "https:", "src=", "@import", "<link", "<img", "url(http", "xlink"}) {
    INFO(loads);
    CHECK_FALSE(contains(html, loads));
  }
  CHECK(contains(html, "default-src 'none'; style-src 'sha256-" + sha256_base64(report_style()) +
                           "'; script-src 'sha256-" + sha256_base64(report_script()) + "'"));
  const auto names = ids(html);
  CHECK(std::ranges::adjacent_find(names) == names.end());
  static const std::regex reference("href=[\"']#([^\"']*)");
  for (std::sregex_iterator at(html.begin(), html.end(), reference), end; at != end; ++at) {
    INFO((*at)[1]);
    CHECK(std::ranges::binary_search(names, (*at)[1].str()));
  }
  CHECK(html == report_html({source, source}));
}

TEST_CASE("the digest of a content security policy is that of the standard's example") {
  // https://www.w3.org/TR/CSP3, section 6.7.2.3
  CHECK(sha256_base64("alert('Hello, world.');") == "qznLcsROx4GACP2dm0UCKCzCG+HiZ1guq6ZZDob/Tng=");
}

TEST_CASE("hostile text from a file stays text") {
  ReportSource source = synthetic_source();
  Header& header = source.summary.header;
  for (std::string* text :
       {&header.title, &header.aims, &header.experiment, &header.study_hash, &header.study_toml,
        &header.axes[0].description, &header.axes[1].unit, &header.methods[0].label, &header.methods[1].description,
        &header.schema.metrics[0].description, &header.schema.events[2].name, &header.figures[0].title,
        &header.figures[0].name, &source.path, &source.digest, &source.provenance.processor,
        &source.provenance.git_commit, &source.provenance.flags, &header.isa}) {
    *text = hostile;
  }
  header.axes[0].values[0] = hostile;
  source.provenance.contributions = {hostile};
  source.provenance.libraries = {{hostile, hostile}};
  source.provenance.wall_time_s = {{hostile, 1.0}};
  source.rows = summary_rows(source.summary);
  source.worst = {{0, 0, 3, 4.0}};
  source.failures.insert({0, 0, 0}, std::vector<std::uint64_t>{1});
  const std::string html = report_html({source, source});
  CHECK(count(html, "<script") == 1);
  CHECK(count(html, "alert(1)") > 20);
  CHECK(unbalanced_tag(html) == "");
  CHECK(html.find('\x01') == std::string::npos);
}

TEST_CASE("cells with more trials than were asked for are no contradiction") {
  ReportSource source = synthetic_source();
  source.summary.header.trials = 3;
  CHECK(contains(report_html({source}),
                 "3 trials per cell were asked for; where there are more, a stop rule wanted them, or"));
}

TEST_CASE("differences of methods stand in tables of their own, by their mean, and are no solvers") {
  ReportSource source = synthetic_source();
  Header& header = source.summary.header;
  header.methods.push_back({"rrr - rr", "h3", "difference", std::array<std::size_t, 2>{1, 0}});
  std::vector<Statistics> statistics;
  for (std::size_t i = 0; i < source.summary.statistics.size(); ++i) {
    statistics.push_back(source.summary.statistics[i]);
    if (i % 2 == 0) continue;
    Statistics difference;
    difference.trials = 5;
    difference.metrics = {statistics_of(std::vector{-1.0, 1.0, 2.0, 3.0, 4.0}), statistics_of(std::vector<double>{})};
    statistics.push_back(difference);
  }
  source.summary.statistics = statistics;
  source.rows = summary_rows(source.summary);
  const std::string html = report_html({source});
  CHECK(contains(html, "error_m [m], paired differences: mean ± Monte Carlo standard error"));
  CHECK(contains(html, "4 cells, 2 methods"));
  CHECK(count(html, "<th scope=\"row\">rrr - rr</th>") == 1 + 4);  // among the methods, and in the table of all
}

TEST_CASE("a report begins with the best method of each cell, and whether the trials show it") {
  ReportSource source = synthetic_source();
  source.summary.header.schema.metrics[0].is_compared = true;
  for (std::size_t cell = 0; cell < 4; ++cell) {
    for (std::size_t method = 0; method < 2; ++method) {
      std::vector<double> values;
      for (int i = 0; i < 100; ++i) values.push_back(1.0 + 0.01 * (i % 10) + (cell < 2 && method == 0 ? 1.0 : 0.0));
      Statistics& statistics = source.summary.statistics[2 * cell + method];
      statistics.metrics[0] = statistics_of(values);
      statistics.trials = cell == 0 ? 120 : 100;
    }
  }
  source.rows = summary_rows(source.summary);
  const std::string html = report_html({source});
  CHECK(html.find(">Which method is best where</h2>") < html.find(">Overview</h2>"));
  CHECK(contains(html, "<li>rrr: best in 2 of 4 cells, significantly in 2; not shown to be worse in 2 more</li>"));
  CHECK(contains(html, "<li>rr: best in 2 of 4 cells, significantly in 0; not shown to be worse in 0 more</li>"));
  CHECK(count(html, "<b class=\"best\">1.0450 ± 0.0029 *</b>") == 2);
  CHECK(count(html, "1.0450 ± 0.0029 ≈</td>") == 2);
  CHECK(contains(html, "Not all trials have a value"));
  CHECK(contains(report_html({synthetic_source()}), "no measure by which methods are ranked"));
}

TEST_CASE("settings in which methods differ stand before all settings") {
  ReportSource source = synthetic_source();
  source.summary.header.methods[0].description = "solver = rr, start = \"given\", k = \"a, b = c\", depth = [1, 2]";
  source.summary.header.methods[1].description = "solver = rrr, start = \"given\", k = \"gm\", theta_m = 0.05";
  const std::string html = report_html({source});
  CHECK(contains(html, "<tr><th scope=\"col\">method</th><th scope=\"col\">solver</th><th scope=\"col\">k</th></tr>"));
  CHECK(contains(html, "<tr><th scope=\"row\">rr</th><td>rr</td><td>&quot;a, b = c&quot;</td></tr>"));
  CHECK(html.find("Settings in which methods differ") < html.find("Methods and all settings that they read"));
  CHECK(contains(html, "<details>\n<summary>All settings</summary>"));
}

TEST_CASE("the table of all numbers is left to other programs where it is long") {
  ReportSource source = synthetic_source();
  CHECK(contains(report_html({source}), "All numbers in one table"));
  const std::vector<SummaryRow> rows = source.rows;
  while (source.rows.size() <= 2000) source.rows.insert(source.rows.end(), rows.begin(), rows.end());
  const std::string html = report_html({source});
  CHECK_FALSE(contains(html, "All numbers in one table"));
  CHECK(contains(html, "All " + std::to_string(source.rows.size()) + " rows with every number, as CSV"));
}

TEST_CASE("a figure that cannot be made of the result is replaced by the reason") {
  ReportSource source = synthetic_source();
  source.summary.header.figures[0].facet.clear();
  source.summary.header.figures[0].group = {"method"};
  const std::string html = report_html({source});
  CHECK(contains(html, "<p class=\"warn\">figure 'errors': several cells fall on one point"));
  CHECK_FALSE(contains(html, "<svg"));
}

TEST_CASE("what is no result gets no report") {
  const tests::ScratchFolder folder;
  CHECK_THROWS_AS(read_report_source((folder / "missing.h5").string()), core::InputError);
  std::ofstream(folder / "text.h5") << "text";
  CHECK_THROWS_AS(read_report_source((folder / "text.h5").string()), core::InputError);
}
