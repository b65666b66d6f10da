#include "results/store/summary_group.hpp"

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

std::string path_of(const std::string& name) {
  return "/summary/" + name;
}

void describe(hdf5::File& file, const std::string& name, const std::string& unit, const std::string& description) {
  file.write_attribute(path_of(name), "long_name", description);
  file.write_attribute(path_of(name), "units", unit);
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

void write_scale(hdf5::File& file, const Axis& axis) {
  const std::string path = path_of(axis.name);
  if (std::ranges::any_of(axis.values, holds<std::string>)) {
    file.write(path, texts_of(axis));
  } else if (std::ranges::all_of(axis.values, holds<std::int64_t>)) {
    file.write(path, integers_of(axis));
  } else {
    file.write(path, reals_of(axis));
  }
  file.make_scale(path, axis.name);
  describe(file, axis.name, axis.unit, axis.description);
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

/// Where the values of a cell begin, counted in methods.
std::size_t grid_point(const Header& header, std::size_t cell) {
  std::size_t point = 0;
  for (std::size_t a = 0; a < header.axes.size(); ++a)
    point = point * header.axes[a].values.size() + header.cells[cell].indices[a];
  return point * header.methods.size();
}

}  // namespace

void write_summary(hdf5::File& file, const Summary& summary) {
  const Header& header = summary.header;
  std::vector<Axis> axes = header.axes;
  axes.push_back(method_axis(header));
  axes.push_back(statistic_axis());

  file.create_group("/summary");
  hdf5::Shape shape;
  std::size_t size = 1;
  for (const Axis& axis : axes) {
    write_scale(file, axis);
    shape.push_back(axis.values.size());
    size *= axis.values.size();
  }

  std::map<std::string, std::vector<double>> arrays;
  const std::vector<double> nothing(size, std::numeric_limits<double>::quiet_NaN());
  for (const SummaryRow& row : summary_rows(summary)) {
    std::vector<double>& array = arrays.try_emplace(row.metric, nothing).first->second;
    std::size_t position = (grid_point(header, row.cell) + row.method) * statistics.size();
    for (const Statistic& statistic : statistics) array[position++] = statistic.value(row);
  }

  const auto write = [&](const std::string& name, const std::string& unit, const std::string& description) {
    const auto array = arrays.find(name);
    file.write(path_of(name), array == arrays.end() ? nothing : array->second, shape);
    describe(file, name, unit, description);
    for (std::size_t a = 0; a < axes.size(); ++a)
      file.attach_scale(path_of(name), static_cast<std::uint32_t>(a), path_of(axes[a].name));
  };
  for (const MetricInfo& metric : header.schema.metrics) write(metric.name, metric.unit, metric.description);
  for (const EventInfo& event : header.schema.events) write(event.name, "1", event.description);
}

}  // namespace ridgeloc::results
