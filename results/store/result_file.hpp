#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "results/blocks/failure_list.hpp"
#include "results/blocks/ledger.hpp"
#include "results/blocks/trial_table.hpp"
#include "results/store/snapshot.hpp"
#include "results/summary/summary.hpp"

namespace ridgeloc::results {

// Readers of a sealed result. Each throws core::InputError, one line, if the file is missing, is not HDF5, is
// no result, has a newer major version, or is truncated or damaged: all but `read_trials` compare what the file holds
// with the digests that were stored when it was sealed. HDF5 itself can crash on a damaged file.

/// What the result is, and the totals of each cell and method.
Summary read_result(const std::filesystem::path& path);

/// All but the values of single trials.
Snapshot read_sealed(const std::filesystem::path& path);

/// What the result is, without its numbers.
Header read_result_header(const std::filesystem::path& path);

/// Reads all that continuing or merging the result would read, and drops it.
void read_completely(const std::filesystem::path& path);

/// The rows behind the totals, with a digest per block.
Ledger read_result_ledger(const std::filesystem::path& path);

/// The first trials that failed, by cell, method and reason; empty if the file is older than the list.
FailureList read_result_failures(const std::filesystem::path& path);

/// Without kept trials the table is empty. Checks only that the values are there: whether they are those that were
/// written is for `data_digest` to find out, once for all tables.
TrialTable read_trials(const std::filesystem::path& path, std::size_t cell, std::size_t method);

/// Reads the kept trials of all cells and methods, and drops them.
void read_all_trials(const std::filesystem::path& path);

/// Calls `visit` with the kept trials of each method in each cell that report a metric, given by its index: their
/// numbers and values.
using TrialVisitor = std::function<void(std::size_t cell, std::size_t method, const std::vector<std::uint64_t>& trials,
                                        const std::vector<double>& values)>;
void visit_trials(const std::filesystem::path& path, std::size_t metric, const TrialVisitor& visit);

/// SHA-256 over the names, types, shapes and values of all datasets except those under /provenance, in name
/// order: two results with equal digests hold the same numbers. Computed from the values, and the same as when the
/// result was sealed; docs/file-format.md defines it.
std::string data_digest(const std::filesystem::path& path);

/// Totals of every cell and method of a study.
Summary summarize(const Header& header, const Ledger& ledger);

}  // namespace ridgeloc::results
