#include "studies/files/study_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "core/error.hpp"
#include "core/excerpt.hpp"
#include "core/printable.hpp"
#include "results/util/file_system.hpp"
#include "studies/catalog/catalog.hpp"
#include "studies/files/sections.hpp"
#include "studies/files/text_file.hpp"
#include "studies/files/toml_document.hpp"
#include "studies/study/capabilities.hpp"
#include "studies/study/conditions.hpp"
#include "studies/study/setting_builders.hpp"

namespace ridgeloc::studies {

namespace {

const Setting& study_setting(std::string_view name) {
  constexpr double int64_limit = 9.2e18;
  const Section top("");
  const Section store("store");
  static const std::vector<Setting> settings = {
      top.integer("seed", 2018, {0, int64_limit}, "seed of all random numbers"),
      top.integer("trials", 100, {1, static_cast<double>(max_trials)}, "trials per cell"),
      top.real("audit", 1e-4, {0, 1}, "1", "share of the trials that Ceres solves again"),
      store.real("trial_columns_mib", 256, {0, 1e9}, "MiB", "per-trial columns kept of all cells together"),
  };
  return *std::ranges::find(settings, name, &Setting::name);
}

const Experiment& read_experiment(const toml::table& document, const std::string& origin,
                                  std::span<const Experiment* const> experiments) {
  std::vector<std::string> names;
  for (const Experiment* e : experiments) names.emplace_back(e->name());
  const toml::node* node = document.get("experiment");
  if (node == nullptr) {
    throw core::InputError(fmt::format("{}: the key \"experiment\" is missing; add experiment = \"{}\" (allowed: {})",
                                       origin, names.front(), fmt::join(names, ", ")));
  }
  const std::string chosen = read_text(*node, "experiment", names);
  return *experiments[static_cast<std::size_t>(std::ranges::find(names, chosen) - names.begin())];
}

std::vector<std::string> section_names(const Experiment& experiment) {
  std::vector<std::string> names;
  for (const Setting& s : experiment.settings()) {
    if (std::ranges::find(names, s.section) == names.end()) names.push_back(s.section);
  }
  return names;
}

/// Reads the sections of the experiment into `fixed`: defaults where a setting is absent, nothing where it is swept.
void read_sections(const toml::table& document, Study& study) {
  for (const std::string& section : section_names(*study.experiment)) {
    std::vector<std::string> allowed;
    for (const Setting& s : study.experiment->settings()) {
      if (s.section == section) allowed.push_back(s.name);
    }
    const toml::node* node = document.get(section);
    const toml::table* table = node == nullptr ? nullptr : &read_table(*node, fmt::format("[{}]", section));
    if (table != nullptr) check_keys(*table, fmt::format("[{}]", section), allowed);
    for (const Setting& s : study.experiment->settings()) {
      if (s.section != section) continue;
      const toml::node* value = table == nullptr ? nullptr : table->get(s.name);
      const bool swept = std::ranges::any_of(study.sweep, [&](const SweepAxis& a) { return a.setting == &s; });
      if (swept && value != nullptr) {
        fail_at(*value, fmt::format("{}.{} is swept in [sweep] too; give it in one place", section, s.name));
      }
      if (!swept) study.fixed[s.name] = value == nullptr ? s.standard : read_setting(*value, s, section + "." + s.name);
    }
  }
}

/// The share of trials that the reference solves again: none where an experiment has no reference.
double read_audit(const toml::table& document, const Experiment& experiment) {
  const toml::node* node = document.get("audit");
  const bool has_audit = audit_metrics_of(experiment) > 0;
  if (node == nullptr) return has_audit ? Study{}.audit : 0.0;
  const double audit = std::get<double>(read_setting(*node, study_setting("audit"), "audit"));
  if (audit > 0.0 && !has_audit) {
    fail_at(*node,
            fmt::format("audit = {} is not allowed: Ceres solves no trial of experiment \"{}\" again; leave it out",
                        audit, experiment.name()));
  }
  return audit;
}

/// Refuses axes that change nothing, and lists of samples that are read and not there. What methods may choose for
/// themselves is known only with them.
void check_conditions(const toml::table& document, const std::string& origin, const Study& study) {
  for (const SweepAxis& axis : study.sweep) {
    if (depends_on_method(*study.experiment, *axis.setting) || is_read(study, *axis.setting)) continue;
    const auto& [setting, choices] = axis.setting->read_if;
    fail_at(*document.get("sweep"), fmt::format("sweep.{} changes nothing: it is read only if {} is {}",
                                                axis.setting->name, setting, fmt::join(choices, " or ")));
  }
  for (const Setting& s : study.experiment->settings()) {
    if (s.kind != Kind::Samples || !is_read(study, s) || !std::get<Samples>(study.fixed.at(s.name)).values().empty()) {
      continue;
    }
    throw core::InputError(fmt::format("{}: {} = \"{}\" needs {}.{}: {}", origin, s.read_if.setting,
                                       fmt::join(s.read_if.choices, "\" or \""), s.section, s.name, accepted(s)));
  }
}

/// Refuses { file = ... } wherever it stands: whoever wrote a result does not choose what is read on this machine.
void refuse_files(const toml::node& node) {
  if (const toml::array* list = node.as_array())
    for (const toml::node& element : *list) refuse_files(element);
  const toml::table* table = node.as_table();
  if (table == nullptr) return;
  if (const toml::node* file = table->get("file"))
    fail_at(*file,
            "the study inside a result names a file, which is not read; a result holds all that its study needs");
  for (const auto& [key, value] : *table) refuse_files(value);
}

}  // namespace

StudySource find_study(std::string_view path_or_name) {
  if (const CatalogEntry* entry = find_in_catalog(path_or_name)) {
    return {std::string(entry->name), std::string(entry->name), std::string(entry->text)};
  }
  // Whatever can be read once: a script may write a study into a pipe.
  const std::filesystem::path path(path_or_name);
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (!std::filesystem::exists(status) || std::filesystem::is_directory(status)) {
    std::vector<std::string> names;
    for (const CatalogEntry& entry : catalog()) names.emplace_back(entry.name);
    throw core::InputError(fmt::format("{}: no such study file, and no study of that name in the catalog{}",
                                       core::excerpt(path_or_name), suggestion(path_or_name, names)));
  }
  if (results::begins_as_hdf5(path)) {
    throw core::InputError(fmt::format(
        "{}: is HDF5 and no study; `ridgeloc export --study` takes the study out of a result", path_or_name));
  }
  return {path.stem().string(), path.string(), read_text_file(path, most_text_mib)};
}

Study read_study(const StudySource& source, std::span<const std::string> overrides,
                 std::span<const Experiment* const> experiments) {
  const toml::table document = parse_document(source.text, source.origin, overrides);
  if (!source.may_name_files) refuse_files(document);

  Study study;
  study.name = source.name;
  study.experiment = &read_experiment(document, source.origin, experiments);

  std::vector<std::string> allowed = {"title", "aims",  "experiment", "seed",    "trials", "audit",
                                      "store", "sweep", "method",     "compare", "stop",   "figure"};
  const auto sections = section_names(*study.experiment);
  allowed.insert(allowed.end(), sections.begin(), sections.end());
  check_keys(document, "the study", allowed);

  const toml::node* title = document.get("title");
  study.title = title == nullptr ? core::printable(source.name) : read_text(*title, "title");
  if (const toml::node* aims = document.get("aims")) study.aims = read_text(*aims, "aims");
  if (const toml::node* seed = document.get("seed")) {
    study.seed = static_cast<std::uint64_t>(std::get<std::int64_t>(read_setting(*seed, study_setting("seed"), "seed")));
  }
  if (const toml::node* trials = document.get("trials")) {
    study.trials =
        static_cast<std::uint64_t>(std::get<std::int64_t>(read_setting(*trials, study_setting("trials"), "trials")));
  }
  study.audit = read_audit(document, *study.experiment);
  if (const toml::node* store = document.get("store")) {
    const toml::table& table = read_table(*store, "[store]");
    check_keys(table, "[store]", {"trial_columns_mib"});
    if (const toml::node* size = table.get("trial_columns_mib")) {
      study.trial_columns_mib =
          std::get<double>(read_setting(*size, study_setting("trial_columns_mib"), "store.trial_columns_mib"));
    }
  }
  read_sweep(document, study);
  read_sections(document, study);
  check_conditions(document, source.origin, study);
  read_methods(document, source.origin, study);
  read_comparisons(document, study);
  read_stop(document, study);
  read_figures(document, study);
  return study;
}

}  // namespace ridgeloc::studies
