# SPDX-License-Identifier: BSD-3-Clause
# How Python tests, and tests of the Python tools, find what they test.

# datmo_fusion_run_in_tree(TEST [FOLDER...]): sets the environment in which TEST finds the Python
# modules of the sources, of the built messages and of the folders, and the built programs. The
# caller may append further variables.
function(datmo_fusion_run_in_tree name)
  set(modules ${CATKIN_DEVEL_PREFIX}/lib/python3/dist-packages ${PROJECT_SOURCE_DIR}/tools ${ARGN} "$ENV{PYTHONPATH}")
  list(JOIN modules ":" modules)
  set_property(TEST ${name} APPEND PROPERTY ENVIRONMENT
    "PYTHONPATH=${modules}" "CMAKE_PREFIX_PATH=${CATKIN_DEVEL_PREFIX}:$ENV{CMAKE_PREFIX_PATH}")
endfunction()
