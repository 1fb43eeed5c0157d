#include "datmo_fusion/ros/scan_poses.h"

#include <algorithm>

#include "datmo_fusion/ros/message_conversion.h"

namespace datmo {

namespace {

/// A second of a fast scanner: objects come a moment after their scan.
constexpr std::size_t kMostPoses = 20;

}  // namespace

void ScanPoses::add(const SplitScanMessage& scan) {
  const ScanPose pose{scan.header, scan.map_frame, fromMessage(scan.pose.pose)};
  if (!poses_.empty() && scan.header.stamp < poses_.back().base.stamp) {
    poses_.clear();
  }
  poses_.push_back(pose);
  if (poses_.size() > kMostPoses) {
    poses_.pop_front();
  }
}

std::optional<Pose2> ScanPoses::find(const std_msgs::Header& base,
                                     const std::string& fixed_frame) const {
  const auto found = std::find_if(poses_.begin(), poses_.end(), [&](const ScanPose& pose) {
    return pose.base.stamp == base.stamp && pose.base.frame_id == base.frame_id &&
           pose.fixed_frame == fixed_frame;
  });
  return found == poses_.end() ? std::nullopt : std::optional<Pose2>(found->base_in_fixed);
}

}  // namespace datmo
