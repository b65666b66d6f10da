#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "core/isa.hpp"
#include "results/blocks/block.hpp"
#include "results/tables/data_table.hpp"
#include "studies/building/building_trials.hpp"
#include "studies/files/study_reader.hpp"
#include "studies/plan/plan.hpp"
#include "studies/registry.hpp"
#include "studies/solving/solver_settings.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"
#include "tests/support/metric_of.hpp"
#include "tests/support/simulation.hpp"

namespace ridgeloc::tests {

/// A study of photos: `text` is what follows the line of the experiment.
inline studies::Study photo_study(const std::string& experiment, const std::string& text) {
  return studies::read_study({"photos", "photos.toml", "experiment = \"" + experiment + "\"\n" + text});
}

/// What trials of a study's first cell report, by method; the experiment's own label is the last.
inline std::vector<results::TrialColumns> columns_of(const studies::Study& study, studies::TrialRange range,
                                                     core::Isa isa = core::best_isa()) {
  const studies::Plan plan = studies::make_plan(study, isa);
  results::BlockSink sink(plan.header, 0, 0, range.count);
  tests::PreparedCell(study, plan.cells[0], isa).run(range, sink);
  return sink.take_columns();
}

/// What is said to a study whose trials cannot be simulated; empty if they can.
inline std::string error_of_block(const studies::Study& study) {
  return refusal_of([&] { columns_of(study, {0, 1}); });
}

inline studies::Replay replay_of(const studies::Study& study, std::uint64_t trial) {
  const studies::Plan plan = studies::make_plan(study, core::best_isa());
  return tests::PreparedCell(study, plan.cells[0], core::best_isa()).replay(trial);
}

/// Simulated trials of a `building` study's first cell, ready to be solved.
struct Photos {
  Photos(const studies::Study& study, studies::TrialRange range)
      : plan(studies::make_plan(study, core::best_isa())), scene(study.seed, plan.cells[0]), scratch(core::best_isa()) {
    REQUIRE(simulate_building(scene, range, studies::NoMonitor(), scratch));
  }

  void locate(const studies::Method& method) {
    REQUIRE(studies::locate(*scene.settings.photo.map, method, solver_options(plan.cells[0].values, method.given),
                            studies::NoMonitor(), scratch));
  }

  studies::Plan plan;
  studies::BuildingScene scene;
  studies::BuildingScratch scratch;
};

inline const results::DataTable& table_of(const std::vector<results::DataTable>& tables, const std::string& name) {
  const auto found = std::ranges::find(tables, name, &results::DataTable::name);
  REQUIRE(found != tables.end());
  return *found;
}

inline const results::Field& field_of(const results::DataTable& table, std::size_t row, const std::string& column) {
  const auto found = std::ranges::find(table.columns, column);
  REQUIRE(found != table.columns.end());
  return table.rows.at(row).at(static_cast<std::size_t>(found - table.columns.begin()));
}

inline double real_of(const results::DataTable& table, std::size_t row, const std::string& column) {
  return std::get<double>(field_of(table, row, column));
}

inline std::size_t count_of(const results::DataTable& table, std::size_t row, const std::string& column) {
  return static_cast<std::size_t>(std::get<std::int64_t>(field_of(table, row, column)));
}

inline std::string text_of(const results::DataTable& table, std::size_t row, const std::string& column) {
  return std::get<std::string>(field_of(table, row, column));
}

}  // namespace ridgeloc::tests
