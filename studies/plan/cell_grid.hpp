#pragma once

#include <cstddef>
#include <vector>

#include "studies/study/study.hpp"

namespace ridgeloc::studies {

/// An axis as results have it, each value once, and where the values of a zipped one stand on it, which may repeat.
struct DistinctValues {
  std::vector<Value> values;
  std::vector<std::size_t> places;  ///< per value of the study's axis
};

DistinctValues distinct_values(const SweepAxis& axis);

/// The cells of a study: its axes crossed, the last axis fastest, zipped axes as one, without the cells that `exclude`
/// names. Cells are made when they are asked for, since a million of them with all their settings take gigabytes.
class CellGrid {
 public:
  CellGrid() = default;
  explicit CellGrid(const Study& study);

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

  /// Precondition: number < size().
  Cell operator[](std::size_t number) const;

  /// Turns a cell of this grid into another one: what whoever looks at all of them does.
  void move_to(std::size_t number, Cell& cell) const;

  /// Whether a cell has all of these values of swept settings.
  bool has_any(const Values& values) const;

 private:
  /// By axis, the number of its value in the cell at a position of the whole grid.
  void number_values(std::size_t position, std::vector<std::size_t>& numbers) const;
  std::size_t position_of(std::size_t number) const;

  Values fixed_;
  std::vector<SweepAxis> sweep_;
  std::vector<std::vector<std::size_t>> places_;  ///< by axis and number of a value, where results have it
  std::vector<std::vector<std::size_t>> groups_;  ///< axes that move together, by the first of them
  std::size_t size_ = 0;
  std::vector<std::size_t> kept_;  ///< positions in the whole grid, where cells are left out
};

}  // namespace ridgeloc::studies
