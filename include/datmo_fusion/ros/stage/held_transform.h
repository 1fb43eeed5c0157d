// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <geometry_msgs/TransformStamped.h>

#include "datmo_fusion/common/stamp.h"

namespace datmo {

/// map -> odom while no scan comes: the last one that a scan led to, under the stamps of the
/// motion, so that what other sensors see has a position in the map by odometry alone.
class HeldTransform {
 public:
  /// What a scan has led to.
  void set(const geometry_msgs::TransformStamped& transform) { last_ = transform; }

  /// A scan has led to a pose, at this time (ROS time, not its stamp): one that is late is not
  /// silent.
  void served(Stamp now);

  /// The last one is no longer true, as when odometry begins anew.
  void drop() { last_.reset(); }

  /// At the stamp of a motion that came now; none before the first, while scans come, and when they
  /// have been silent for so long that odometry alone is not enough.
  std::optional<geometry_msgs::TransformStamped> at(Stamp stamp, Stamp now) const;

  void clear() { *this = {}; }

 private:
  std::optional<geometry_msgs::TransformStamped> last_;
  std::optional<Stamp> served_;
  double step_ = 0.0;    ///< s, between the last two scans
  double period_ = 0.0;  ///< s, from scan to scan: the shorter one of the last two steps
};

}  // namespace datmo
