#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "results/figures/figure_view.hpp"
#include "results/schema/schema.hpp"
#include "results/tables/csv_writer.hpp"
#include "studies/plan/assignment.hpp"

/// The verbs of the program, one source file each. Each returns an exit code, or throws core::InputError or
/// core::IoError, which `main` turns into one line and an exit code.
namespace ridgeloc::app {

struct ListOptions {
  std::string topic;  ///< empty: all
};
int list(const ListOptions& options);

struct NewOptions {
  std::string experiment;
  std::string output;  ///< empty: standard output
};
int new_study(const NewOptions& options);

/// Options that every verb reading studies shares.
struct StudyOptions {
  std::vector<std::string> studies;    ///< paths or catalog names
  std::vector<std::string> overrides;  ///< KEY=VALUE, --trials and --seed among them
  int threads = 0;                     ///< 0: all processors
  std::string isa;                     ///< empty: what a stopped run has begun with, else the widest there is
};

struct PlanOptions {
  StudyOptions study;
  std::string slurm;                    ///< a job script to write; empty: none
  std::optional<std::uint64_t> shares;  ///< of this job; absent: so many that each takes about an hour
};
int plan(const PlanOptions& options);

struct RunOptions {
  StudyOptions study;
  std::string output;  ///< a file, or a folder for several studies; empty: NAME.h5 here
  studies::Shard shard;
  std::optional<double> time_limit_s;  ///< absent: none
};
int run(const RunOptions& options);

struct MergeOptions {
  std::vector<std::string> results;
  std::string output;
  bool mix_isa = false;  ///< whether blocks of different instruction sets may stand side by side
};
int merge(const MergeOptions& options);

struct CompareOptions {
  std::string first;
  std::string second;
};
int compare(const CompareOptions& options);

struct VerifyOptions {
  std::string result;
  std::uint64_t blocks = 8;           ///< to compute again
  std::optional<std::uint64_t> seed;  ///< which; absent: others each time
  bool digest = false;                ///< only print the digest of the data
  int threads = 1;
};
int verify(const VerifyOptions& options);

struct StatusOptions {
  std::vector<std::string> results;  ///< or the folders of their parts
  bool json = false;                 ///< instead of text
};
int status(const StatusOptions& options);

struct SummaryOptions {
  std::vector<std::string> results;
  bool all = false;                  ///< every number of every cell and method
  std::vector<std::string> metrics;  ///< columns, events too; empty: those that lead
  std::string cell;                  ///< a number, or AXIS=VALUE,...; empty: all
  std::vector<std::string> methods;  ///< labels, of differences too; empty: all
};
int summary(const SummaryOptions& options);

struct AuditOptions {
  std::string result;
  std::optional<std::uint64_t> trials;  ///< of each cell; absent: all
  int threads = 1;
};
int audit(const AuditOptions& options);

struct ReplayOptions {
  std::string source;  ///< a result, or a study
  std::string cell;    ///< its number, or AXIS=VALUE,...; empty: the only one
  std::uint64_t trial = 0;
  std::vector<std::string> methods;  ///< labels; empty: all
  std::vector<std::string> solvers;  ///< beside them
  bool json = false;                 ///< instead of tables
  std::string output;                ///< a picture; empty: none
};
int replay(const ReplayOptions& options);

struct SolveOptions {
  std::string data;                            ///< measured ranges, CSV; "-": standard input
  std::string objects;                         ///< where the objects are, CSV; empty: in the data
  std::string study;                           ///< whose methods; empty: solvers
  std::vector<std::string> solvers;            ///< empty: lm
  std::vector<std::string> overrides;          ///< KEY=VALUE
  std::vector<std::string> columns;            ///< ROLE=NAME
  std::string range_unit = "m";                ///< of the ranges
  std::string position_unit = "m";             ///< of the positions of objects
  std::optional<std::array<double, 3>> start;  ///< m; absent: found for each epoch
  std::optional<double> sigma_m;               ///< standard deviation of a range; absent: from the residuals
  bool is_strict = false;                      ///< refuses data with readings that are none
  bool json = false;                           ///< a JSON object a line instead of CSV
  std::string output;                          ///< empty: standard output
  std::string noise;                           ///< file for the errors; empty: none
  std::string scene;                           ///< study to write; empty: none
  std::string isa;                             ///< empty: the widest there is
};
int solve(const SolveOptions& options);

struct ExportOptions {
  std::string result;
  std::string output;  ///< empty: standard output
  bool csv = true;
  bool trials = false;                                              ///< rows per trial instead of per metric
  bool failures = false;                                            ///< rows per failed trial that is listed
  bool study = false;                                               ///< the study file that the result holds
  bool json = false;                                                ///< the same rows per metric as JSON
  bool latex = false;                                               ///< tables for LaTeX instead of CSV
  bool byte_order_mark = false;                                     ///< before CSV
  results::DecimalMark decimal_mark = results::DecimalMark::Point;  ///< of CSV
  std::string against;               ///< AXIS=VALUE: rows that compare cells with those there
  std::vector<std::string> metrics;  ///< of these tables, events too; empty: those of the figures
};
int export_result(const ExportOptions& options);

struct PlotOptions {
  std::string result;
  std::string output;                ///< a file for one figure, or a folder; empty: here
  std::vector<std::string> formats;  ///< "svg", "pdf", "png"
  std::vector<std::string> figures;  ///< names; empty: all
  results::FigureSpec asked;         ///< drawn instead of those of the study, if it names y
  bool no_bounds = false;            ///< leaves the bounds of metrics out
  results::FigureView view;
};
int plot(const PlotOptions& options);

struct ReportOptions {
  std::vector<std::string> results;
  std::string output;  ///< empty: NAME.html here, report.html for several results
};
int report(const ReportOptions& options);

}  // namespace ridgeloc::app
