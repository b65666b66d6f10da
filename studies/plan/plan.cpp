#include "studies/plan/plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "core/error.hpp"
#include "core/units.hpp"
#include "results/util/digest.hpp"
#include "studies/files/study_writer.hpp"
#include "studies/study/axis_groups.hpp"
#include "studies/study/capabilities.hpp"
#include "studies/study/comparison.hpp"
#include "studies/study/conditions.hpp"

namespace ridgeloc::studies {

namespace {

/// Digits of a cell's or method's hash: 64 bits tell a million of them apart with a chance of 3e-8 of a collision.
constexpr std::size_t short_hash_digits = 16;

std::string short_hash(const std::string& content) {
  return results::sha256_hex(content).substr(0, short_hash_digits);
}

/// The hashes of cells, which are those of the swept values.
class CellHashes {
 public:
  explicit CellHashes(const Study& study) {
    for (std::size_t a = 0; a < study.sweep.size(); ++a) {
      const SweepAxis& axis = study.sweep[a];
      // By name, so that the order of the axes does not change what a cell is.
      Lines& lines = axes_[axis.setting->name];
      lines.axis = a;
      for (const Value& value : distinct_values(axis).values) {
        lines.by_value.push_back(fmt::format("{} = {}\n", axis.setting->name, to_toml(value)));
      }
    }
  }

  std::string of(const Cell& cell) const {
    std::string content;
    for (const auto& [name, lines] : axes_) content += lines.by_value[cell.indices[lines.axis]];
    return short_hash(content);
  }

