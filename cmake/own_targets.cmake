# SPDX-License-Identifier: BSD-3-Clause
# What all of our own targets have in common.
# CI turns warnings into errors (DATMO_FUSION_WERROR); a user's newer compiler must not break the build.
option(DATMO_FUSION_WERROR "treat warnings in this package as errors" OFF)

# datmo_fusion_own_target(TARGET), after its sources are known
function(datmo_fusion_own_target target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Woverloaded-virtual
    -Wcast-align -Wold-style-cast -Wduplicated-cond -Wlogical-op -Wnull-dereference)
  if(DATMO_FUSION_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  datmo_fusion_compile_together(${target})
endfunction()
