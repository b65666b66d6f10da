# ridgeloc_compile_options(TARGET): how every source of the project is compiled.
#
# Floating-point contraction is off everywhere: a fused multiply-add that the compiler chooses by itself
# would make results depend on its version and on the optimization level.
function(ridgeloc_compile_options target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor -Wold-style-cast
    -ffp-contract=off
    $<$<BOOL:${RIDGELOC_WARNINGS_AS_ERRORS}>:-Werror>)
  if(RIDGELOC_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${RIDGELOC_SANITIZE} -fno-omit-frame-pointer)
    target_link_options(${target} PRIVATE -fsanitize=${RIDGELOC_SANITIZE})
    if(RIDGELOC_SANITIZE MATCHES "undefined")
      target_compile_options(${target} PRIVATE -fno-sanitize=vptr -fno-sanitize-recover=undefined)
    endif()
  endif()
  if(RIDGELOC_COVERAGE)
    target_compile_options(${target} PRIVATE --coverage)
    target_link_options(${target} PRIVATE --coverage)
  endif()
endfunction()

# ridgeloc_configure(TARGET): what every target of the project shares.
function(ridgeloc_configure target)
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
  ridgeloc_compile_options(${target})
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
endfunction()

# ridgeloc_library(FOLDER SOURCES...): folder = target = namespace.
function(ridgeloc_library folder)
  add_library(ridgeloc_${folder} STATIC ${ARGN})
  add_library(ridgeloc::${folder} ALIAS ridgeloc_${folder})
  ridgeloc_configure(ridgeloc_${folder})
endfunction()

# ridgeloc_group_by_folder(TARGET): with CMAKE_UNITY_BUILD the sources that a folder gives to TARGET are compiled as one,
# which takes a fraction of the time.
function(ridgeloc_group_by_folder target)
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source)
    cmake_path(GET source PARENT_PATH folder)
    cmake_path(GET folder FILENAME group)
    set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${group})
  endforeach()
endfunction()

# How kernels are compiled for sanitizers. Their functions are so large that checks keep an optimizing compiler busy for
# many minutes; those for undefined behaviour, one in each operation, without optimization too.
set(RIDGELOC_SANITIZED_KERNEL_OPTIONS -O0 -fno-sanitize=undefined)

# ridgeloc_simd_kernels(TARGET SOURCE): compiles SOURCE into TARGET once per instruction set of RIDGELOC_ISAS. Such a source
# instantiates kernels over the packs of core/pack.hpp and nothing else: what it shared with ordinary code would run
# instructions that the processor may not have. Optimized in every build type, so that all of it is inlined; less where the
# time to compile counts more.
function(ridgeloc_simd_kernels target source)
  # The architecture first, so that flags which a user gives for the whole build do not change what a baseline is.
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    set(flags_baseline -march=x86-64)
  endif()
  set(flags_avx2 ${flags_baseline} -mavx2 -mfma -mbmi2)
  set(flags_avx512 ${flags_avx2} -mavx512f -mavx512cd -mavx512bw -mavx512dq -mavx512vl)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Left to itself GCC copies packs in pieces of 16 bytes, and a load that spans two pieces waits for both stores.
    list(APPEND flags_avx2 -mmove-max=256 -mstore-max=256)
    # GCC 12 takes the deliberately undefined operands of its own AVX-512 intrinsics for mistakes (GCC bug 105593).
    list(APPEND flags_avx512 -Wno-uninitialized -Wno-maybe-uninitialized)
    list(APPEND flags_avx512 -mmove-max=512 -mstore-max=512 -mprefer-vector-width=512 -fschedule-insns -fsched-pressure)
  endif()
  set(optimization -O3)
  if(RIDGELOC_SANITIZE)
    set(optimization ${RIDGELOC_SANITIZED_KERNEL_OPTIONS})
  elseif(NOT RIDGELOC_SPECIALIZED_KERNELS)
    set(optimization -O1)
  endif()
  foreach(isa IN LISTS RIDGELOC_ISAS)
    set(objects ${target}_${isa})
    add_library(${objects} OBJECT ${source})
    target_include_directories(${objects} PRIVATE $<TARGET_PROPERTY:${target},INCLUDE_DIRECTORIES>)
    target_compile_definitions(${objects} PRIVATE $<TARGET_PROPERTY:${target},COMPILE_DEFINITIONS>)
    ridgeloc_configure(${objects})
    target_link_libraries(${objects} PRIVATE ridgeloc::core)
    target_compile_options(${objects} PRIVATE ${optimization} ${flags_${isa}})
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${objects}>)
    set_property(GLOBAL APPEND PROPERTY RIDGELOC_SIMD_OBJECTS $<TARGET_OBJECTS:${objects}>)
  endforeach()
endfunction()
