// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/display/driver_view.h"

#include <cmath>
#include <map>

#include "datmo_fusion/ros/convert/message_conversion.h"

namespace datmo {

namespace {

std::optional<double> finite(float value) {
  return std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

bool isFinite(const Pose2& pose) {
  return pose.position().allFinite() && std::isfinite(pose.heading());
}

Pose2 poseOf(const geometry_msgs::Pose2D& pose) { return {pose.x, pose.y, pose.theta}; }

void addCause(const RiskArray& risks, const Pose2& fixed_in_host, DriverView& view) {
  for (const RiskMessage& risk : risks.risks) {
    if (risk.id != risks.cause || risks.level == RiskArray::LEVEL_NONE) {
      continue;
    }
    view.ttc = finite(risk.median_ttc);
    view.time_to_brake = finite(risk.time_to_brake);
    const Point2 contact = fixed_in_host * Point2(risk.contact.x, risk.contact.y);
    if (view.ttc && contact.allFinite()) {
      view.contact = contact;
    }
  }
}

}  // namespace

DriverView driverViewOf(const RiskArray& risks, const TrackArray* tracks) {
  DriverView view;
  view.level = risks.level;
  view.reason = risks.reason;
  view.host_length = static_cast<double>(risks.host_length);
  view.host_width = static_cast<double>(risks.host_width);
  view.path_step = static_cast<double>(risks.host_path_step);
  if (risks.host_path.empty() || !isFinite(poseOf(risks.host_path.front()))) {
    return view;
  }
  const Pose2 fixed_in_host = poseOf(risks.host_path.front()).inverse();
  for (const geometry_msgs::Pose2D& pose : risks.host_path) {
    const Pose2 in_host = fixed_in_host * poseOf(pose);
    if (!isFinite(in_host)) {
      break;
    }
    view.path.push_back(in_host);
  }
  addCause(risks, fixed_in_host, view);
  if (!tracks || tracks->header.frame_id != risks.header.frame_id) {
    return view;
  }
  std::map<std::uint32_t, double> probabilities;
  for (const RiskMessage& risk : risks.risks) {
    probabilities[risk.id] = static_cast<double>(risk.contact_probability.back());
  }
  for (const TrackMessage& track : tracks->tracks) {
    const auto& q = track.pose.orientation;
    const Pose2 in_fixed(track.pose.position.x, track.pose.position.y, 2.0 * std::atan2(q.z, q.w));
    const Pose2 pose = fixed_in_host * in_fixed;
    if (isFinite(pose) && std::isfinite(track.size.x) && std::isfinite(track.size.y)) {
      const bool is_cause = risks.level != RiskArray::LEVEL_NONE && track.id == risks.cause;
      view.icons.push_back({track.id, classFromMessage(track.classification), pose, track.size.x,
                            track.size.y, probabilities[track.id], is_cause});
    }
  }
  return view;
}

}  // namespace datmo
