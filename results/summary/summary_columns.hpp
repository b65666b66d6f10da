#pragma once

#include <array>

#include "results/summary/summary.hpp"

namespace ridgeloc::results {

/// The numbers of a `SummaryRow` by the names that exports give them, in their order. CSV has trusted and beyond
/// between the two groups, and rms_trusted behind them.
struct SummaryColumn {
  const char* name;
  double SummaryRow::*value;
};
inline constexpr std::array<SummaryColumn, 12> summary_columns = {{{"mean", &SummaryRow::mean},
                                                                   {"mcse", &SummaryRow::mcse},
                                                                   {"sd", &SummaryRow::sd},
                                                                   {"min", &SummaryRow::min},
                                                                   {"p05", &SummaryRow::p05},
                                                                   {"p25", &SummaryRow::p25},
                                                                   {"p50", &SummaryRow::p50},
                                                                   {"p75", &SummaryRow::p75},
                                                                   {"p95", &SummaryRow::p95},
                                                                   {"max", &SummaryRow::max},
                                                                   {"lo", &SummaryRow::lo},
                                                                   {"hi", &SummaryRow::hi}}};
inline constexpr std::array<SummaryColumn, 9> summary_bar_columns = {{{"p50_lo", &SummaryRow::p50_lo},
                                                                      {"p50_hi", &SummaryRow::p50_hi},
                                                                      {"sd_mcse", &SummaryRow::sd_mcse},
                                                                      {"rms", &SummaryRow::rms},
                                                                      {"rms_mcse", &SummaryRow::rms_mcse},
                                                                      {"rms_lo", &SummaryRow::rms_lo},
                                                                      {"rms_hi", &SummaryRow::rms_hi},
                                                                      {"p95_lo", &SummaryRow::p95_lo},
                                                                      {"p95_hi", &SummaryRow::p95_hi}}};

}  // namespace ridgeloc::results
