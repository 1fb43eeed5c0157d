#include "datmo_fusion/ros/transform_buffer.h"

#include "datmo_fusion/ros/stamp_check.h"

namespace datmo {

namespace {

/// Who sent a transform does not matter to us, but tf2 wants a name.
const std::string kAuthority = "tf";

}  // namespace

void TransformBuffer::add(const tf2_msgs::TFMessage& message) {
  for (const auto& transform : message.transforms) {
    if (isNew(transform)) {
      core_.setTransform(transform, kAuthority, false);
    }
  }
}

void TransformBuffer::addStatic(const tf2_msgs::TFMessage& message) {
  for (const auto& transform : message.transforms) {
    core_.setTransform(transform, kAuthority, true);
  }
}

bool TransformBuffer::isNew(const geometry_msgs::TransformStamped& transform) {
  const Stamp stamp = toStamp(transform.header.stamp);
  const auto gate = gates_.try_emplace(transform.child_frame_id, restart_after_).first;
  const StampVerdict verdict = gate->second.judge(stamp);
  if (verdict == StampVerdict::kRestart) {
    core_.clear();
    gates_.clear();  // so that the first transform of another frame does not clear this one
    gates_.try_emplace(transform.child_frame_id, restart_after_).first->second.judge(stamp);
  }
  return verdict != StampVerdict::kRepeated;
}

}  // namespace datmo
