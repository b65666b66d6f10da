#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "results/blocks/failure_list.hpp"
#include "results/store/provenance.hpp"
#include "results/summary/summary.hpp"

namespace ridgeloc::results {

/// A kept trial with one of the largest values that its method has.
struct WorstTrial {
  std::size_t cell = 0;
  std::size_t method = 0;
  std::uint64_t trial = 0;
  double value = 0.0;
};

/// All that a report tells of one result.
struct ReportSource {
  std::string path;  ///< of the result, as commands in the report name it
  Summary summary;
  std::vector<SummaryRow> rows;  ///< of the summary
  FailureList failures;
  Provenance provenance;
  std::string digest;             ///< of the data, as it was sealed
  std::size_t worst_metric = 0;   ///< what `worst` are the largest values of
  std::vector<WorstTrial> worst;  ///< by method, largest first
};

/// Of a run that has not come to its end it knows what the parts hold so far: neither provenance, digest nor single
/// trials. Throws core::InputError if there is nothing, no result, or a damaged one.
ReportSource read_report_source(const std::string& path);

/// One HTML page about one or several results: what was studied, figures, tables, failures, checks, where the numbers
/// come from, and the commands that make them again. It needs nothing but itself: style, script and figures stand in
/// it, and its content security policy forbids the browser every request and every other script. Without the script it
/// says the same; the script sorts and filters tables. Equal results give equal pages.
///
/// Throws core::InputError if there are figures and no gnuplot, core::IoError if drawing fails. A figure that its
/// study asks for in vain stands there with the reason.
std::string report_html(const std::vector<ReportSource>& sources);

}  // namespace ridgeloc::results
