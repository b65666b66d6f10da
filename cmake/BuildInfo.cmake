# Commit, compiler, flags and library versions, compiled into results as provenance. This file is both included, to
# set the build step up, and run by that step at every build, so that a result never names a commit that is not the one
# it was built from.
if(CMAKE_SCRIPT_MODE_FILE)
  execute_process(COMMAND git -C ${SOURCE_DIR} rev-parse HEAD
    OUTPUT_VARIABLE RIDGELOC_COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  execute_process(COMMAND git -C ${SOURCE_DIR} status --porcelain
    OUTPUT_VARIABLE changes OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(failed)
    set(RIDGELOC_COMMIT "unknown")
  endif()
  set(RIDGELOC_DIRTY false)
  if(changes)
    set(RIDGELOC_DIRTY true)
  endif()
  configure_file(${TEMPLATE} ${OUTPUT} @ONLY)
  return()
endif()

function(ridgeloc_build_info output)
  string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
  string(STRIP "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type}} -ffp-contract=off" flags)
  add_custom_target(ridgeloc_build_info
    COMMAND ${CMAKE_COMMAND}
      -DSOURCE_DIR=${PROJECT_SOURCE_DIR}
      -DTEMPLATE=${PROJECT_SOURCE_DIR}/app/build_info.cpp.in
      -DOUTPUT=${output}
      -DPROJECT_VERSION=${PROJECT_VERSION}
      "-DRIDGELOC_COMPILER=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}"
      "-DRIDGELOC_FLAGS=${flags}"
      -DEigen3_VERSION=${Eigen3_VERSION}
      -DCeres_VERSION=${Ceres_VERSION}
      -DTBB_VERSION=${TBB_VERSION}
      -Dfmt_VERSION=${fmt_VERSION}
      -DTOMLPLUSPLUS_VERSION=${TOMLPLUSPLUS_VERSION}
      -DOPENSSL_VERSION=${OPENSSL_VERSION}
      -DXXHASH_VERSION=${XXHASH_VERSION}
      -P ${PROJECT_SOURCE_DIR}/cmake/BuildInfo.cmake
    BYPRODUCTS ${output}
    COMMENT "Commit and build settings"
    VERBATIM)
endfunction()
