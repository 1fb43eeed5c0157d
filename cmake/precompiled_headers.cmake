# SPDX-License-Identifier: BSD-3-Clause
# Precompiled headers: a third of the compile time was spent on the same headers again and again.
# Requires CMake 3.16; with older versions, or with -DDATMO_FUSION_PRECOMPILE=OFF, no header is
# precompiled.
option(DATMO_FUSION_PRECOMPILE "precompile headers that most files include" ON)

set(DATMO_FUSION_CORE_HEADERS
  <algorithm> <array> <cmath> <cstdint> <functional> <limits> <map> <memory> <optional> <string> <utility>
  <vector> <Eigen/Cholesky> <Eigen/Core> <Eigen/Geometry> <Eigen/LU>)
set(DATMO_FUSION_ROS_HEADERS ${DATMO_FUSION_CORE_HEADERS} <ros/time.h> <std_msgs/Header.h>)
set(DATMO_FUSION_NODELET_HEADERS ${DATMO_FUSION_ROS_HEADERS} <ros/ros.h> <nodelet/nodelet.h>)
set(DATMO_FUSION_BAG_HEADERS ${DATMO_FUSION_ROS_HEADERS} <ros/ros.h> <rosbag/bag.h> <rosbag/view.h>)
set(DATMO_FUSION_TEST_HEADERS ${DATMO_FUSION_CORE_HEADERS} <gtest/gtest.h>)

# datmo_fusion_precompile_headers(TARGET HEADER...): precompiles the headers for TARGET, except in a
# unity build of at most two batches, which gains less than the precompilation takes.
function(datmo_fusion_precompile_headers target)
  get_target_property(sources ${target} SOURCES)
  list(LENGTH sources files)
  math(EXPR few "2 * ${DATMO_FUSION_FILES_TOGETHER}")
  if(NOT DATMO_FUSION_UNITY OR files GREATER few)
    datmo_fusion_share_headers(${target} ${ARGN})
  endif()
endfunction()

# datmo_fusion_share_headers(TARGET HEADER...): precompiles the headers for TARGET regardless of its
# number of files, because other targets reuse them.
function(datmo_fusion_share_headers target)
  if(DATMO_FUSION_PRECOMPILE AND NOT CMAKE_VERSION VERSION_LESS 3.16)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()

# datmo_fusion_reuse_headers(TARGET FROM): TARGET reuses the precompiled headers of FROM, which must
# have the same compile options.
function(datmo_fusion_reuse_headers target from)
  if(DATMO_FUSION_PRECOMPILE AND NOT CMAKE_VERSION VERSION_LESS 3.16 AND NOT target STREQUAL from)
    target_precompile_headers(${target} REUSE_FROM ${from})
  endif()
endfunction()
