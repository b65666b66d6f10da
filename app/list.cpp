#include <fmt/format.h>

#include <algorithm>

#include "app/exit_code.hpp"
#include "app/verbs.hpp"
#include "studies/listing.hpp"

namespace ridgeloc::app {

int list(const ListOptions& options) {
  const auto topics = options.topic.empty() ? studies::listing_topics() : std::vector<std::string>{options.topic};
  for (const std::string& topic : topics) {
    const auto entries = studies::list_topic(topic);
    std::size_t width = 0;
    for (const auto& entry : entries) width = std::max(width, entry.name.size());
    if (topics.size() > 1) fmt::print("{}\n", topic);
    for (const auto& entry : entries) {
      fmt::print("{}{:<{}}  {}\n", topics.size() > 1 ? "  " : "", entry.name, width, entry.summary);
    }
  }
  return Success;
}

}  // namespace ridgeloc::app
