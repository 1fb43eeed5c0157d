# SPDX-License-Identifier: BSD-3-Clause
# catkin writes setup.* and the Python package for the prefix that is known at configuration time.
# So that `cmake --install BUILD --prefix X` installs them to X as well, a different prefix is
# configured first (takes seconds; nothing is recompiled), and then everything is installed. Include
# this file before any install command. In a catkin workspace the workspace determines the prefix.
if(CMAKE_SOURCE_DIR STREQUAL PROJECT_SOURCE_DIR)
  install(CODE "
    get_filename_component(prefix \"\${CMAKE_INSTALL_PREFIX}\" ABSOLUTE)
    if(NOT prefix STREQUAL \"${CMAKE_INSTALL_PREFIX}\")
      execute_process(
        COMMAND \"${CMAKE_COMMAND}\" \"-DCMAKE_INSTALL_PREFIX=\${prefix}\" \"${CMAKE_BINARY_DIR}\"
        RESULT_VARIABLE code OUTPUT_QUIET)
      if(NOT code EQUAL 0)
        message(FATAL_ERROR \"configuring ${CMAKE_BINARY_DIR} for the prefix \${prefix} failed: \${code}\")
      endif()
      include(\"${CMAKE_BINARY_DIR}/cmake_install.cmake\")
      return()
    endif()")
endif()
