// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/transform_buffer.h"

#include <cmath>
#include <string_view>

#include <tf2/LinearMath/Vector3.h>

#include "datmo_fusion/common/physical_bounds.h"
#include "datmo_fusion/ros/frame_ids.h"
#include "datmo_fusion/ros/stage/stamp_check.h"
#include "datmo_fusion/ros/stage/stamp_range.h"

namespace datmo {

namespace {

/// We ignore the sender of a transform, but tf2 requires a name.
const std::string kAuthority = "tf";
const std::string kMounts = "mounts";

/// A mount that differs from tf's by more (m, and in the quaternion's elements) is another one:
/// more than rounding to three digits.
constexpr double kMountTolerance = 2e-3;

/// Tolerance of the squared length of a quaternion, as in tf2.
constexpr double kQuaternionTolerance = 1e-2;

/// For messages: both frames, each between `quotes`.
std::string nameOf(const geometry_msgs::TransformStamped& stamped, const std::string& quote = "") {
  return quote + withoutSlash(stamped.header.frame_id) + quote + " -> " + quote +
         withoutSlash(stamped.child_frame_id) + quote;
}

/// Throws InputError for a transform that is not a rigid motion, or has an invalid stamp.
void check(const geometry_msgs::TransformStamped& stamped) {
  checkStampRange(stamped.header.stamp);
  const auto& t = stamped.transform.translation;
  const auto& q = stamped.transform.rotation;
  const std::string_view parent = plainName(stamped.header.frame_id);
  const std::string_view child = plainName(stamped.child_frame_id);
  if (parent.empty() || child.empty() || parent == child) {
    throw InputError("bad_transform", "transform " + nameOf(stamped, "'") +
                                          ": expected two frames with names; ignores it");
  }
  for (const double coordinate : {t.x, t.y, t.z}) {
    if (!(std::abs(coordinate) <= kMaxCoordinate)) {
      throw InputError("bad_transform", "transform " + nameOf(stamped) + " has a coordinate of " +
                                            std::to_string(coordinate) +
                                            " m: expected one within 20000 km; ignores it");
    }
  }
  const double squared_length = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  if (!(std::abs(squared_length - 1.0) <= kQuaternionTolerance)) {
    throw InputError("bad_transform",
                     "transform " + nameOf(stamped) + " has a quaternion of length " +
                         std::to_string(std::sqrt(squared_length)) + ": expected 1; ignores it");
  }
}

bool isSame(const geometry_msgs::TransformStamped& one,
            const geometry_msgs::TransformStamped& other) {
  const auto& a = one.transform;
  const auto& b = other.transform;
  const tf2::Vector3 between(a.translation.x - b.translation.x, a.translation.y - b.translation.y,
                             a.translation.z - b.translation.z);
  const double cosine = a.rotation.x * b.rotation.x + a.rotation.y * b.rotation.y +
                        a.rotation.z * b.rotation.z + a.rotation.w * b.rotation.w;
  return one.header.frame_id == other.header.frame_id && between.length() <= kMountTolerance &&
         1.0 - std::abs(cosine) <= kMountTolerance * kMountTolerance;
}

}  // namespace

TransformBuffer::TransformBuffer(double restart_after, const SharedOptions& shared,
                                 StageMonitor& monitor)
    : restart_after_(restart_after), monitor_(&monitor) {
  for (const auto& mount : toMessage(shared.mounts, shared.frames.base).transforms) {
    core_.setTransform(mount, kMounts, true);
    mounts_[mount.child_frame_id] = mount;
  }
}

void TransformBuffer::set(const geometry_msgs::TransformStamped& transform, bool is_static) {
  const auto mount = mounts_.find(transform.child_frame_id);
  if (mount != mounts_.end()) {
    if (!isSame(mount->second, transform)) {
      monitor_->warned(InputError("mount_from_tf", "mounts gives another pose of " + mount->first +
                                                       " than tf, which gives it in " +
                                                       transform.header.frame_id +
                                                       ": expected one of them; uses tf"));
    }
    mounts_.erase(mount);
  }
  core_.setTransform(transform, kAuthority, is_static);
}

void TransformBuffer::add(const tf2_msgs::TFMessage& message) {
  for (const auto& transform : message.transforms) {
    if (isGood(transform) && isNew(transform)) {
      set(transform, false);
    }
  }
}

void TransformBuffer::addStatic(const tf2_msgs::TFMessage& message) {
  for (const auto& transform : message.transforms) {
    if (isGood(transform)) {
      set(transform, true);
    }
  }
}

bool TransformBuffer::isGood(const geometry_msgs::TransformStamped& transform) {
  try {
    check(transform);
    return true;
  } catch (const InputError& error) {
    if (monitor_ != nullptr) {
      monitor_->warned(error);
    }
    return false;
  }
}

bool TransformBuffer::isNew(const geometry_msgs::TransformStamped& transform) {
  const Stamp stamp = toStamp(transform.header.stamp);
  const auto gate = gates_.try_emplace(transform.child_frame_id, restart_after_).first;
  const std::optional<Stamp> now = monitor_ != nullptr ? monitor_->now() : std::nullopt;
  const StampVerdict verdict = gate->second.judge(stamp, now);
  if (verdict == StampVerdict::kRestart) {
    core_.clear();
    gates_.clear();  // so that the first transform of another frame does not clear this one
    gates_.try_emplace(transform.child_frame_id, restart_after_).first->second.judge(stamp, now);
  }
  if (verdict == StampVerdict::kStray && monitor_ != nullptr) {
    monitor_->warned(InputError(
        "stray_stamp", "transform " + transform.header.frame_id + " -> " +
                           transform.child_frame_id + " of " + std::to_string(stamp.seconds()) +
                           " s, the newest is of " +
                           std::to_string(gate->second.newest()->seconds()) +
                           " s: expected the next one of its stream; ignores it, and follows the "
                           "clock when a second one confirms that it has jumped"));
  }
  return verdict != StampVerdict::kRepeated && verdict != StampVerdict::kStray;
}

}  // namespace datmo
