#pragma once

#include <deque>
#include <optional>
#include <string>

#include <std_msgs/Header.h>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/ros/messages.h"

namespace datmo {

/// Where the vehicle was at its last scans, as the SLAM found out.
///
/// tf says the same, but only when the odometry that follows the scan has come: up to one of its
/// periods later, which is longer than all stages need for the scan.
class ScanPoses {
 public:
  /// Takes the pose of a split scan; an older one than the newest begins anew (a looped bag).
  /// Throws InputError (`bad_pose`).
  void add(const SplitScanMessage& scan);

  /// Pose of the vehicle's frame in another one, at exactly the stamp of the header, which also
  /// names the vehicle's frame; none if no split scan said so.
  std::optional<Pose2> find(const std_msgs::Header& base, const std::string& fixed_frame) const;

 private:
  struct ScanPose {
    std_msgs::Header base;
    std::string fixed_frame;
    Pose2 base_in_fixed;
  };

  std::deque<ScanPose> poses_;  ///< the last ones, by rising stamp
};

}  // namespace datmo
