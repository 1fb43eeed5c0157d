# SPDX-License-Identifier: BSD-3-Clause
# catkin writes setup.* and the Python package to the prefix that is known when CMake configures. So
# that `cmake --install BUILD --prefix X` puts them into X as well, a prefix that differs is configured
# first (seconds; nothing is compiled again), and all of it is installed after that. To be included
# before anything installs. In a catkin workspace the prefix is the workspace's.
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
