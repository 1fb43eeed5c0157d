// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "arguments.h"
#include "sensor_set.h"

#include <rosbag/bag.h>

#include "datmo_fusion/ros/stage/stage_graph.h"

namespace datmo {

/// The names that the stereo camera's messages have in the bag; empty: not read.
struct StereoTopics {
  std::string points;
  std::string velocities;  ///< points with velocity, in addition to the points; may be empty
  std::string left_image;
  std::string right_image;
  std::string left_info;
  std::string right_info;

  /// The topics that exist. Images are rectified if they are named as by image_proc: image_rect,
  /// image_rect_color.
  StereoPoints input() const;
};

/// Those of the camera whose images are used to classify objects; empty: not read.
struct MonoTopics {
  std::string image;
  std::string info;
};

/// Those of the receiver and of other stations; empty: not read.
struct V2xTopics {
  std::string gnss;
  std::string stations;
};

/// Topics of the motion inputs in the bag; empty: not read.
struct MotionTopics {
  std::string odometry;
  std::string imu;
  std::string twist;
  std::string twist_with_covariance;
  std::string joint_states;

  std::vector<std::string> all() const;
};

/// Those of what the host itself measures, for --risk; empty: not read.
struct HostTopics {
  std::string steering;
  std::string acceleration;
};

/// The names that our inputs have in the bag.
struct InputTopics {
  std::string scan;
  std::string cloud;         ///< of a 3D lidar, converted to scans; empty: there are scans
  std::string object_cloud;  ///< of a 3D lidar, to detect objects in; empty: none
  std::string echoes;
  std::map<std::string, std::string> scans;  ///< of several scanners, by topic; else there is one
  MotionTopics motion;
  StereoTopics stereo;
  MonoTopics mono;
  std::string radar;  ///< empty: not read
  V2xTopics v2x;
  HostTopics host;
  std::map<std::string, std::string> grids;    ///< of sources that no stage provides: topic ->
                                               ///< source
  std::map<std::string, std::string> objects;  ///< the same for objects
  std::map<std::string, std::string> tracks;   ///< and for tracks
  std::vector<std::string> truth;

  std::vector<std::string> all() const;
};

/// Finds the topics that the stages need. Throws std::runtime_error that names what is missing, and
/// the topics of the bag.
InputTopics findTopics(const rosbag::Bag& bag, const Arguments& arguments,
                       const SensorSet& sensors);

}  // namespace datmo
