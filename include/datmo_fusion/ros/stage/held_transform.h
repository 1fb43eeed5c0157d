// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <geometry_msgs/TransformStamped.h>

#include "datmo_fusion/common/stamp.h"

namespace datmo {

/// map -> odom while no scan comes: the last one that a scan led to, under the stamps of the
/// motion, so that what other sensors see has a place in the map by odometry alone.
class HeldTransform {
 public:
  void set(const geometry_msgs::TransformStamped& transform);

  /// At the stamp of a motion; none before the first, while scans come, and when they have been
  /// silent for so long that odometry tells too little.
  std::optional<geometry_msgs::TransformStamped> at(Stamp stamp) const;

  void clear() { *this = {}; }

 private:
  std::optional<geometry_msgs::TransformStamped> last_;
  double period_ = 0.0;  ///< s, from scan to scan
};

}  // namespace datmo
