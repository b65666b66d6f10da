#include "results/util/folder_lock.hpp"

#include <atomic>
#include <chrono>
#include <fstream>
#include <memory>
#include <thread>

#include "core/error.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace ridgeloc;
using namespace ridgeloc::results;
namespace fs = std::filesystem;

TEST_CASE("a folder is locked by one holder at a time") {
  const tests::ScratchFolder folder;
  {
    const FolderLock lock(folder.path());
    CHECK_THROWS_AS(FolderLock(folder.path()), core::InputError);
  }
  CHECK(fs::is_empty(folder.path()));
  const FolderLock again(folder.path());
  CHECK(again.failure().empty());
  CHECK_NOTHROW(again.require_alone());
}

TEST_CASE("who asks for a lock gets it from a holder that is ending") {
  const tests::ScratchFolder folder;
  auto held = std::make_unique<FolderLock>(folder.path());
  std::atomic<bool> asked{false};
  std::jthread ending([&] {
    asked.wait(false);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    held.reset();
  });
  asked = true;
  asked.notify_one();
  CHECK_NOTHROW(FolderLock(folder.path()));
}

TEST_CASE("a lock that its holder has removed is not taken for one that is free") {
  const tests::ScratchFolder folder;
  auto first = std::make_unique<FolderLock>(folder.path());
  fs::remove(folder / "lock");
  const FolderLock second(folder.path());
  // The first knows that what is there now is not its own.
  first.reset();
  CHECK(fs::exists(folder / "lock"));
  CHECK_THROWS_AS(FolderLock(folder.path()), core::InputError);
}

TEST_CASE("a folder that its last holder has removed is made anew") {
  const tests::ScratchFolder folder;
  const FolderLock lock(folder / "parts");
  CHECK(fs::exists(folder / "parts"));
}

TEST_CASE("a lock that is a link, or no file, is not followed") {
  const tests::ScratchFolder folder;
  fs::create_symlink(folder / "elsewhere", folder / "lock");
  CHECK_THROWS_AS(FolderLock(folder.path()), core::IoError);
  CHECK_FALSE(fs::exists(folder / "elsewhere"));
  fs::remove(folder / "lock");
  fs::create_directory(folder / "lock");
  CHECK_THROWS_AS(FolderLock(folder.path()), core::IoError);
}
