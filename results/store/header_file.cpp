#include "results/store/header_file.hpp"

#include <fmt/format.h>

#include <charconv>
#include <utility>

#include "core/error.hpp"
#include "results/schema/axis_values.hpp"
#include "results/schema/text.hpp"

namespace ridgeloc::results {
namespace {

/// The yes-or-no properties of metrics and where they are stored.
constexpr std::pair<const char*, bool MetricInfo::*> metric_flags[] = {
    {"/metrics/heavy_tailed", &MetricInfo::heavy_tailed},
    {"/metrics/whole_numbers", &MetricInfo::whole_numbers},
    {"/metrics/yes_no", &MetricInfo::yes_no}};

// The kinds of a factor value in /axes/<i>/kind: the position of its type in FactorValue.
static_assert(std::is_same_v<FactorValue, std::variant<std::int64_t, double, std::string>>);

void require(bool condition, const hdf5::File& file, const char* what) {
  if (!condition) throw core::IoError(fmt::format("{} is damaged: {}", file.path().string(), what));
}

template <typename Number>
FactorValue parse(const hdf5::File& file, const std::string& text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  require(error == std::errc() && end == text.data() + text.size(), file, "a value under /axes is not a number");
  return number;
}

FactorValue value_of(const hdf5::File& file, std::uint8_t kind, const std::string& text) {
  require(kind < std::variant_size_v<FactorValue>, file, "a value under /axes is of no known kind");
  if (kind == 0) return parse<std::int64_t>(file, text);
  if (kind == 1) return parse<double>(file, text);
  return text;
}

void write_axes(hdf5::File& file, const std::vector<Axis>& axes) {
  file.create_group("/axes");
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const std::string group = fmt::format("/axes/{}", i);
    file.create_group(group);
    file.write_attribute(group, "name", axes[i].name);
    file.write_attribute(group, "unit", axes[i].unit);
    file.write_attribute(group, "description", axes[i].description);
    std::vector<std::uint8_t> kinds;
    std::vector<std::string> texts;
    for (const FactorValue& value : axes[i].values) {
      kinds.push_back(static_cast<std::uint8_t>(value.index()));
      texts.push_back(factor_text(value));
    }
    file.write(group + "/value", texts);
    file.write(group + "/kind", kinds);
  }
}

std::vector<Axis> read_axes(const hdf5::File& file) {
  std::vector<Axis> axes;
  for (std::size_t i = 0; file.contains(fmt::format("/axes/{}", i)); ++i) {
    const std::string group = fmt::format("/axes/{}", i);
    Axis axis{file.text_attribute(group, "name"),
              file.text_attribute(group, "unit"),
              file.text_attribute(group, "description"),
              {}};
    const auto texts = file.read_text(group + "/value");
    const auto kinds = file.read<std::uint8_t>(group + "/kind");
    require(texts.size() == kinds.size(), file, "the datasets of an axis differ in length");
    for (std::size_t v = 0; v < texts.size(); ++v) axis.values.push_back(value_of(file, kinds[v], texts[v]));
    axes.push_back(std::move(axis));
  }
  return axes;
}

void write_cells(hdf5::File& file, const Header& header) {
  std::vector<std::string> hashes;
  std::vector<std::uint64_t> indices;
  for (const CellInfo& cell : header.cells) {
    hashes.push_back(cell.hash);
    indices.insert(indices.end(), cell.indices.begin(), cell.indices.end());
  }
  file.create_group("/cells");
  file.write("/cells/hash", hashes);
  file.write("/cells/index", indices, {header.cells.size(), header.axes.size()});
  std::vector<std::uint8_t> bounds;
  for (const CellInfo& cell : header.cells) bounds.push_back(static_cast<std::uint8_t>(cell.bound));
  file.write("/cells/bound", bounds);
}

std::vector<CellInfo> read_cells(const hdf5::File& file, const std::vector<Axis>& axes) {
  const auto hashes = file.read_text("/cells/hash");
  const auto indices = file.read<std::uint64_t>("/cells/index");
  require(indices.size() == hashes.size() * axes.size(), file, "/cells/index has another length than /cells/hash");
  std::vector<CellInfo> cells;
  for (std::size_t c = 0; c < hashes.size(); ++c) {
    CellInfo cell{hashes[c], {}};
    for (std::size_t a = 0; a < axes.size(); ++a) {
      const std::uint64_t index = indices[c * axes.size() + a];
      require(index < axes[a].values.size(), file, "/cells/index points outside an axis");
      cell.indices.push_back(index);
    }
    cells.push_back(std::move(cell));
  }
  if (file.contains("/cells/bound")) {  // since version 1.4
    const auto bounds = file.read<std::uint8_t>("/cells/bound");
    require(bounds.size() == cells.size(), file, "/cells/bound has another length than /cells/hash");
    for (std::size_t c = 0; c < cells.size(); ++c) {
      require(bounds[c] <= static_cast<std::uint8_t>(BoundKind::RootMeanSquare), file,
              "/cells/bound holds an unknown kind");
      cells[c].bound = static_cast<BoundKind>(bounds[c]);
    }
  }
  return cells;
}

/// One text member of each entry of a list, as a dataset.
template <typename Info>
void write_column(hdf5::File& file, const std::string& path, const std::vector<Info>& list, std::string Info::*member) {
  std::vector<std::string> texts;
  for (const Info& info : list) texts.push_back(info.*member);
  file.write(path, texts);
}

template <typename Info>
void read_members(const hdf5::File& file, const std::string& path, std::vector<Info>& list, std::string Info::*member) {
  std::vector<std::string> texts = file.read_text(path);
  if (list.empty()) list.resize(texts.size());
  require(list.size() == texts.size(), file, "the datasets of a list differ in length");
  for (std::size_t i = 0; i < texts.size(); ++i) list[i].*member = std::move(texts[i]);
}

void write_schema(hdf5::File& file, const Header& header) {
  file.create_group("/methods");
  write_column(file, "/methods/label", header.methods, &MethodInfo::label);
  write_column(file, "/methods/hash", header.methods, &MethodInfo::hash);
  write_column(file, "/methods/description", header.methods, &MethodInfo::description);
  // For each method the two that it is the difference of; its own number twice where it is none.
  std::vector<std::uint64_t> differences;
  for (std::size_t m = 0; m < header.methods.size(); ++m) {
    const auto pair = header.methods[m].difference.value_or(std::array<std::size_t, 2>{m, m});
    differences.insert(differences.end(), pair.begin(), pair.end());
  }
  file.write("/methods/difference", differences, {header.methods.size(), 2});
  file.create_group("/metrics");
  write_column(file, "/metrics/name", header.schema.metrics, &MetricInfo::name);
  write_column(file, "/metrics/unit", header.schema.metrics, &MetricInfo::unit);
  write_column(file, "/metrics/description", header.schema.metrics, &MetricInfo::description);
  for (const auto& [path, flag] : metric_flags) {
    std::vector<std::uint8_t> values;
    for (const MetricInfo& metric : header.schema.metrics) values.push_back(metric.*flag ? 1 : 0);
    file.write(path, values);
  }
  write_column(file, "/metrics/alarm", header.schema.metrics, &MetricInfo::alarm);
  write_column(file, "/metrics/bound", header.schema.metrics, &MetricInfo::bound);
  std::vector<std::uint64_t> freedoms;
  for (const MetricInfo& metric : header.schema.metrics) freedoms.push_back(metric.chi_square);
  file.write("/metrics/chi_square", freedoms);
  file.create_group("/events");
  write_column(file, "/events/name", header.schema.events, &EventInfo::name);
  write_column(file, "/events/description", header.schema.events, &EventInfo::description);
  file.write_attribute("/events", "statuses", header.schema.statuses);
  std::vector<std::uint8_t> failures;
  for (const EventInfo& event : header.schema.events) failures.push_back(event.is_failure ? 1 : 0);
  file.write("/events/failure", failures);
}

void read_schema(const hdf5::File& file, Header& header) {
  read_members(file, "/methods/label", header.methods, &MethodInfo::label);
  read_members(file, "/methods/hash", header.methods, &MethodInfo::hash);
  read_members(file, "/methods/description", header.methods, &MethodInfo::description);
  if (file.contains("/methods/difference")) {  // since version 1.2
    const auto numbers = file.read<std::uint64_t>("/methods/difference");
    require(numbers.size() == 2 * header.methods.size(), file, "the datasets of /methods differ in length");
    for (std::size_t m = 0; m < header.methods.size(); ++m) {
      const std::array<std::size_t, 2> pair = {numbers[2 * m], numbers[2 * m + 1]};
      require(pair[0] < header.methods.size() && pair[1] < header.methods.size(), file,
              "/methods/difference names an unknown method");
      if (pair[0] != m || pair[1] != m) header.methods[m].difference = pair;
    }
  }
  read_members(file, "/metrics/name", header.schema.metrics, &MetricInfo::name);
  read_members(file, "/metrics/unit", header.schema.metrics, &MetricInfo::unit);
  read_members(file, "/metrics/description", header.schema.metrics, &MetricInfo::description);
  for (const auto& [path, flag] : metric_flags) {
    if (!file.contains(path)) continue;  // of a later minor version than the file
    const auto values = file.read<std::uint8_t>(path);
    require(values.size() == header.schema.metrics.size(), file, "the datasets of /metrics differ in length");
    for (std::size_t m = 0; m < values.size(); ++m) header.schema.metrics[m].*flag = values[m] != 0;
  }
  if (file.contains("/metrics/alarm")) read_members(file, "/metrics/alarm", header.schema.metrics, &MetricInfo::alarm);
  if (file.contains("/metrics/bound")) read_members(file, "/metrics/bound", header.schema.metrics, &MetricInfo::bound);
  if (file.contains("/metrics/chi_square")) {  // since version 1.4
    const auto freedoms = file.read<std::uint64_t>("/metrics/chi_square");
    require(freedoms.size() == header.schema.metrics.size(), file, "the datasets of /metrics differ in length");
    for (std::size_t m = 0; m < freedoms.size(); ++m) header.schema.metrics[m].chi_square = freedoms[m];
  }
  read_members(file, "/events/name", header.schema.events, &EventInfo::name);
  read_members(file, "/events/description", header.schema.events, &EventInfo::description);
  if (file.contains("/events/failure")) {  // since version 1.2
    const auto failures = file.read<std::uint8_t>("/events/failure");
    require(failures.size() == header.schema.events.size(), file, "the datasets of /events differ in length");
    for (std::size_t e = 0; e < failures.size(); ++e) header.schema.events[e].is_failure = failures[e] != 0;
  }
  header.schema.statuses = file.number_attribute("/events", "statuses");
  require(header.schema.statuses <= header.schema.events.size(), file, "it has more statuses than events");
}

/// Figures show numbers and are none: attributes, so that the digest over all datasets does not depend on
/// them.
void write_figures(hdf5::File& file, const std::vector<FigureSpec>& figures) {
  file.create_group("/figures");
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const FigureSpec& figure = figures[i];
    const std::string group = fmt::format("/figures/{}", i);
    file.create_group(group);
    file.write_attribute(group, "name", figure.name);
    file.write_attribute(group, "title", figure.title);
    file.write_attribute(group, "kind", figure.kind);
    file.write_attribute(group, "x", figure.x);
    file.write_attribute(group, "y", figure.y);
    file.write_attribute(group, "statistic", figure.statistic);
    file.write_attribute(group, "group", figure.group);
    file.write_attribute(group, "facet", figure.facet);
    file.write_attribute(group, "methods", figure.methods);
    file.write_attribute(group, "where", axis_values_texts(figure.where));
    file.write_attribute(group, "log_y", std::uint64_t{figure.log_y});
    file.write_attribute(group, "bounds", std::uint64_t{figure.bounds});
  }
}

