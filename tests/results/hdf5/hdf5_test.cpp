#include "results/hdf5/hdf5.hpp"

#include <sys/stat.h>

#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "results/hdf5/hdf5_handle.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace ridgeloc;
using namespace ridgeloc::results;
namespace fs = std::filesystem;

TEST_CASE("HDF5: datasets and attributes come back as they were written") {
  const tests::ScratchFolder folder;
  const std::vector<double> reals = {0.1, -0.0, std::numeric_limits<double>::infinity(), 5e-324, 1e308, 2.0};
  const std::vector<std::uint64_t> counts = {0, std::numeric_limits<std::uint64_t>::max()};
  const std::vector<std::int64_t> integers = {-1, std::numeric_limits<std::int64_t>::min()};
  const std::vector<std::uint32_t> bins = {7, 4294967295u};
  const std::vector<std::uint8_t> flags(100000, 3);
  const std::vector<std::string> texts = {"", "µ", "a b"};

  hdf5::File file = hdf5::File::create(folder / "a.h5");
  file.create_group("/g");
  file.write("/g/reals", reals, {2, 3});
  file.write("/g/counts", counts);
  file.write("/g/integers", integers);
  file.write("/g/bins", bins, {2}, hdf5::Layout::Compressed);
  file.write("/g/flags", flags, {1000, 100}, hdf5::Layout::Compressed);
  file.write("/g/texts", texts);
  file.write("/g/nothing", std::vector<double>{}, {0, 3}, hdf5::Layout::Compressed);
  file.write("/g/no_texts", std::vector<std::string>{});
  file.write_attribute("/", "text", std::string("σ"));
  file.write_attribute("/g", "texts", texts);
  file.write_attribute("/g", "no_texts", std::vector<std::string>{});
  file.write_attribute("/g/reals", "number", counts[1]);
  file.write_attribute("/g", "numbers", counts);
  file.write_attribute("/g", "real", 0.1);
  const std::string digest = file.written_digest();
  file.close();

  const hdf5::File read = hdf5::File::open(folder / "a.h5");
  CHECK(read.read<double>("/g/reals") == reals);
  CHECK(std::signbit(read.read<double>("/g/reals")[1]));
  CHECK(read.shape("/g/reals") == hdf5::Shape{2, 3});
  CHECK(read.read<std::uint64_t>("/g/counts") == counts);
  CHECK(read.read<std::int64_t>("/g/integers") == integers);
  CHECK(read.read<std::uint32_t>("/g/bins") == bins);
  CHECK(read.read<std::uint8_t>("/g/flags") == flags);
  CHECK(read.read<std::uint64_t>("/g/counts", 1, 1) == std::vector<std::uint64_t>{counts[1]});
  CHECK(read.read_text("/g/texts") == texts);
  CHECK(read.read<double>("/g/nothing").empty());
  CHECK(read.read_text("/g/no_texts").empty());
  CHECK(read.text_attribute("/", "text") == "σ");
  CHECK(read.texts_attribute("/g", "texts") == texts);
  CHECK(read.texts_attribute("/g", "no_texts").empty());
  CHECK(read.number_attribute("/g/reals", "number") == counts[1]);
  CHECK(read.numbers_attribute("/g", "numbers") == counts);
  CHECK(read.contains("/g/reals"));
  CHECK_FALSE(read.contains("/g/other"));
  CHECK_FALSE(read.contains("/h/reals"));
  CHECK(read.real_attribute("/g", "real") == 0.1);
  CHECK(read.attribute_names("/g") == std::vector<std::string>{"no_texts", "numbers", "real", "texts"});
  CHECK_FALSE(read.has_attribute("/g", "text"));
  CHECK(read.content_digest() == digest);
  CHECK(fs::file_size(folder / "a.h5") < flags.size());
}

TEST_CASE("HDF5: the digest sees names, types, shapes and values, and not provenance or attributes") {
  const tests::ScratchFolder folder;
  const auto digest_of = [&](auto&& fill) {
    hdf5::File file = hdf5::File::create(folder / "d.h5");
    fill(file);
    return file.written_digest();
  };
  using Reals = std::vector<double>;
  const std::string reference = digest_of([](hdf5::File& f) { f.write("/a", Reals{1, 2}); });
  CHECK(digest_of([](hdf5::File& f) { f.write("/b", Reals{1, 2}); }) != reference);
  CHECK(digest_of([](hdf5::File& f) { f.write("/a", Reals{1, 3}); }) != reference);
  CHECK(digest_of([](hdf5::File& f) { f.write("/a", Reals{1, 2}, {2, 1}); }) != reference);
  CHECK(digest_of([](hdf5::File& f) { f.write("/a", std::vector<std::int64_t>{1, 2}); }) != reference);
  CHECK(digest_of([](hdf5::File& f) {
          f.create_group("/provenance");
          f.write("/provenance/x", Reals{1});
          f.write_attribute("/", "x", 1.0);
          f.write("/a", Reals{1, 2}, {2}, hdf5::Layout::Compressed);
        }) == reference);
}

