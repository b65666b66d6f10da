# ridgeloc_configure(TARGET): what every target of the project shares.
#
# Floating-point contraction is off everywhere: a fused multiply-add that the compiler chooses by itself
# would make results depend on its version and on the optimization level.
function(ridgeloc_configure target)
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
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

# ridgeloc_library(FOLDER SOURCES...): folder = target = namespace.
function(ridgeloc_library folder)
  add_library(ridgeloc_${folder} STATIC ${ARGN})
  add_library(ridgeloc::${folder} ALIAS ridgeloc_${folder})
  ridgeloc_configure(ridgeloc_${folder})
endfunction()
