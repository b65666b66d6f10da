#include "results/store/failure_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace ridgeloc::results {
namespace {

using Counts = std::vector<std::uint64_t>;

void require_failures(bool condition, const hdf5::File& file, std::string_view what) {
  if (!condition) throw core::IoError(fmt::format("{} is damaged: /failures {}", file.path().string(), what));
}

}  // namespace

void write_failures(hdf5::File& file, const FailureList& failures, const Schema& schema) {
  Counts cell, method, trial;
  std::vector<std::uint8_t> reason;
  for (const auto& [key, trials] : failures.trials()) {
    cell.insert(cell.end(), trials.size(), key.cell);
    method.insert(method.end(), trials.size(), key.method);
    reason.insert(reason.end(), trials.size(), static_cast<std::uint8_t>(key.reason));
    trial.insert(trial.end(), trials.begin(), trials.end());
  }
  file.create_group("/failures");
  file.write_attribute("/failures", "reasons", failure_reasons(schema));
  file.write_attribute("/failures", "limit", std::uint64_t{FailureList::limit});
  const hdf5::Shape shape{trial.size()};
  file.write("/failures/cell", cell, shape, hdf5::Layout::Compressed);
  file.write("/failures/method", method, shape, hdf5::Layout::Compressed);
  file.write("/failures/reason", reason, shape, hdf5::Layout::Compressed);
  file.write("/failures/trial", trial, shape, hdf5::Layout::Compressed);
}

FailureList read_failures(const hdf5::File& file, const Header& header) {
  FailureList failures;
  if (!file.contains("/failures")) return failures;
  const auto cell = file.read<std::uint64_t>("/failures/cell");
  const auto method = file.read<std::uint64_t>("/failures/method");
  const auto reason = file.read<std::uint8_t>("/failures/reason");
  const auto trial = file.read<std::uint64_t>("/failures/trial");
  const std::size_t size = trial.size();
  require_failures(cell.size() == size && method.size() == size && reason.size() == size, file,
                   "has datasets that differ in length");
  const std::size_t reasons = failure_reasons(header.schema).size();
  for (std::size_t begin = 0; begin < size;) {
    const FailureKey key{cell[begin], method[begin], reason[begin]};
    require_failures(key.cell < header.cells.size() && key.method < header.methods.size() && key.reason < reasons, file,
                     "names an unknown cell, method or reason");
    std::size_t end = begin;
    while (end < size && FailureKey{cell[end], method[end], reason[end]} == key) ++end;
    const Counts trials(trial.begin() + static_cast<std::ptrdiff_t>(begin),
                        trial.begin() + static_cast<std::ptrdiff_t>(end));
    require_failures(std::ranges::is_sorted(trials), file, "has trials out of order");
    failures.insert(key, trials);
    begin = end;
  }
  return failures;
}

}  // namespace ridgeloc::results
