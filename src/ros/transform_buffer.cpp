#include "datmo_fusion/ros/transform_buffer.h"

#include "datmo_fusion/ros/stamp_check.h"

namespace datmo_fusion {

namespace {

/// Who sent a transform does not matter to us, but tf2 wants a name.
const std::string kAuthority = "tf";

}  // namespace

void TransformBuffer::add(const tf2_msgs::TFMessage& message) {
  for (const auto& transform : message.transforms) {
    noticeRestart(transform);
    core_.setTransform(transform, kAuthority, false);
  }
}

void TransformBuffer::addStatic(const tf2_msgs::TFMessage& message) {
  for (const auto& transform : message.transforms) {
    core_.setTransform(transform, kAuthority, true);
  }
}

void TransformBuffer::noticeRestart(const geometry_msgs::TransformStamped& transform) {
  auto& gate = gates_.try_emplace(transform.child_frame_id, restart_after_).first->second;
  if (gate.judge(toStamp(transform.header.stamp)) == StampVerdict::kRestart) {
    core_.clear();
  }
}

}  // namespace datmo_fusion
