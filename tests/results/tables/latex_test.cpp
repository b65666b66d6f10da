#include "results/tables/latex.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "results/tables/latex_text.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/synthetic_summary.hpp"

namespace {

using namespace ridgeloc;
using namespace ridgeloc::results;

const LatexSource source = {"0123456789abcdef0123", "ridgeloc export result.h5 --latex"};

/// The depth of braces at the end of a text, those that are escaped left out; -1000 where more are closed than open.
int open_braces(const std::string& text) {
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\') {
      ++i;
    } else if (text[i] == '{') {
      ++depth;
    } else if (text[i] == '}' && --depth < 0) {
      return -1000;
    }
  }
  return depth;
}

std::size_t count(const std::string& text, const std::string& piece) {
  std::size_t found = 0;
  for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1)) ++found;
  return found;
}

TEST_CASE("the LaTeX tables of a small result: the values of an axis across, methods below each other") {
  CHECK(latex_tables(synthetic_summary(), {"error_all_m", "converged"}, source) ==
        R"(% ridgeloc export result.h5 --latex
% \usepackage{booktabs}

\begin{table}
  \centering
  \caption{Errors, "small" and large: position error, all trials in m, median. In parentheses the standard error of the last digits. 5 trials per cell, seed 2018, data 0123456789ab.}
  \label{tab:error_all_m}
  \begin{tabular}{llrr}
    \toprule
     &  & \multicolumn{2}{c}{number of points} \\
    \cmidrule(lr){3-4}
    range noise in m & method & 3 & 5 \\
    \midrule
    0.1 & rr & $3.031(?)$ & $3.031(?)$ \\
     & rrr & $1.516(?)$ & $1.516(?)$ \\
    \addlinespace
    0.5 & rr & $3.031(?)$ & $3.031(?)$ \\
     & rrr & $1.516(?)$ & $1.516(?)$ \\
    \bottomrule
  \end{tabular}
\end{table}

\begin{table}
  \centering
  \caption{Errors, "small" and large: converged, rate. In parentheses the standard error of the last digits. 5 trials per cell, seed 2018, data 0123456789ab.}
  \label{tab:converged}
  \begin{tabular}{llrr}
    \toprule
     &  & \multicolumn{2}{c}{number of points} \\
    \cmidrule(lr){3-4}
    range noise in m & method & 3 & 5 \\
    \midrule
    0.1 & rr & $0.80(15)$ & $0.80(15)$ \\
     & rrr & $0.80(15)$ & $0.80(15)$ \\
    \addlinespace
    0.5 & rr & $0.80(15)$ & $0.80(15)$ \\
     & rrr & $0.80(15)$ & $0.80(15)$ \\
    \bottomrule
  \end{tabular}
\end{table}
)");
}

TEST_CASE("methods stand across where no axis has room, and a table longer than a page goes on") {
  Summary summary = synthetic_summary();
  Header& header = summary.header;
  header.axes = {{"points", "1", "number of points", {}}};
  header.cells.clear();
  summary.statistics.clear();
  for (std::size_t i = 0; i < 41; ++i) {
    header.axes[0].values.emplace_back(std::int64_t{3} + static_cast<std::int64_t>(i));
    header.cells.push_back({"cell", {i}});
    summary.statistics.insert(summary.statistics.end(), {five_trials(1.0), five_trials(0.5)});
  }
  const std::string text = latex_tables(summary, {"error_m"}, source);
  CHECK(text.find("% \\usepackage{booktabs,longtable}\n\n\\begin{longtable}{lrr}\n") != std::string::npos);
  CHECK(text.find("    number of points & rr & rrr \\\\\n    \\midrule\n  \\endhead\n") != std::string::npos);
  CHECK(text.find("    43 & ") != std::string::npos);
  CHECK(count(text, "\\begin{table}") == 0);
}

TEST_CASE("the best method of a cell is bold where it is significantly so") {
  Summary summary = synthetic_summary();
  Header& header = summary.header;
  header.schema.metrics[0].is_compared = true;
  for (std::size_t cell = 0; cell < header.cells.size(); ++cell) {
    for (std::size_t method = 0; method < 2; ++method) {
      std::vector<double> values;
      for (int i = 0; i < 100; ++i) values.push_back(1.0 + 0.01 * (i % 10) + (cell < 2 && method == 0 ? 1.0 : 0.0));
      summary.statistics[2 * cell + method].metrics[0] = statistics_of(values);
    }
  }
  const std::string text = latex_tables(summary, {"error_m", "converged"}, source);
  CHECK(count(text, "\\mathbf{1.0450(29)}") == 2);  // rrr at 3 points; at 5 points both are alike
  CHECK(count(text, "\\mathbf") == 2);
  CHECK(count(text, "Bold: significantly the best method") == 1);
}

