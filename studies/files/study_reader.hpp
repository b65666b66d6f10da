#pragma once

#include <span>
#include <string>
#include <string_view>

#include "studies/study/study.hpp"

namespace ridgeloc::studies {

/// The text of a study file and what to call it.
struct StudySource {
  std::string name;    ///< file name without extension, or catalog name
  std::string origin;  ///< path or catalog name, as messages give it
  std::string text;
  bool may_name_files = true;  ///< false: of a study inside a result, which holds all that it needs
};

/// Finds a study: a catalog name, or else the path of a file.
/// Throws core::InputError, which names the nearest catalog entry, if there is neither.
StudySource find_study(std::string_view path_or_name);

/// Reads and validates a study. `overrides` are "key=value" pairs, "scene.depth_m=[2, 15]" or "trials=1000", applied
/// before validation; `experiments` are those that a study may be of. Throws core::InputError: one line with file,
/// line, what is wrong, what is allowed.
Study read_study(const StudySource& source, std::span<const std::string> overrides,
                 std::span<const Experiment* const> experiments);

}  // namespace ridgeloc::studies
