// Writes the sample result that read_result_test.py reads with other libraries, and prints its digest.
#include <cstdio>

#include "results/store/result_file.hpp"
#include "tests/support/sample_result.hpp"

int main(int argc, char** argv) {
  using namespace ridgeloc;
  using namespace ridgeloc::results;
  if (argc != 2) return 2;
  tests::write_sample(argv[1], tests::sample_header());
  std::puts(data_digest(argv[1]).c_str());
}
