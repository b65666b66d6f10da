#pragma once

#include <span>
#include <string>
#include <string_view>

#include "studies/files/study_reader.hpp"
#include "studies/study/experiment.hpp"

namespace ridgeloc::studies {

/// All experiments, in the order in which `list` shows them.
std::span<const Experiment* const> experiment_registry();

/// Adds an experiment, which must live as long as the program. Not to be called while another thread reads the
/// registry. Throws std::invalid_argument where one of that name is there.
void add_experiment(const Experiment& experiment);

/// The experiment of that name, or null.
const Experiment* find_experiment(std::string_view name);

/// Reads a study of any of them: see the function of the same name that is told the experiments.
Study read_study(const StudySource& source, std::span<const std::string> overrides = {});

}  // namespace ridgeloc::studies