TEST_CASE("names from a result are harmless in LaTeX, and unknown ones are refused") {
  Summary summary = synthetic_summary();
  summary.header.schema.metrics[0].name = "a}\\input{/etc/passwd";
  const std::string text = latex_tables(summary, {summary.header.schema.metrics[0].name}, source);
  CHECK(text.find("\\label{tab:a--input--etc-passwd}") != std::string::npos);
  CHECK_THROWS_AS(latex_tables(summary, {"nothing"}, source), core::InputError);
  FigureSpec figure;
  figure.y = {"nothing", "converged"};
  summary.header.figures = {figure};
  CHECK(leading_quantities(summary.header) == std::vector<std::string>{"converged"});
}

TEST_CASE("an error of a mean that is not reliable is marked") {
  const std::string text = latex_tables(synthetic_summary(), {"error_m"}, source);
  CHECK(text.find("$2.50(65)^{!}$") != std::string::npos);
  CHECK(text.find("!: the error itself is not reliable. ") != std::string::npos);
}

TEST_CASE("texts that LaTeX would interpret are shown as they are") {
  CHECK(latex_text("a & b_c") == "a \\& b\\_c");
  CHECK(latex_text("100 % $x$ #1 {y}") == "100 \\% \\$x\\$ \\#1 \\{y\\}");
  CHECK(latex_text("~^\\") == "\\textasciitilde{}\\textasciicircum{}\\textbackslash{}");
  CHECK(latex_text("[1, 5]") == "{[}1, 5]");
  CHECK(latex_text("two\nlines") == "two lines");

  Summary summary = synthetic_summary();
  summary.header.title = "50 % off {a}_b^c & \\end{table} #1 $ ~ }";
  summary.header.methods[0].label = "k_{0}";
  summary.header.axes[0].values = {std::string("[1.0, 5.0]"), std::string("}")};
  const std::string text = latex_tables(summary, {"error_m", "stationary"}, {"0123", "ridgeloc\n\\end"});
  CHECK(open_braces(text.substr(text.find('\n'))) == 0);
  CHECK(count(text, "\\end{table}") == 2);
  CHECK(text.starts_with("% ridgeloc \\end\n"));
  // An axis and the method before two columns: 3 separators in each of 2 tables' 5 lines below the name of the columns,
  // 2 beside it, and the escaped one in each caption.
  CHECK(count(text, " & ") == 2 * (5 * 3 + 2));
  CHECK(count(text, "\\& ") == 2);
}

TEST_CASE("differences and methods that do not report the metric have no column") {
  Summary summary = synthetic_summary();
  summary.header.methods.push_back({"rrr - rr", "h3", "", std::array<std::size_t, 2>{1, 0}});
  summary.header.methods.push_back({"scene", "h4", ""});
  std::vector<Statistics> statistics;
  for (std::size_t cell = 0; cell < summary.header.cells.size(); ++cell) {
    statistics.push_back(summary.statistics[2 * cell]);
    statistics.push_back(summary.statistics[2 * cell + 1]);
    statistics.push_back(summary.statistics[2 * cell]);
    statistics.push_back({5, {}, {{}, {}}});
  }
  summary.statistics = statistics;
  const std::string text = latex_tables(summary, {"error_m"}, source);
  CHECK(count(text, "& rr & ") == 2);
  CHECK(count(text, "& rrr & ") == 2);
  CHECK(text.find("scene") == std::string::npos);
  CHECK(text.find("rrr - rr") == std::string::npos);
  for (Statistics& s : summary.statistics) s.metrics = {{}, {}};
  CHECK_THROWS_AS(latex_tables(summary, {"error_m"}, source), core::InputError);
}

TEST_CASE("tables show what the figures show, else the first metric and event") {
  Header header = synthetic_summary().header;
  CHECK(leading_quantities(header) == std::vector<std::string>{"error_m", "converged"});
  FigureSpec figure;
  figure.y = {"stationary", "error_all_m"};
  header.figures = {figure, figure};
  CHECK(leading_quantities(header) == figure.y);
}

}  // namespace
