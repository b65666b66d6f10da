#pragma once

#include "studies/study/study.hpp"

namespace ridgeloc::studies {

/// Whether any cell of the study reads the setting. Needs sweep and sections.
bool is_read(const Study& study, const Setting& setting);

/// Whether the method, whose solver reads the setting, reads it in any cell: methods may choose for themselves what its
/// condition asks for.
bool is_read(const Study& study, const Method& method, const Setting& setting);

/// Whether it depends on the method if the setting is read.
bool depends_on_method(const Experiment& experiment, const Setting& setting);

/// The setting of that name. Precondition: the experiment has it.
const Setting& setting_named(const Experiment& experiment, std::string_view name);

/// The values that a setting has for a method, one of each cell that has another: its own, or the study's.
std::vector<Value> values_of(const Study& study, const Method& method, const Setting& setting);

/// The values that a setting has for a method, of those cells alone that read it as far as zipped axes tell.
std::vector<Value> values_read(const Study& study, const Method& method, const Setting& setting);

}  // namespace ridgeloc::studies
