// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <geometry_msgs/TransformStamped.h>

#include "datmo_fusion/common/stamp.h"

namespace datmo {

/// map -> odom while scans are missing: the last one, with the stamps of the motion, so that other
/// sensors' measurements can be transformed to the map by odometry alone.
class HeldTransform {
 public:
  /// Sets the result of a scan.
  void set(const geometry_msgs::TransformStamped& transform) { last_ = transform; }

  /// Reports that a scan gave a pose at this time (ROS time, not its stamp): a late scan is not
  /// silence.
  void served(Stamp now);

  /// Invalidates the last one, as when odometry restarts.
  void drop() { last_.reset(); }

  /// Returns the transform at the stamp of a motion received now; none before the first scan, while
  /// scans are received, and when they have been silent too long for odometry alone.
  std::optional<geometry_msgs::TransformStamped> at(Stamp stamp, Stamp now) const;

  void clear() { *this = {}; }

 private:
  std::optional<geometry_msgs::TransformStamped> last_;
  std::optional<Stamp> served_;
  double step_ = 0.0;    ///< s, between the last two scans
  double period_ = 0.0;  ///< s, scan period: the shorter one of the last two steps
};

}  // namespace datmo
