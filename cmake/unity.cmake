# SPDX-License-Identifier: BSD-3-Clause
# The files of a folder compiled together: most of a compiler's time goes into headers that all of them
# include. For builds of everything, as in scripts/test; who works on one file compiles it alone. CMake
# 3.18 and later.
option(DATMO_FUSION_UNITY "compile the files of a folder together" OFF)

# So many files at a time, so that there are jobs for more cores, too.
set(DATMO_FUSION_FILES_TOGETHER 10)

# datmo_fusion_compile_together(TARGET)
function(datmo_fusion_compile_together target)
  if(NOT DATMO_FUSION_UNITY OR CMAKE_VERSION VERSION_LESS 3.18)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # In a file that includes others, all classes seem to be declared in headers.
  target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    get_filename_component(folder "${source}" DIRECTORY)
    string(MAKE_C_IDENTIFIER "${target}_${folder}" group)
    list(APPEND files_${group} "${source}")
    list(LENGTH files_${group} count)
    math(EXPR batch "(${count} - 1) / ${DATMO_FUSION_FILES_TOGETHER}")
    set_source_files_properties("${source}" PROPERTIES UNITY_GROUP ${group}_${batch})
  endforeach()
endfunction()
