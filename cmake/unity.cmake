# SPDX-License-Identifier: BSD-3-Clause
# The files of a folder compiled together: what most of the compiler's time goes into, headers and the
# templates of Eigen, is then done once for all of them. scripts/build and scripts/test ask for it (CMake
# 3.18 and later); whoever edits one file again and again leaves it out: DATMO_FUSION_UNITY=OFF. No two
# files of a folder may then give a name in an unnamed namespace to different things.
option(DATMO_FUSION_UNITY "compile the files of a folder together" OFF)

# datmo_fusion_compile_together(TARGET [MAX_FILES]): the sources that the target has got so far, by folder,
# at most MAX_FILES (12) at a time, so that both cores and the memory have their share.
function(datmo_fusion_compile_together target)
  if(NOT DATMO_FUSION_UNITY OR CMAKE_VERSION VERSION_LESS 3.18)
    return()
  endif()
  set(max_files 12)
  if(ARGC GREATER 1)
    set(max_files ${ARGV1})
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # A class of a source file may have members of its unnamed namespace; GCC takes the file for a header.
  target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  get_target_property(sources ${target} SOURCES)
  foreach(source ${sources})
    get_filename_component(folder ${source} DIRECTORY)
    string(MAKE_C_IDENTIFIER "in_${folder}" group)
    if(NOT DEFINED ${group}_count)
      set(${group}_count 0)
    endif()
    math(EXPR batch "${${group}_count} / ${max_files}")
    math(EXPR ${group}_count "${${group}_count} + 1")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group}_${batch})
  endforeach()
endfunction()
