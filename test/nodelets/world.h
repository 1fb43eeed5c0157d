// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/common/box2.h"
#include "datmo_fusion/common/stamp.h"

namespace datmo {

/// The beams of a planar scanner that turns counterclockwise.
struct Sweep {
  double first_bearing = 0.0;  ///< deg
  double beam_spacing = 0.0;   ///< deg
  int beams = 0;
  double beam_time = 0.0;  ///< s, from beam to beam
};

/// A street with a wall on each side and pillars along them. The car drives along the x axis at 5
/// m/s; 15 m ahead of it another car drives at the same speed, and drifts from left to right at 4
/// m/s. Times count from the start of the drive.
class World {
 public:
  /// Stamp of the start, s, unless it is another one.
  static constexpr double kStart = 1000.0;

  /// Short: the street ends after 160 m, and the other car leaves it to the right. Endless: the
  /// street continues, and the other car swings from side to side.
  enum class Length { kShort, kEndless };

  explicit World(Length length = Length::kShort, double start = kStart)
      : length_(length), start_(start) {}

  /// Returns the stamp of the start, s.
  double start() const { return start_; }

  Pose2 baseInMap(double seconds) const;
  Box2 otherCar(double seconds) const;

  sensor_msgs::LaserScan scan(double seconds) const;

  /// Returns what the scanner measures from this time on, m; infinite: nothing.
  std::vector<float> ranges(double seconds, const Sweep& sweep) const;

  nav_msgs::Odometry odometry(double seconds) const;
  geometry_msgs::TransformStamped baseInOdom(double seconds) const;
  geometry_msgs::TransformStamped scannerInBase() const;

  /// Only every few pixels of the camera have a point.
  static constexpr int kPixelStep = 3;

  /// What a stereo camera sees of it: the road, and all objects on it, 2 m high.
  sensor_msgs::PointCloud2 cloud(double seconds, int pixel_step = kPixelStep) const;
  static sensor_msgs::CameraInfo rightCameraInfo();
  geometry_msgs::TransformStamped cameraInBase() const;

 private:
  Stamp stampAt(double seconds) const { return Stamp::fromSeconds(start_ + seconds); }
  std::vector<Box2> thingsAt(double seconds) const;
  double rangeAlong(const Pose2& scanner, double bearing, const std::vector<Box2>& boxes) const;

  Length length_;
  double start_;
};

}  // namespace datmo
