# Every third-party library in one place. What each is for: docs/decisions/0001-dependencies.md.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(TBB 2021 REQUIRED CONFIG)
find_package(HDF5 1.10 REQUIRED COMPONENTS C HL)
find_package(Ceres 2.1 REQUIRED)
find_package(CLI11 REQUIRED CONFIG)
find_package(fmt REQUIRED CONFIG)
find_package(PkgConfig REQUIRED)
find_package(OpenSSL 3 REQUIRED COMPONENTS Crypto)

# toml++ as the shared library: its header-only form aborts by assert on some malformed files.
# pkg-config carries the definitions that select the shared library; the CMake package does not.
pkg_check_modules(TOMLPLUSPLUS REQUIRED IMPORTED_TARGET tomlplusplus)
pkg_check_modules(XXHASH REQUIRED IMPORTED_TARGET libxxhash)

# Most builds of xxHash for x86-64 carry versions for newer processors, behind a header of their own.
include(CheckCXXSourceCompiles)
set(CMAKE_REQUIRED_LIBRARIES PkgConfig::XXHASH)
check_cxx_source_compiles(
  "#include <xxhash.h>\n#include <xxh_x86dispatch.h>\nint main() { XXH3_64bits_update(nullptr, nullptr, 0); }"
  RIDGELOC_XXHASH_DISPATCH)
unset(CMAKE_REQUIRED_LIBRARIES)

# xsimd is headers alone; its CMake package asks for a library that its headers do not need.
find_path(XSIMD_INCLUDE_DIR xsimd/xsimd.hpp REQUIRED)
add_library(ridgeloc_xsimd INTERFACE)
target_include_directories(ridgeloc_xsimd SYSTEM INTERFACE ${XSIMD_INCLUDE_DIR})

# What we compare ourselves with.
if(RIDGELOC_BUILD_BENCHMARKS)
  find_package(benchmark 1.7 REQUIRED CONFIG)
  find_package(GSL 2.7 REQUIRED)
  pkg_check_modules(CMINPACK REQUIRED IMPORTED_TARGET cminpack)
endif()
