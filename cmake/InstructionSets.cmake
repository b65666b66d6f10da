# Which instruction sets kernels are compiled for, RIDGELOC_ISA: "all" that the architecture has, "native", the widest that
# this processor has, or a list. A program serves the baseline in any case: without kernels of its own by the double
# path, one trial at a time, to the same bits.
#
# Sets RIDGELOC_ISAS, and RIDGELOC_ISA_DEFINITIONS for what includes core/isa.hpp.
set(RIDGELOC_ISA all CACHE STRING "Instruction sets of the kernels: all, native, or a list of baseline, avx2, avx512")

set(available baseline)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  list(APPEND available avx2 avx512)
endif()

if(RIDGELOC_ISA STREQUAL "all")
  set(RIDGELOC_ISAS ${available})
elseif(RIDGELOC_ISA STREQUAL "native")
  set(RIDGELOC_ISAS baseline)
  if("avx2" IN_LIST available AND NOT DEFINED RIDGELOC_NATIVE_ISA)
    set(probe ${CMAKE_BINARY_DIR}/native_isa.cpp)
    file(WRITE ${probe} "#include <cstdio>\n#include \"core/isa.hpp\"\n"
      "int main() { std::puts(ridgeloc::core::name_of(ridgeloc::core::best_isa()).data()); }\n")
    try_run(status compiled SOURCES ${probe} ${PROJECT_SOURCE_DIR}/core/isa.cpp
      COMPILE_DEFINITIONS -I${PROJECT_SOURCE_DIR} -DRIDGELOC_AVX2=1 -DRIDGELOC_AVX512=1
      CXX_STANDARD 20 COMPILE_OUTPUT_VARIABLE errors RUN_OUTPUT_VARIABLE native)
    if(NOT compiled OR NOT status EQUAL 0)
      message(FATAL_ERROR "RIDGELOC_ISA=native: cannot ask this processor; give a list instead\n${errors}")
    endif()
    string(STRIP "${native}" native)
    set(RIDGELOC_NATIVE_ISA ${native} CACHE INTERNAL "The widest instruction set of this processor")
  endif()
  if(DEFINED RIDGELOC_NATIVE_ISA)
    set(RIDGELOC_ISAS ${RIDGELOC_NATIVE_ISA})
  endif()
else()
  foreach(isa IN LISTS RIDGELOC_ISA)
    if(NOT isa IN_LIST available)
      message(FATAL_ERROR "RIDGELOC_ISA: no instruction set \"${isa}\"; give all, native, or a list of ${available}")
    endif()
  endforeach()
  set(RIDGELOC_ISAS ${RIDGELOC_ISA})
endif()

set(RIDGELOC_ISA_DEFINITIONS "")
foreach(isa IN LISTS RIDGELOC_ISAS)
  string(TOUPPER ${isa} name)
  list(APPEND RIDGELOC_ISA_DEFINITIONS RIDGELOC_${name}=1)
endforeach()
message(STATUS "kernels for: ${RIDGELOC_ISAS}")