 private:
  struct Lines {
    std::size_t axis = 0;
    std::vector<std::string> by_value;
  };
  std::map<std::string, Lines> axes_;
};

/// The settings that a method's solver reads, swept ones aside, and those that what the method has chosen leaves
/// unread.
std::string method_content(const Study& study, const Method& method) {
  std::string content = fmt::format("solver = {}", method.solver);
  for (const std::string& name : settings_read_for(*study.experiment, method.solver)) {
    const Setting& setting = setting_named(*study.experiment, name);
    if (depends_on_method(*study.experiment, setting) && !is_read(study, method, setting)) continue;
    const auto given = method.given.find(name);
    const auto shared = study.fixed.find(name);
    if (given != method.given.end()) {
      content += fmt::format(", {} = {}", name, to_toml(given->second));
    } else if (shared != study.fixed.end()) {
      content += fmt::format(", {} = {}", name, to_toml(shared->second));
    }
  }
  return content;
}

/// Looks at every cell: refuses what cannot be, and notes what results and users are to know.
void describe_cells(const Study& study, Plan& plan) {
  const CellHashes hashes(study);
  Cell cell = plan.cells[0];
  plan.header.cells.reserve(plan.cells.size());
  for (std::size_t number = 0; number < plan.cells.size(); ++number) {
    plan.cells.move_to(number, cell);
    try {
      study.experiment->check(cell.values);
    } catch (const core::InputError& error) {
      throw core::InputError(fmt::format("{}: {}", study.name, error.what()));
    }
    for (std::string& remark : remarks_on(*study.experiment, cell.values)) {
      if (std::ranges::find(plan.remarks, remark) == plan.remarks.end()) plan.remarks.push_back(std::move(remark));
    }
    plan.header.cells.push_back({hashes.of(cell), cell.indices, bound_of(*study.experiment, cell.values)});
  }
}

/// Settings for all methods that have a value of their own and that nothing reads.
std::vector<std::string> remarks_on_unread(const Study& study) {
  std::vector<std::string> remarks;
  for (const Setting& setting : study.experiment->settings()) {
    const auto value = study.fixed.find(setting.name);
    if (setting.read_if.setting.empty() || value == study.fixed.end() || value->second == setting.standard) continue;
    const auto reads = [&](const Method& method) {
      const auto settings = settings_read_for(*study.experiment, method.solver);
      return std::ranges::find(settings, setting.name) != settings.end() && !method.given.contains(setting.name) &&
             is_read(study, method, setting);
    };
    const bool is_used = setting.per_method ? std::ranges::any_of(study.methods, reads) : is_read(study, setting);
    if (is_used) continue;
    remarks.push_back(fmt::format("{}.{} changes nothing: it is read only if {} is {}", setting.section, setting.name,
                                  setting.read_if.setting, fmt::join(setting.read_if.choices, " or ")));
  }
  return remarks;
}

/// All of a header but its cells.
results::Header make_header(const Study& study, std::size_t cells, core::Isa isa) {
  results::Header header;
  header.isa = core::name_of(isa);
  header.title = study.title;
  header.aims = study.aims;
  header.experiment = study.experiment->name();
  header.experiment_version = study.experiment->version();
  header.study_hash = results::sha256_hex(fmt::format("{}\n", fmt::join(study_content(study), "\n")));
  header.study_toml = resolved_toml(study);
  header.seed = study.seed;
  header.trials = study.trials;
  header.block_trials = study.experiment->block_trials();
  header.kept_trials =
      static_cast<std::uint64_t>(study.trial_columns_mib * core::mebibyte /
                                 static_cast<double>(bytes_per_trial(study)) / static_cast<double>(cells));
  header.schema = study.experiment->schema();
  for (const SweepAxis& axis : study.sweep) {
    results::Axis out{axis.setting->name, axis.setting->unit, axis.setting->description, {}};
    for (const Value& value : distinct_values(axis).values) out.values.push_back(factor_value(value));
    header.axes.push_back(std::move(out));
  }
  for (const Method& method : study.methods) {
    const std::string content = method_content(study, method);
    header.methods.push_back({method.label, short_hash(content), content});
  }
  for (const std::string& label : label_names(*study.experiment)) {
    // It may depend on settings that solvers share.
    const std::string content = method_content(study, {label, label, {}});
    header.methods.push_back({label, short_hash(content), "what does not depend on a solver"});
  }
  for (const Comparison& comparison : study.comparisons) {
    std::array<std::size_t, 2> pair{};
    for (std::size_t i = 0; i < pair.size(); ++i)
      pair[i] = static_cast<std::size_t>(std::ranges::find(study.methods, comparison[i], &Method::label) -
                                         study.methods.begin());
    const std::string content = fmt::format("{} - {}", header.methods[pair[0]].hash, header.methods[pair[1]].hash);
    header.methods.push_back({label_of(comparison), short_hash(content),
                              fmt::format("{} minus {}, trial by trial", comparison[0], comparison[1]), pair});
  }
  header.figures = study.figures;
  return header;
}

}  // namespace

std::vector<std::string> study_content(const Study& study) {
  std::vector<std::string> content = {
      fmt::format("experiment = {} version {}", study.experiment->name(), study.experiment->version()),
      fmt::format("seed = {}", study.seed), fmt::format("block = {}", study.experiment->block_trials()),
      fmt::format("audit = {}", to_toml(Value(study.audit)))};
  for (const Setting& setting : study.experiment->settings()) {
    const auto value = study.fixed.find(setting.name);
    if (setting.per_method || value == study.fixed.end()) continue;
    content.push_back(fmt::format("{} = {}", setting.name, to_toml(value->second)));
  }
  return content;
}

std::string method_hash(const Study& study, const Method& method) {
  return short_hash(method_content(study, method));
}

Plan make_plan(const Study& study, core::Isa isa) {
  refuse_too_many_cells(study);
  Plan plan;
  plan.isa = isa;
  plan.cells = CellGrid(study);
  if (plan.cells.empty()) {
    throw core::InputError(
        fmt::format("{}: sweep.exclude leaves no cell at all; remove one of its tables", study.name));
  }
  plan.remarks = remarks_on_unread(study);
  plan.header = make_header(study, plan.cells.size(), isa);
  if (plan.cells.size() * plan.header.methods.size() > max_totals) {
    throw core::InputError(
        fmt::format("{}: {} cells with {} methods and comparisons each; their product may be {} at most, so cut the "
                    "study in pieces",
                    study.name, plan.cells.size(), plan.header.methods.size(), max_totals));
  }
  describe_cells(study, plan);
  return plan;
}

std::uint64_t bytes_per_trial(const Study& study) {
  const results::Schema& schema = study.experiment->schema();
  const std::size_t absent = study.audit > 0.0 ? 0 : audit_metrics_of(*study.experiment);
  const std::uint64_t columns = (schema.metrics.size() - absent) * sizeof(double) + sizeof(std::uint8_t);
  return columns * (study.methods.size() + label_names(*study.experiment).size());
}

}  // namespace ridgeloc::studies
