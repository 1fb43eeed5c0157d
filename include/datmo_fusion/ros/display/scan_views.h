// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>
#include <string>

#include <std_msgs/Header.h>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/visibility/visibility.h"

namespace datmo {

/// Poses of the vehicle at its last scans, as estimated by SLAM, and what it could see from there.
///
/// tf has the pose, too, but only after the odometry that follows the scan: up to one odometry
/// period later, which is longer than the processing time of all stages.
class ScanViews {
 public:
  /// Throws OptionError.
  explicit ScanViews(const Checked<VisibilityOptions>& options);

  /// Adds a labeled scan, newer than those before, and its message.
  void add(const LabeledScanMessage& message, const LabeledScan& scan);

  /// Forgets all scans; call it when the clock has jumped back.
  void clear() { views_.clear(); }

  /// Pose of the vehicle's frame in another one, at exactly the stamp of the header, which also
  /// names the vehicle's frame; none without a labeled scan of that stamp.
  std::optional<Pose2> pose(const std_msgs::Header& base, const std::string& fixed_frame) const;

  /// What the scanner could see at the stamp and from the frame of the header; null without a
  /// labeled scan of that stamp, or if its field of view is unknown. Valid until the next add().
  const Visibility* visibility(const std_msgs::Header& base) const;

 private:
  struct View {
    std_msgs::Header base;
    std::string fixed_frame;
    Pose2 base_in_fixed;
    std::optional<Visibility> visibility;  ///< none: the field of view is unknown
  };

  /// Null if there is none.
  const View* find(const std_msgs::Header& base) const;

  VisibilityOptions options_;
  std::deque<View> views_;  ///< the last ones, by rising stamp
};

}  // namespace datmo
