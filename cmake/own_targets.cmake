# SPDX-License-Identifier: BSD-3-Clause
# How the targets of this package are compiled: with warnings, and optionally as unity builds, the
# files of a folder together.

# CI turns warnings into errors; a user's newer compiler must not break the build.
option(DATMO_FUSION_WERROR "treat warnings in this package as errors" OFF)

# Most compile time is spent on headers and Eigen's templates, which are processed only once for
# files that are compiled together. scripts/build and scripts/test use this (CMake 3.18 and later);
# for repeated edits of single files DATMO_FUSION_UNITY=OFF is faster. In a unity build, no two
# files of a folder may use the same name in an unnamed namespace for different things.
option(DATMO_FUSION_UNITY "compile the files of a folder together" OFF)

# Maximum number of files that are compiled together: few enough to use both cores and to
# fit into memory.
set(DATMO_FUSION_FILES_TOGETHER 12)

# datmo_fusion_compile_as_ours(TARGET): sets the compile options of TARGET; call it after all
# sources have been added.
function(datmo_fusion_compile_as_ours target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Woverloaded-virtual
    -Wcast-align -Wold-style-cast
    $<$<CXX_COMPILER_ID:GNU>:-Wduplicated-cond> $<$<CXX_COMPILER_ID:GNU>:-Wlogical-op> -Wnull-dereference
    $<$<CXX_COMPILER_ID:Clang>:-Wno-sign-conversion>) # only in Clang part of -Wconversion
  # ccache identifies a precompiled header by its content, not by its time of compilation.
  target_compile_options(${target} PRIVATE "$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
  # Same results, faster: calls within a library need not be interposable by preloaded libraries,
  # and errno and floating-point exceptions are never read.
  target_compile_options(${target} PRIVATE
    -fno-semantic-interposition -fno-math-errno -fno-trapping-math)
  if(DATMO_FUSION_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(DATMO_FUSION_UNITY AND NOT CMAKE_VERSION VERSION_LESS 3.18)
    datmo_fusion_compile_together(${target})
  endif()
endfunction()

# datmo_fusion_compile_together(TARGET): makes a unity build of TARGET, by folder.
function(datmo_fusion_compile_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # A class in a source file may have members from an unnamed namespace; GCC warns, because it
  # considers the included source file a header.
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
