#pragma once

#include <string>

namespace ridgeloc::studies {

/// What the columns of measured data are called.
struct DataColumns {
  std::string epoch = "epoch";
  std::string object = "object";
  std::string range = "range_m";
  std::string score = "score";
  std::string x = "x_m";
  std::string y = "y_m";
  std::string z = "z_m";
};

}  // namespace ridgeloc::studies
