// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "graph_runner.h"
#include "text_files.h"

#include <geometry_msgs/PoseWithCovarianceStamped.h>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/whole_file.h"

namespace datmo {

/// Writes the results of a drive as text, in formats of common evaluation tools. Lines end with a
/// line feed, numbers are separated by a space (MOT: a comma).
///
/// TUM (RGB-D SLAM benchmark, evo): `stamp tx ty tz qx qy qz qw`, s and m, base_link in map, one
/// line for each scan.
///
/// KITTI tracking label with score: `frame id type truncated occluded alpha left top right bottom
/// height width length x y z rotation_y score`, m and rad. The camera is at base_link and looks
/// ahead: x to the right, y down, z ahead; the location is the center of the box's bottom, on the
/// ground. Without an image truncated and occluded are -1, alpha is -10 and the rectangle -1 -1 -1
/// -1. Type: Car (vehicle), Pedestrian, Cyclist, Misc. Score: probability that it exists.
///
/// MOT Challenge: `frame,id,left,top,width,height,confidence,x,y,z`, frames from 1 on, without an
/// image -1,-1,-1,-1; x, y, z: center of the box in map, m.
///
/// A frame is a scan, counted from 0 (MOT: 1). Tracks whose scan had no pose are omitted.
class TextOutputs {
 public:
  /// Only results with a file are kept. Throws std::runtime_error that names a file that cannot be
  /// written.
  explicit TextOutputs(TextFiles files);

  /// Adds what a stage has published.
  void add(const Publication& publication);

  const std::string& tum() const { return tum_; }
  const std::string& kitti() const { return kitti_; }
  const std::string& mot() const { return mot_; }

  /// Returns the results that have a file.
  std::vector<NamedText> files() const;

 private:
  struct Frame {
    std::size_t number = 0;  ///< from 0 on
    Pose2 base_in_map;
  };

  void addPose(const geometry_msgs::PoseWithCovarianceStamped& pose);
  void addTracks(const TrackArray& tracks);

  TextFiles files_;
  std::map<ros::Time, Frame> frames_;  ///< by the scan's stamp
  std::string tum_;
  std::string kitti_;
  std::string mot_;
};

}  // namespace datmo
