// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/slam/keyframe.h"

namespace datmo {

struct KeyframeOptions {
  double distance = 1.0;        ///< m
  double turn = degrees(20.0);  ///< rad
  /// m, 0.01 to 1000: a scan with a less certain pose (standard deviation) is not kept; as
  /// MapRecoveryOptions::from_position_sigma, above which the map is searched
  double max_position_sigma = 0.5;
  double max_heading_sigma = degrees(5.0);  ///< rad, 0.001 to 10: the same for the heading
  double new_map_after = 7.0;               ///< s
  double max_speed = 60.0;                  ///< m/s

  void visit(OptionVisitor& visitor);
};

/// Selects the scans of a drive to keep, by the poses that the live SLAM gives them.
///
/// After a gap the SLAM may be lost: then its pose is much less certain than at the last keyframe,
/// and nothing is kept. If it becomes as certain again, the vehicle was found in the map, and the
/// drive continues. If it stays uncertain, the SLAM has started a new map, whose frame is unknown
/// in the old one: the drive starts over. It also starts over if a pose that was uncertain from the
/// start becomes certain (the vehicle was found in a prior map), and if the pose jumps farther than
/// any vehicle drives (the SLAM itself has started over).
class KeyframeSelector {
 public:
  enum class Use {
    kNothing,   ///< the pose is too uncertain
    kPose,      ///< a pose of the drive
    kKeyframe,  ///< a pose far enough from the previous keyframe
    kFirst,     ///< the first keyframe of a drive; earlier ones are in another frame
  };

  /// Throws OptionError.
  explicit KeyframeSelector(const Checked<KeyframeOptions>& options);

  /// Decides on the next scan, in ascending stamp order.
  Use select(Stamp stamp, const PoseWithCovariance& base_in_map);

  /// Forgets the drive.
  void reset();

 private:
  /// Whether a pose of covariance `known` is much more certain than one of covariance `other`.
  bool isFarBelow(const Eigen::Matrix3d& known, const Eigen::Matrix3d& other) const;
  /// Whether the pose is farther from the last known one than any vehicle drives.
  bool isLeap(Stamp stamp, const Pose2& pose) const;
  Use startAt(Stamp stamp, const PoseWithCovariance& base_in_map);

  KeyframeOptions options_;
  std::optional<PoseWithCovariance> last_;  ///< keyframe
  StampedPose known_;                       ///< the last known pose, if there is a keyframe
  std::optional<Stamp> uncertain_since_;
};

}  // namespace datmo
