# SPDX-License-Identifier: BSD-3-Clause
# Warnings of our own targets. CI turns them into errors (DATMO_FUSION_WERROR); a user's newer
# compiler must not break the build.
option(DATMO_FUSION_WERROR "treat warnings in this package as errors" OFF)

function(datmo_fusion_set_warnings target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Woverloaded-virtual
    -Wcast-align -Wold-style-cast -Wduplicated-cond -Wlogical-op -Wnull-dereference)
  if(DATMO_FUSION_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()
