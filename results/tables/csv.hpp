#pragma once

#include <cstddef>
#include <iosfwd>
#include <vector>

#include "results/blocks/failure_list.hpp"
#include "results/blocks/trial_table.hpp"
#include "results/summary/cell_comparison.hpp"
#include "results/summary/summary.hpp"
#include "results/tables/csv_writer.hpp"

namespace ridgeloc::results {

/// Comma-separated values as RFC 4180 has them (UTF-8, fields quoted where needed), but for lines that end in LF.
/// Numbers are written in the shortest form that reads back as the same double; `nan` stands where a quantity
/// is not defined and `inf` for a trial without a finite value, as R, pandas, Julia and MATLAB read them. With decimal
/// commas the cells are separated by semicolons. Texts that a spreadsheet would compute begin with an apostrophe
/// (`CsvWriter`). Throws core::IoError when `out` fails.

/// Long form, one row per cell, method and metric: the axes, then method, metric, unit, n, mean, mcse, sd,
/// min, p05, p25, p50, p75, p95, max, lo, hi, trusted (1 or 0), beyond, p50_lo, p50_hi, sd_mcse, rms, rms_mcse, rms_lo,
/// rms_hi, p95_lo, p95_hi, rms_trusted (1 or 0). The columns mean what they do in `SummaryRow`. Rows of ratios ("a /
/// b") come last in each cell.
void write_summary_csv(const Summary& summary, std::ostream& out, DecimalMark mark = DecimalMark::Point);

/// A row per comparison: the axes of the cell, against (the other cell as text), method, metric, unit, n, n_against,
/// difference, ratio, each with _mcse, _lo and _hi, correlation, paired, trusted. The columns mean what they do in
/// `CellComparison`; the difference is in the unit, the ratio has none.
void write_cell_comparisons_csv(const Header& header, const std::vector<CellComparison>& comparisons, std::ostream& out,
                                DecimalMark mark = DecimalMark::Point);

/// Heading of the rows per trial: the axes, trial, method, status, then one column per metric.
void write_trials_csv_heading(const Header& header, std::ostream& out, DecimalMark mark = DecimalMark::Point);

/// The kept trials of one method in one cell under that heading; metrics that the method does not report are `nan`.
/// Precondition: the columns of `trials` are empty or of equal length, as `read_trials` gives them.
void write_trials_csv(const Header& header, std::size_t cell, std::size_t method, const TrialTable& trials,
                      std::ostream& out, DecimalMark mark = DecimalMark::Point);

/// The listed failures: the axes, then trial, method, reason.
void write_failures_csv(const Header& header, const FailureList& failures, std::ostream& out,
                        DecimalMark mark = DecimalMark::Point);

}  // namespace ridgeloc::results
