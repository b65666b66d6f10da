#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ridgeloc::studies {

/// A line of a listing.
struct Listed {
  std::string name;
  std::string summary;
};

/// What can be listed: "solvers", "k", "weights", "noise", "maps", "metrics", "experiments", "studies".
const std::vector<std::string>& listing_topics();

/// The entries of one topic, straight from the registries. `topic` is one of `listing_topics()`.
std::vector<Listed> list_topic(std::string_view topic);

}  // namespace ridgeloc::studies