TEST_CASE("HDF5: failures are one line that names the file and the object") {
  const tests::ScratchFolder folder;
  const auto lacking = [](auto&& action, const std::string& object) {
    return tests::lacking(tests::message_of(action), {object, "a.h5"});
  };
  CHECK(lacking([&] { hdf5::File::open(folder / "a.h5"); }, "the file") == "");
  hdf5::File file = hdf5::File::create(folder / "a.h5");
  file.write("/reals", std::vector<double>{1, 2});
  file.write("/texts", std::vector<std::string>{"a"});
  file.write_attribute("/", "text", std::string("t"));
  CHECK(lacking([&] { file.write("/reals", std::vector<double>{1}); }, "/reals") == "");
  CHECK(lacking([&] { file.write("/no/such", std::vector<double>{1}); }, "/no/such") == "");
  CHECK(lacking([&] { file.read<double>("/missing"); }, "/missing") == "");
  CHECK(lacking([&] { file.read<std::uint64_t>("/reals"); }, "another type") == "");
  CHECK(lacking([&] { file.read_text("/reals"); }, "not text") == "");
  CHECK(lacking([&] { file.read<double>("/reals", 1, 2); }, "/reals") == "");
  CHECK(lacking([&] { file.read<double>("/reals", 3, 0); }, "/reals") == "");
  CHECK(lacking([&] { file.number_attribute("/", "text"); }, "the attribute text of /") == "");
  CHECK(lacking([&] { file.real_attribute("/", "text"); }, "the attribute text of /") == "");
  CHECK(lacking([&] { file.attribute_names("/missing"); }, "the attributes of /missing") == "");
  CHECK(lacking([&] { file.text_attribute("/", "missing"); }, "the attribute missing of /") == "");
  CHECK_THROWS_AS(file.create_group("/reals"), core::IoError);
}

TEST_CASE("an extent that no stored bytes can fill is refused before memory is asked for") {
  const tests::ScratchFolder folder;
  const fs::path path = folder / "a.h5";
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hsize_t extent = hsize_t{1} << 40;
  const hid_t space = H5Screate_simple(1, &extent, nullptr);
  const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
  SECTION("chunks that were never written") {
    const hsize_t chunk = 1024;
    H5Pset_chunk(properties, 1, &chunk);
    H5Pset_deflate(properties, 1);
  }
  SECTION("a contiguous dataset that was never written") {}
  H5Dclose(H5Dcreate2(file, "x", H5T_STD_U64LE, space, H5P_DEFAULT, properties, H5P_DEFAULT));
  H5Pclose(properties);
  H5Sclose(space);
  H5Fclose(file);
  const std::string message = tests::message_of([&] { hdf5::File::open(path).read<std::uint64_t>("/x"); });
  CHECK(tests::lacking(message, {"cannot read /x", "the file is too small for its size"}) == "");
}

namespace {

/// A file with a dataset /g/x, changed by `change`, which is given its identifier.
template <class Change>
fs::path changed_file(const fs::path& path, Change&& change) {
  hdf5::File file = hdf5::File::create(path);
  file.create_group("/g");
  file.write("/g/x", std::vector<double>{1.0, 2.0});
  file.close();
  const hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  change(id);
  H5Fclose(id);
  return path;
}

/// Replaces /g/x by a dataset whose values lie elsewhere.
template <class Layout>
void replace_values(hid_t file, Layout&& layout) {
  const hsize_t extent = 2;
  const hid_t space = H5Screate_simple(1, &extent, nullptr);
  const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
  layout(properties, space);
  H5Ldelete(file, "/g/x", H5P_DEFAULT);
  H5Dclose(H5Dcreate2(file, "/g/x", H5T_IEEE_F64LE, space, H5P_DEFAULT, properties, H5P_DEFAULT));
  H5Pclose(properties);
  H5Sclose(space);
}

}  // namespace

TEST_CASE("HDF5: nothing is read from another file, and a pipe behind a link holds nobody up") {
  const tests::ScratchFolder folder;
  const fs::path pipe = folder / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  const fs::path path = folder / "a.h5";
  std::string object = "/g/x";
  SECTION("an external link instead of a dataset") {
    changed_file(path, [&](hid_t file) {
      H5Ldelete(file, "/g/x", H5P_DEFAULT);
      H5Lcreate_external(pipe.c_str(), "/x", file, "/g/x", H5P_DEFAULT, H5P_DEFAULT);
    });
  }
  SECTION("an external link instead of a group") {
    object = "/g";
    changed_file(path, [&](hid_t file) {
      H5Ldelete(file, "/g", H5P_DEFAULT);
      H5Lcreate_external(pipe.c_str(), "/", file, "/g", H5P_DEFAULT, H5P_DEFAULT);
    });
    const hdf5::File file = hdf5::File::open(path);
    CHECK(tests::lacking(tests::refusal_of([&] { static_cast<void>(file.contains("/g/x")); }), {object}) == "");
    CHECK(tests::lacking(tests::refusal_of([&] { file.content_digest(); }), {object}) == "");
    CHECK(tests::lacking(tests::refusal_of([&] { file.attribute_names("/g"); }), {object}) == "");
    CHECK(tests::lacking(tests::refusal_of([&] { file.text_attribute("/g", "a"); }), {object}) == "");
  }
  SECTION("external storage") {
    changed_file(path, [&](hid_t file) {
      replace_values(file, [&](hid_t properties, hid_t) { H5Pset_external(properties, pipe.c_str(), 0, 16); });
    });
    CHECK(tests::lacking(tests::refusal_of([&] { hdf5::File::open(path).content_digest(); }), {object}) == "");
  }
  SECTION("a virtual dataset") {
    changed_file(path, [&](hid_t file) {
      replace_values(
          file, [&](hid_t properties, hid_t space) { H5Pset_virtual(properties, space, pipe.c_str(), "/x", space); });
    });
    CHECK(tests::lacking(tests::refusal_of([&] { hdf5::File::open(path).content_digest(); }), {object}) == "");
  }
  const std::string message = tests::refusal_of([&] { hdf5::File::open(path).read<double>("/g/x"); });
  CHECK(tests::lacking(message, {path.string() + ": " + object + " is a link or lies in another file"}) == "");
}
