#pragma once

#include <iosfwd>
#include <memory>
#include <span>
#include <string>

#include "results/tables/csv_writer.hpp"
#include "studies/measured/epoch.hpp"
#include "studies/measured/epoch_geometry.hpp"
#include "studies/measured/epoch_solver.hpp"

namespace ridgeloc::studies {

/// Writes answers, one a line.
class FixWriter {
 public:
  virtual ~FixWriter() = default;
  virtual void write(const Epoch& epoch, const EpochGeometry& geometry, const std::string& method, const Fix& fix) = 0;
  virtual void flush() = 0;
};

/// As CSV under a line of names; cells of what there is not are empty. Residuals stand in one cell, OBJECT=METRES with
/// blanks between.
std::unique_ptr<FixWriter> csv_fix_writer(std::ostream& out, results::DecimalMark mark);

/// As JSON, an object a line; null for what there is not.
std::unique_ptr<FixWriter> json_fix_writer(std::ostream& out);

}  // namespace ridgeloc::studies
