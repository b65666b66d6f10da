#include "results/tables/latex.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "core/error.hpp"
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

TEST_CASE("the LaTeX tables of a small result") {
  Summary summary = synthetic_summary();
  summary.header.cells.resize(2);
  summary.statistics.resize(4);
  CHECK(latex_tables(summary, {"error_all_m", "converged"}, source) == R"(% ridgeloc export result.h5 --latex
% \usepackage{booktabs}

\begin{table}
  \centering
  \caption{Errors, "small" and large: position error, all trials in m, median. In parentheses the standard error of the last digits. 5 trials per cell, seed 2018, data 0123456789ab.}
  \label{tab:error_all_m}
  \begin{tabular}{rrrr}
    \toprule
    points & range\_sigma\_m & rr & rrr \\
    \midrule
    3 & 0.1 & $3.031(\infty)$ & $1.516(\infty)$ \\
    3 & 0.5 & $3.031(\infty)$ & $1.516(\infty)$ \\
    \bottomrule
  \end{tabular}
\end{table}

\begin{table}
  \centering
  \caption{Errors, "small" and large: converged, rate. In parentheses the standard error of the last digits. 5 trials per cell, seed 2018, data 0123456789ab.}
  \label{tab:converged}
  \begin{tabular}{rrrr}
    \toprule
    points & range\_sigma\_m & rr & rrr \\
    \midrule
    3 & 0.1 & $0.80(15)$ & $0.80(15)$ \\
    3 & 0.5 & $0.80(15)$ & $0.80(15)$ \\
    \bottomrule
  \end{tabular}
\end{table}
)");
}

TEST_CASE("an error of a mean that is not reliable is marked") {
  const std::string text = latex_tables(synthetic_summary(), {"error_m"}, source);
  CHECK(text.find("$2.50(65)^{!}$") != std::string::npos);
  CHECK(text.find("!: the error itself is not reliable.}") != std::string::npos);
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
  // Two axes and two methods: 3 separators in each of 2 tables' 5 lines, and the escaped one in each caption.
  CHECK(count(text, " & ") == 2 * 5 * 3);
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
  CHECK(text.find("points & range\\_sigma\\_m & rr & rrr \\\\\n") != std::string::npos);
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
