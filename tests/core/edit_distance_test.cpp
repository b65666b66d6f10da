#include "core/edit_distance.hpp"

#include "tests/support/catch.hpp"

using ridgeloc::core::edit_distance;

TEST_CASE("edit distance") {
  CHECK(edit_distance("error_m", "error_m") == 0);
  CHECK(edit_distance("eror_m", "error_m") == 1);
  CHECK(edit_distance("kitten", "sitting") == 3);
  CHECK(edit_distance("", "abc") == 3);
}
