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

/// Where the vehicle was at its last scans, as the SLAM found out, and what it could see from
/// there.
///
/// tf has the pose, too, but only when the odometry that follows the scan has come: up to one of
/// its periods later, which is longer than all stages need for the scan.
class ScanViews {
 public:
  /// Throws OptionError.
  explicit ScanViews(const Checked<VisibilityOptions>& options);

  /// Takes a labeled scan, newer than those before, and what its message says.
  void add(const LabeledScanMessage& message, const LabeledScan& scan);

  /// Forgets all scans: the clock has jumped back.
  void clear() { views_.clear(); }

  /// Pose of the vehicle's frame in another one, at exactly the stamp of the header, which also
  /// names the vehicle's frame; none if no labeled scan said so.
  std::optional<Pose2> pose(const std_msgs::Header& base, const std::string& fixed_frame) const;

  /// What the scanner could see at the stamp and from the frame of the header; null without a
  /// labeled scan of that time, and where its field is not known. Valid until the next add().
  const Visibility* visibility(const std_msgs::Header& base) const;

 private:
  struct View {
    std_msgs::Header base;
    std::string fixed_frame;
    Pose2 base_in_fixed;
    std::optional<Visibility> visibility;  ///< none: the field is not known
  };

  /// Null if there is none.
  const View* find(const std_msgs::Header& base) const;

  VisibilityOptions options_;
  std::deque<View> views_;  ///< the last ones, by rising stamp
};

}  // namespace datmo
