// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/slam/keyframe.h"

namespace datmo {

struct KeyframeOptions {
  double distance = 1.0;                    ///< m
  double turn = degrees(20.0);              ///< rad
  double max_position_sigma = 0.5;          ///< m
  double max_heading_sigma = degrees(5.0);  ///< rad
  double new_map_after = 7.0;               ///< s
  double max_speed = 60.0;                  ///< m/s

  void visit(OptionVisitor& visitor);
};

/// Which scans of a drive are kept, by the poses that the live SLAM gives them.
///
/// Behind a gap the SLAM may be lost: then its pose is much less certain than at the keyframe
/// before, and nothing is kept. When it is as certain again, the vehicle was found in
/// the map, and the drive goes on. When it stays uncertain, the SLAM has begun a new map, whose
/// frame nobody knows in that of the old one: the drive starts over. So it does when a pose that
/// was uncertain from the start becomes certain: the vehicle was found in a prior map. And so it
/// does when the pose leaps farther than any vehicle drives: the SLAM itself has started over.
class KeyframeSelector {
 public:
  enum class Use {
    kNothing,   ///< the pose is not known well enough
    kPose,      ///< one more of the drive
    kKeyframe,  ///< and far enough from the keyframe before
    kFirst,     ///< the first keyframe of a drive: what was before belongs to another frame
  };

  /// Throws OptionError.
  explicit KeyframeSelector(const Checked<KeyframeOptions>& options);

  /// By rising stamps.
  Use take(Stamp stamp, const PoseWithCovariance& base_in_map);

  /// Forgets the drive.
  void reset();

 private:
  /// Whether a pose of covariance `known` says much more than one of covariance `other`.
  bool isFarBelow(const Eigen::Matrix3d& known, const Eigen::Matrix3d& other) const;
  /// Whether no vehicle drives so far since the last pose that was known.
  bool isLeap(Stamp stamp, const Pose2& pose) const;
  Use startAt(Stamp stamp, const PoseWithCovariance& base_in_map);

  KeyframeOptions options_;
  std::optional<PoseWithCovariance> last_;  ///< keyframe
  StampedPose known_;                       ///< the last pose that was, if there is a keyframe
  std::optional<Stamp> uncertain_since_;
};

}  // namespace datmo
