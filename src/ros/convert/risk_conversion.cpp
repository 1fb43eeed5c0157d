// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/convert/risk_conversion.h"

#include <algorithm>

#include "message_parts.h"

namespace datmo {

namespace {

RiskMessage riskMessage(const ObjectRisk& risk) {
  const auto single = [](double value) { return static_cast<float>(value); };
  RiskMessage message;
  message.id = risk.id;
  message.classification = static_cast<std::uint8_t>(risk.object_class);
  message.mode = static_cast<std::uint8_t>(risk.mode);
  std::transform(risk.contact_probability.begin(), risk.contact_probability.end(),
                 message.contact_probability.begin(), single);
  message.early_ttc = single(risk.early_ttc);
  message.median_ttc = single(risk.median_ttc);
  message.time_to_brake = single(risk.time_to_brake);
  message.brake_threat = single(risk.brake_threat);
  message.steer_threat = single(risk.steer_threat);
  message.post_encroachment = single(risk.post_encroachment);
  message.side = static_cast<std::uint8_t>(risk.side);
  message.strike_speed = single(risk.strike_speed);
  message.contact.x = risk.contact.x();
  message.contact.y = risk.contact.y();
  return message;
}

}  // namespace

RiskArray toMessage(const RiskReport& report, const std::string& fixed_frame) {
  RiskArray message;
  message.header = header(report.stamp, fixed_frame);
  message.level = static_cast<std::uint8_t>(report.level);
  message.cause = report.cause;
  message.reason = report.reason;
  for (const ObjectRisk& risk : report.objects) {
    message.risks.push_back(riskMessage(risk));
  }
  for (const BodyPose& pose : report.host.poses) {
    message.host_path.push_back(toPose2D(Pose2(pose.center, pose.heading)));
  }
  message.host_path_step = static_cast<float>(report.host.step);
  message.host_length = static_cast<float>(2.0 * report.host_size.half_length);
  message.host_width = static_cast<float>(2.0 * report.host_size.half_width);
  return message;
}

}  // namespace datmo
