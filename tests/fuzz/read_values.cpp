// Results that HDF5 finds good and whose digests are right, with values and lengths that no program would write: what
// is checked is the readers' own distrust.

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "results/hdf5/hdf5.hpp"
#include "tests/fuzz/memory_file.hpp"
#include "tests/fuzz/read_everything.hpp"
#include "tests/support/sample_result.hpp"
#include "tests/support/scratch_folder.hpp"

namespace fs = std::filesystem;
using namespace ridgeloc;
using namespace ridgeloc::results;

namespace {

/// Takes the input apart; zeros when it has ended.
class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : next_(data), end_(data + size) {}

  bool has_more() const { return next_ != end_; }
  std::uint64_t number(int bytes) {
    std::uint64_t value = 0;
    for (int i = 0; i < bytes && has_more(); ++i) value = value << 8 | *next_++;
    return value;
  }
  /// One of few odd values, or any.
  std::uint64_t value() {
    constexpr std::array<std::uint64_t, 12> odd = {0,
                                                   1,
                                                   2,
                                                   63,
                                                   1922,
                                                   1ULL << 31,
                                                   1ULL << 32,
                                                   1ULL << 40,
                                                   1ULL << 62,
                                                   1ULL << 63,
                                                   0x7ff0000000000000ULL,
                                                   std::numeric_limits<std::uint64_t>::max()};
    const std::uint64_t choice = number(1);
    return choice < odd.size() ? odd[choice] : choice < 200 ? choice - odd.size() : number(8);
  }
  std::size_t below(std::size_t size) { return size == 0 ? 0 : static_cast<std::size_t>(number(2)) % size; }

 private:
  const std::uint8_t* next_;
  const std::uint8_t* end_;
};

struct Objects {
  std::vector<std::string> datasets;
  std::vector<std::pair<std::string, std::string>> attributes;
};

Objects objects_of(hid_t file) {
  Objects objects;
  const auto keep = [](hid_t root, const char* path, const H5O_info_t* info, void* target) -> herr_t {
    auto& found = *static_cast<Objects*>(target);
    if (info->type == H5O_TYPE_DATASET) found.datasets.emplace_back(path);
    struct Names {
      const char* object;
      Objects& found;
    } names{path, found};
    const auto keep_name = [](hid_t, const char* name, const H5A_info_t*, void* to) -> herr_t {
      auto& [object, list] = *static_cast<Names*>(to);
      list.attributes.emplace_back(object, name);
      return 0;
    };
    return H5Aiterate_by_name(root, path, H5_INDEX_NAME, H5_ITER_INC, nullptr, keep_name, &names, H5P_DEFAULT);
  };
  H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, keep, &objects, H5O_INFO_BASIC);
  return objects;
}

/// Replaces a dataset of numbers by one that differs in a value or in length.
void change_dataset(hid_t file, const std::string& path, Input& input) {
  const hid_t dataset = H5Dopen2(file, path.c_str(), H5P_DEFAULT);
  const hid_t type = H5Dget_type(dataset);
  const hid_t space = H5Dget_space(dataset);
  const std::size_t width = H5Tget_size(type);
  std::vector<hsize_t> extent(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, extent.data(), nullptr);
  const bool is_text = H5Tis_variable_str(type) > 0;
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)) * width);
  if (!is_text) {
    if (!bytes.empty()) H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data());
    if (input.number(1) % 8 == 0 && !extent.empty()) {
      const std::size_t row = extent[0] == 0 ? 0 : bytes.size() / extent[0];
      extent[0] = input.number(1) % 16;
      bytes.resize(extent[0] * row);
    } else if (!bytes.empty()) {
      const std::uint64_t value = input.value();
      const std::size_t place = input.below(bytes.size() / width) * width;
      for (std::size_t i = 0; i < width; ++i) bytes[place + i] = static_cast<std::uint8_t>(value >> (8 * i));
    }
    H5Ldelete(file, path.c_str(), H5P_DEFAULT);
    const hid_t changed_space = H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr);
    const hid_t changed = H5Dcreate2(file, path.c_str(), type, changed_space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    if (!bytes.empty()) H5Dwrite(changed, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data());
    H5Dclose(changed);
    H5Sclose(changed_space);
  } else if (input.number(1) % 2 == 0) {
    H5Ldelete(file, path.c_str(), H5P_DEFAULT);
  } else if (!extent.empty()) {
    std::vector<const char*> texts(bytes.size() / width, input.number(1) % 2 == 0 ? "" : "../x y\"\n");
    if (!texts.empty()) H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, texts.data());
  }
  H5Sclose(space);
  H5Tclose(type);
  H5Dclose(dataset);
}

void change_attribute(hid_t file, const std::string& object, const std::string& name, Input& input) {
  const hid_t attribute = H5Aopen_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
  const hid_t type = H5Aget_type(attribute);
  const hid_t space = H5Aget_space(attribute);
  const bool is_number = H5Tequal(type, H5T_STD_U64LE) > 0;
  if (is_number && H5Sget_simple_extent_npoints(space) == 1) {
    const std::uint64_t value = input.value();
    H5Awrite(attribute, type, &value);
  }
  H5Sclose(space);
  H5Tclose(type);
  H5Aclose(attribute);
  if (!is_number && input.number(1) % 4 == 0) H5Adelete_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT);
}

void write_text(hid_t file, const char* name, const std::string& value) {
  const hid_t attribute = H5Aopen(file, name, H5P_DEFAULT);
  if (attribute < 0) return;
  const hid_t type = H5Aget_type(attribute);
  const char* pointer = value.c_str();
  H5Awrite(attribute, type, &pointer);
  H5Tclose(type);
  H5Aclose(attribute);
}

/// The digests of the changed values, so that no reader refuses them for these.
void mend_digests(const fs::path& path) {
  std::array<std::string, 3> digests;
  {
    const hdf5::File file = hdf5::File::open(path);
    digests = {file.content_digest(), file.content_digest(hdf5::File::Extent::Totals), file.attributes_digest()};
  }
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  write_text(file, "data_sha256", digests[0]);
  write_text(file, "totals_sha256", digests[1]);
  write_text(file, "attributes_sha256", digests[2]);
  H5Fclose(file);
}

/// A small sample to start from.
std::vector<char> sample() {
  const tests::ScratchFolder folder;
  Header header = tests::sample_header();
  header.cells.resize(2);
  header.trials = header.block_trials + 2;
  tests::write_sample(folder / "sample.h5", header);
  std::ifstream file(folder / "sample.h5", std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::vector<char> whole = sample();
  static const tests::MemoryFile memory;
  memory.write(whole);
  const fs::path path = memory.path();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  if (file < 0) __builtin_trap();  // the sample itself
  Input input(data, size);
  for (int changes = 0; input.has_more() && changes < 8; ++changes) {
    const Objects objects = objects_of(file);
    if (input.number(1) % 4 == 0) {
      const auto& [object, name] = objects.attributes[input.below(objects.attributes.size())];
      change_attribute(file, object, name, input);
    } else {
      change_dataset(file, objects.datasets[input.below(objects.datasets.size())], input);
    }
  }
  H5Fclose(file);
  try {
    mend_digests(path);
  } catch (const core::IoError&) {
    return 0;
  }
  tests::read_everything(path);
  return 0;
}