std::vector<FigureSpec> read_figures(const hdf5::File& file) {
  std::vector<FigureSpec> figures;
  for (std::size_t i = 0; file.contains(fmt::format("/figures/{}", i)); ++i) {
    const std::string group = fmt::format("/figures/{}", i);
    FigureSpec figure;
    figure.name = file.text_attribute(group, "name");
    figure.title = file.text_attribute(group, "title");
    if (file.has_attribute(group, "kind")) figure.kind = file.text_attribute(group, "kind");  // since version 1.2
    figure.x = file.text_attribute(group, "x");
    figure.y = file.texts_attribute(group, "y");
    figure.statistic = file.text_attribute(group, "statistic");
    figure.group = file.texts_attribute(group, "group");
    figure.facet = file.text_attribute(group, "facet");
    figure.methods = file.texts_attribute(group, "methods");
    if (file.has_attribute(group, "where")) {  // since version 1.2
      for (const std::string& text : file.texts_attribute(group, "where")) add_axis_values(figure.where, text);
    }
    figure.log_y = file.number_attribute(group, "log_y") != 0;
    if (file.has_attribute(group, "bounds"))  // since version 1.4
      figure.bounds = file.number_attribute(group, "bounds") != 0;
    figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace

void write_header(hdf5::File& file, const Header& header) {
  file.write_attribute("/", "title", header.title);
  if (!header.aims.empty()) file.write_attribute("/", "aims", header.aims);
  file.write_attribute("/", "experiment", header.experiment);
  file.write_attribute("/", "experiment_version", static_cast<std::uint64_t>(header.experiment_version));
  file.write_attribute("/", "study_hash", header.study_hash);
  file.write_attribute("/", "seed", header.seed);
  file.write_attribute("/", "trials", header.trials);
  file.write_attribute("/", "block_trials", header.block_trials);
  file.write_attribute("/", "kept_trials", header.kept_trials);
  file.write_attribute("/", "isa", header.isa);
  write_axes(file, header.axes);
  write_cells(file, header);
  write_schema(file, header);
  write_figures(file, header.figures);
}

Header read_header(const hdf5::File& file) {
  Header header;
  header.title = file.text_attribute("/", "title");
  if (file.has_attribute("/", "aims")) header.aims = file.text_attribute("/", "aims");
  header.experiment = file.text_attribute("/", "experiment");
  header.experiment_version = static_cast<int>(file.number_attribute("/", "experiment_version"));
  header.study_hash = file.text_attribute("/", "study_hash");
  header.study_toml = file.text_attribute("/provenance", "study");
  header.seed = file.number_attribute("/", "seed");
  header.trials = file.number_attribute("/", "trials");
  header.block_trials = file.number_attribute("/", "block_trials");
  header.kept_trials = file.has_attribute("/", "kept_trials")  // since version 2.0
                           ? file.number_attribute("/", "kept_trials")
                           : file.number_attribute("/", "trial_column_blocks") * header.block_trials;
  header.isa = file.text_attribute("/", "isa");
  require(header.block_trials > 0, file, "its blocks have no trials");
  read_schema(file, header);
  header.axes = read_axes(file);
  header.cells = read_cells(file, header.axes);
  header.figures = read_figures(file);
  return header;
}

}  // namespace ridgeloc::results
