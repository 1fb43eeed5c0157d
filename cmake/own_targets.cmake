# SPDX-License-Identifier: BSD-3-Clause
# How the targets of this package are compiled: with warnings, and the files of a folder together.

# CI turns warnings into errors; a user's newer compiler must not break the build.
option(DATMO_FUSION_WERROR "treat warnings in this package as errors" OFF)

# What most of the compiler's time goes into, headers and the templates of Eigen, is done once for the
# files of a folder that are compiled together. scripts/build and scripts/test ask for it (CMake 3.18 and
# later); whoever edits one file again and again leaves it out: DATMO_FUSION_UNITY=OFF. No two files of a
# folder may then give a name in an unnamed namespace to different things.
option(DATMO_FUSION_UNITY "compile the files of a folder together" OFF)

# Files that are compiled together: so few that both cores and the memory have their share.
set(DATMO_FUSION_FILES_TOGETHER 12)

# datmo_fusion_compile_as_ours(TARGET): the sources that the target has got so far.
function(datmo_fusion_compile_as_ours target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Woverloaded-virtual
    -Wcast-align -Wold-style-cast
    $<$<CXX_COMPILER_ID:GNU>:-Wduplicated-cond> $<$<CXX_COMPILER_ID:GNU>:-Wlogical-op> -Wnull-dereference
    $<$<CXX_COMPILER_ID:Clang>:-Wno-sign-conversion>) # in Clang alone it is a part of -Wconversion
  # ccache knows a precompiled header by what is in it, not by when it was compiled.
  target_compile_options(${target} PRIVATE "$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
  # Same results, faster: calls within a library need not go where a preloaded one might have put itself,
  # and nobody reads errno or the floating-point exceptions.
  target_compile_options(${target} PRIVATE
    -fno-semantic-interposition -fno-math-errno -fno-trapping-math)
  if(DATMO_FUSION_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(DATMO_FUSION_UNITY AND NOT CMAKE_VERSION VERSION_LESS 3.18)
    datmo_fusion_compile_together(${target})
  endif()
endfunction()

# datmo_fusion_compile_together(TARGET): by folder.
function(datmo_fusion_compile_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # A class of a source file may have members of its unnamed namespace; GCC takes the file for a header.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  get_target_property(sources ${target} SOURCES)
  foreach(source ${sources})
    get_filename_component(folder ${source} DIRECTORY)
    string(MAKE_C_IDENTIFIER "in_${folder}" group)
    if(NOT DEFINED ${group}_count)
      set(${group}_count 0)
    endif()
    math(EXPR batch "${${group}_count} / ${DATMO_FUSION_FILES_TOGETHER}")
    math(EXPR ${group}_count "${${group}_count} + 1")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group}_${batch})
  endforeach()
endfunction()
