#include "studies/plan/plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/error.hpp"
#include "core/units.hpp"
#include "results/util/digest.hpp"
#include "studies/files/study_writer.hpp"
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

/// Groups of axes that move together: each zipped group, and every other axis for itself, by first axis.
std::vector<std::vector<std::size_t>> axis_groups(const Study& study) {
  const auto group_of = [&](const std::string& name) {
    return std::ranges::find_if(study.zip, [&](const auto& g) { return std::ranges::find(g, name) != g.end(); });
  };
  std::vector<std::vector<std::size_t>> groups;
  std::vector<const std::vector<std::string>*> zipped;
  for (std::size_t a = 0; a < study.sweep.size(); ++a) {
    const auto zip = group_of(study.sweep[a].setting->name);
    const auto known = zip == study.zip.end() ? zipped.end() : std::ranges::find(zipped, &*zip);
    if (known != zipped.end()) {
      groups[static_cast<std::size_t>(known - zipped.begin())].push_back(a);
    } else {
      groups.push_back({a});
      zipped.push_back(zip == study.zip.end() ? nullptr : &*zip);
    }
  }
  return groups;
}

/// An axis as results have it, each value once, and where the values of a zipped one stand on it, which may repeat.
struct DistinctValues {
  std::vector<Value> values;
  std::vector<std::size_t> places;  ///< per value of the study's axis
};

DistinctValues distinct_values(const SweepAxis& axis) {
  DistinctValues distinct;
  std::map<std::string, std::size_t> seen;
  for (const Value& value : axis.values) {
    const auto [place, is_new] = seen.emplace(to_toml(value), distinct.values.size());
    if (is_new) distinct.values.push_back(value);
    distinct.places.push_back(place->second);
  }
  return distinct;
}

bool excluded(const Study& study, const Values& values) {
  return std::ranges::any_of(study.exclude, [&](const Values& pattern) {
    return std::ranges::all_of(pattern, [&](const auto& item) { return values.at(item.first) == item.second; });
  });
}

std::vector<Cell> make_cells(const Study& study) {
  const auto groups = axis_groups(study);
  std::vector<std::size_t> counter(groups.size(), 0);
  std::vector<std::vector<std::size_t>> places;
  for (const SweepAxis& axis : study.sweep) places.push_back(distinct_values(axis).places);
  std::vector<Cell> cells;
  const auto size = [&](std::size_t g) { return study.sweep[groups[g].front()].values.size(); };
  for (bool more = true; more;) {
    Cell cell;
    cell.index = cells.size();
    cell.indices.resize(study.sweep.size());
    cell.values = study.fixed;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      for (const std::size_t a : groups[g]) {
        cell.indices[a] = places[a][counter[g]];
        cell.values[study.sweep[a].setting->name] = study.sweep[a].values[counter[g]];
      }
    }
    // By name, so that the order of the axes does not change what a cell is.
    std::set<std::string> content;
    for (const SweepAxis& axis : study.sweep) {
      content.insert(fmt::format("{} = {}\n", axis.setting->name, to_toml(cell.values[axis.setting->name])));
    }
    cell.hash = short_hash(fmt::format("{}", fmt::join(content, "")));
    if (!excluded(study, cell.values)) cells.push_back(std::move(cell));

    more = false;
    for (std::size_t g = groups.size(); g-- > 0 && !more;) {
      more = ++counter[g] < size(g);
      if (!more) counter[g] = 0;
    }
  }
  return cells;
}

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

results::Header make_header(const Study& study, const std::vector<Cell>& cells, core::Isa isa) {
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
                                 static_cast<double>(bytes_per_trial(study)) / static_cast<double>(cells.size()));
  header.schema = study.experiment->schema();
  for (const SweepAxis& axis : study.sweep) {
    results::Axis out{axis.setting->name, axis.setting->unit, axis.setting->description, {}};
    for (const Value& value : distinct_values(axis).values) out.values.push_back(factor_value(value));
    header.axes.push_back(std::move(out));
  }
  for (const Cell& cell : cells)
    header.cells.push_back({cell.hash, cell.indices, bound_of(*study.experiment, cell.values)});
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
  Plan plan;
  plan.isa = isa;
  plan.cells = make_cells(study);
  if (plan.cells.empty()) {
    throw core::InputError(
        fmt::format("{}: sweep.exclude leaves no cell at all; remove one of its tables", study.name));
  }
  for (std::size_t i = 0; i < plan.cells.size(); ++i) plan.cells[i].index = i;
  plan.remarks = remarks_on_unread(study);
  for (const Cell& cell : plan.cells) {
    try {
      study.experiment->check(cell.values);
      for (std::string& remark : remarks_on(*study.experiment, cell.values)) {
        if (std::ranges::find(plan.remarks, remark) == plan.remarks.end()) plan.remarks.push_back(std::move(remark));
      }
    } catch (const core::InputError& error) {
      throw core::InputError(fmt::format("{}: {}", study.name, error.what()));
    }
  }
  plan.header = make_header(study, plan.cells, isa);
  return plan;
}

std::uint64_t bytes_per_trial(const Study& study) {
  const results::Schema& schema = study.experiment->schema();
  const std::size_t absent = study.audit > 0.0 ? 0 : audit_metrics_of(*study.experiment);
  const std::uint64_t columns = (schema.metrics.size() - absent) * sizeof(double) + sizeof(std::uint8_t);
  return columns * (study.methods.size() + label_names(*study.experiment).size());
}

}  // namespace ridgeloc::studies
