#include "results/store/summary_group.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <string>

#include "results/schema/text.hpp"

namespace ridgeloc::results {
namespace {

struct Statistic {
  const char* name;
  double (*value)(const SummaryRow&);
};

/// The values along the dimension "statistic". Counts are exact as doubles up to 2^53.
constexpr std::array<Statistic, 25> statistics = {{
    {"n", [](const SummaryRow& row) { return static_cast<double>(row.n); }},
    {"beyond", [](const SummaryRow& row) { return static_cast<double>(row.beyond); }},
    {"mean", [](const SummaryRow& row) { return row.mean; }},
    {"mcse", [](const SummaryRow& row) { return row.mcse; }},
    {"lo", [](const SummaryRow& row) { return row.lo; }},
    {"hi", [](const SummaryRow& row) { return row.hi; }},
    {"sd", [](const SummaryRow& row) { return row.sd; }},
    {"sd_mcse", [](const SummaryRow& row) { return row.sd_mcse; }},
    {"min", [](const SummaryRow& row) { return row.min; }},
    {"p05", [](const SummaryRow& row) { return row.p05; }},
    {"p25", [](const SummaryRow& row) { return row.p25; }},
    {"p50", [](const SummaryRow& row) { return row.p50; }},
    {"p75", [](const SummaryRow& row) { return row.p75; }},
    {"p95", [](const SummaryRow& row) { return row.p95; }},
    {"p50_lo", [](const SummaryRow& row) { return row.p50_lo; }},
    {"p50_hi", [](const SummaryRow& row) { return row.p50_hi; }},
    {"max", [](const SummaryRow& row) { return row.max; }},
    {"trusted", [](const SummaryRow& row) { return row.trusted ? 1.0 : 0.0; }},
    {"rms", [](const SummaryRow& row) { return row.rms; }},
    {"rms_mcse", [](const SummaryRow& row) { return row.rms_mcse; }},
    {"rms_lo", [](const SummaryRow& row) { return row.rms_lo; }},
    {"rms_hi", [](const SummaryRow& row) { return row.rms_hi; }},
    {"p95_lo", [](const SummaryRow& row) { return row.p95_lo; }},
    {"p95_hi", [](const SummaryRow& row) { return row.p95_hi; }},
    {"rms_trusted", [](const SummaryRow& row) { return row.rms_trusted ? 1.0 : 0.0; }},
}};

std::string summary_path(const std::string& name) {
  return "/summary/" + name;
}

void describe(hdf5::File& file, const std::string& name, const std::string& unit, const std::string& description) {
  file.write_attribute(summary_path(name), "long_name", description);
  file.write_attribute(summary_path(name), "units", unit);
}

template <typename T>
bool holds(const FactorValue& value) {
  return std::holds_alternative<T>(value);
}

std::vector<std::int64_t> integers_of(const Axis& axis) {
  std::vector<std::int64_t> numbers;
  for (const FactorValue& value : axis.values) numbers.push_back(std::get<std::int64_t>(value));
  return numbers;
}

std::vector<double> reals_of(const Axis& axis) {
  std::vector<double> numbers;
  for (const FactorValue& value : axis.values)
    numbers.push_back(holds<double>(value) ? std::get<double>(value)
                                           : static_cast<double>(std::get<std::int64_t>(value)));
  return numbers;
}

std::vector<std::string> texts_of(const Axis& axis) {
  std::vector<std::string> texts;
  for (const FactorValue& value : axis.values) texts.push_back(factor_text(value));
  return texts;
}

void write_values(hdf5::File& file, const Axis& axis) {
  const std::string path = summary_path(axis.name);
  if (std::ranges::any_of(axis.values, holds<std::string>)) {
    file.write(path, texts_of(axis));
  } else if (std::ranges::all_of(axis.values, holds<std::int64_t>)) {
    file.write(path, integers_of(axis));
  } else {
    file.write(path, reals_of(axis));
  }
  describe(file, axis.name, axis.unit, axis.description);
}

void write_scale(hdf5::File& file, const Axis& axis) {
  write_values(file, axis);
  file.make_scale(summary_path(axis.name), axis.name);
}

constexpr const char* cell_dimension = "cell";

Axis cell_axis(const Header& header) {
  Axis axis{cell_dimension, "1", "number of the cell", {}};
  for (std::size_t cell = 0; cell < header.cells.size(); ++cell)
    axis.values.emplace_back(static_cast<std::int64_t>(cell));
  return axis;
}

/// An axis of the sweep with its value in each cell.
Axis along_cells(const Header& header, std::size_t a) {
  Axis axis = header.axes[a];
  axis.values.clear();
  for (const CellInfo& cell : header.cells) axis.values.push_back(header.axes[a].values[cell.indices[a]]);
  return axis;
}

Axis method_axis(const Header& header) {
  Axis axis{"method", "1", "solver with its settings", {}};
  for (const MethodInfo& method : header.methods) axis.values.emplace_back(method.label);
  return axis;
}

Axis statistic_axis() {
  Axis axis{"statistic", "1", "statistic over the trials", {}};
  for (const Statistic& statistic : statistics) axis.values.emplace_back(std::string(statistic.name));
  return axis;
}

/// Whether every point of the grid that the axes span is a cell.
bool fills_grid(const Header& header) {
  std::size_t points = 1;
  for (const Axis& axis : header.axes) {
    points *= axis.values.size();
    if (points > header.cells.size()) return false;
  }
  return points == header.cells.size();
}

/// Place of a cell on the grid, the last axis fastest.
std::size_t grid_point(const Header& header, std::size_t cell) {
  std::size_t point = 0;
  for (std::size_t a = 0; a < header.axes.size(); ++a)
    point = point * header.axes[a].values.size() + header.cells[cell].indices[a];
  return point;
}

}  // namespace

void write_summary(hdf5::File& file, const Summary& summary) {
  const Header& header = summary.header;
  const bool is_grid = fills_grid(header);
  std::vector<Axis> dimensions = is_grid ? header.axes : std::vector<Axis>{cell_axis(header)};
  dimensions.push_back(method_axis(header));
  dimensions.push_back(statistic_axis());

  file.create_group("/summary");
  hdf5::Shape shape;
  for (const Axis& dimension : dimensions) {
    write_scale(file, dimension);
    shape.push_back(dimension.values.size());
  }
  std::vector<std::string> coordinates;
  for (std::size_t a = 0; a < header.axes.size() && !is_grid; ++a) {
    write_values(file, along_cells(header, a));
    file.attach_scale(summary_path(header.axes[a].name), 0, summary_path(cell_dimension));
    coordinates.push_back(header.axes[a].name);
  }

  std::map<std::string, std::vector<double>> arrays;
  const std::size_t methods = header.methods.size();
  const std::vector<double> nothing(header.cells.size() * methods * statistics.size(),
                                    std::numeric_limits<double>::quiet_NaN());
  for (const SummaryRow& row : summary_rows(summary)) {
    std::vector<double>& array = arrays.try_emplace(row.metric, nothing).first->second;
    const std::size_t place = is_grid ? grid_point(header, row.cell) : row.cell;
    std::size_t position = (place * methods + row.method) * statistics.size();
    for (const Statistic& statistic : statistics) array[position++] = statistic.value(row);
  }

  const auto write = [&](const std::string& name, const std::string& unit, const std::string& description) {
    const auto array = arrays.find(name);
    file.write(summary_path(name), array == arrays.end() ? nothing : array->second, shape, hdf5::Layout::Compressed);
    describe(file, name, unit, description);
    if (!coordinates.empty())
      file.write_attribute(summary_path(name), "coordinates", fmt::format("{}", fmt::join(coordinates, " ")));
    for (std::size_t d = 0; d < dimensions.size(); ++d)
      file.attach_scale(summary_path(name), static_cast<std::uint32_t>(d), summary_path(dimensions[d].name));
  };
  for (const MetricInfo& metric : header.schema.metrics) write(metric.name, metric.unit, metric.description);
  for (const EventInfo& event : header.schema.events) write(event.name, "1", event.description);
}

}  // namespace ridgeloc::results
