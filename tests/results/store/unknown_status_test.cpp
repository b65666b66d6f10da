#include <hdf5.h>

#include <string>
#include <vector>

#include "core/error.hpp"
#include "results/hdf5/hdf5.hpp"
#include "results/store/result_file.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"
#include "tests/support/sample_result.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace ridgeloc;
using namespace ridgeloc::results;
using namespace ridgeloc::tests;

namespace {

/// Changes the first status of the first method with kept trials to one that there is not, with a right digest.
void write_unknown_status(const std::filesystem::path& path, const Header& header) {
  const std::string name = "/trials/0/" + header.methods[0].label + "/status";
  auto status = hdf5::File::open(path).read<std::uint8_t>(name);
  status.front() = 200;
  hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t dataset = H5Dopen2(file, name.c_str(), H5P_DEFAULT);
  H5Dwrite(dataset, H5T_STD_U8LE, H5S_ALL, H5S_ALL, H5P_DEFAULT, status.data());
  H5Dclose(dataset);
  H5Fclose(file);
  const std::string digest = hdf5::File::open(path).content_digest();
  const char* text = digest.c_str();
  file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t attribute = H5Aopen(file, "data_sha256", H5P_DEFAULT);
  const hid_t type = H5Aget_type(attribute);
  H5Awrite(attribute, type, &text);
  H5Tclose(type);
  H5Aclose(attribute);
  H5Fclose(file);
}

}  // namespace

TEST_CASE("kept trials with a status that the result does not name are damage, with a right digest too") {
  const ScratchFolder folder;
  const Header header = sample_header();
  write_sample(folder / "r.h5", header);
  CHECK_NOTHROW(read_all_trials(folder / "r.h5"));
  write_unknown_status(folder / "r.h5", header);
  CHECK_NOTHROW(data_digest(folder / "r.h5"));
  const std::vector<std::string> phrases = {"truncated or damaged", "a status that the result does not name"};
  CHECK(lacking(refusal_of([&] { read_trials(folder / "r.h5", 0, 0); }), phrases) == "");
  CHECK(lacking(refusal_of([&] { read_all_trials(folder / "r.h5"); }), phrases) == "");
}
