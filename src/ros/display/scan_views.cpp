// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/display/scan_views.h"

#include <algorithm>

namespace datmo {

namespace {

/// More than a second of a fast scanner: fused objects may have waited that long for those of
/// another sensor.
constexpr std::size_t kMaxViews = 64;

}  // namespace

ScanViews::ScanViews(const Checked<VisibilityOptions>& options) : options_(*options) {}

void ScanViews::add(const LabeledScanMessage& message, const LabeledScan& scan) {
  views_.push_back({message.header, message.map_frame, scan.base_in_map.pose, std::nullopt});
  if (scan.field.beams > 0) {
    views_.back().visibility.emplace(scan, options_);
  }
  if (views_.size() > kMaxViews) {
    views_.pop_front();
  }
}

/// The latest one, if a scan was received twice.
const ScanViews::View* ScanViews::find(const std_msgs::Header& base) const {
  const auto found = std::find_if(views_.rbegin(), views_.rend(), [&](const View& view) {
    return view.base.stamp == base.stamp && view.base.frame_id == base.frame_id;
  });
  return found == views_.rend() ? nullptr : &*found;
}

std::optional<Pose2> ScanViews::pose(const std_msgs::Header& base,
                                     const std::string& fixed_frame) const {
  const View* view = find(base);
  const bool known = view != nullptr && view->fixed_frame == fixed_frame;
  return known ? std::optional<Pose2>(view->base_in_fixed) : std::nullopt;
}

const Visibility* ScanViews::visibility(const std_msgs::Header& base) const {
  const View* view = find(base);
  return view != nullptr && view->visibility ? &*view->visibility : nullptr;
}

}  // namespace datmo
