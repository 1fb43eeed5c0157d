// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/stereo_pairs.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

namespace {

/// Maximum number of frames of one camera that wait for the other: the nodelets' queue length.
constexpr std::size_t kMaxQueue = 5;

}  // namespace

void StereoSyncOptions::visit(OptionVisitor& visitor) {
  visitor.toggle(
      {"approximate_sync", "", "stamps of left and right images may differ by pair_tolerance"},
      approximate_sync);
  visitor.number(
      {"pair_tolerance", "s",
       "maximum difference of the stamps with approximate_sync; stereo_image_proc itself "
       "has no limit"},
      pair_tolerance, {0.0, 0.1});
}

std::optional<StereoPair> StereoPairs::handleImage(StereoSide side,
                                                   const sensor_msgs::ImageConstPtr& image) {
  CameraFrame* const frame = frameAt(side, toStamp(image->header.stamp));
  if (frame == nullptr) {
    return std::nullopt;
  }
  frame->image = image;
  return pairWith(side, CameraFrame(*frame));
}

std::optional<StereoPair> StereoPairs::handleInfo(StereoSide side,
                                                  const sensor_msgs::CameraInfoConstPtr& info) {
  CameraFrame* const frame = frameAt(side, toStamp(info->header.stamp));
  if (frame == nullptr) {
    return std::nullopt;
  }
  frame->info = info;
  return pairWith(side, CameraFrame(*frame));
}

void StereoPairs::clear() {
  left_.clear();
  right_.clear();
}

CameraFrame* StereoPairs::frameAt(StereoSide side, Stamp stamp) {
  Frames& frames = framesOf(side);
  auto position = std::find_if(frames.begin(), frames.end(),
                               [&](const CameraFrame& frame) { return !(frame.stamp < stamp); });
  if (position != frames.end() && position->stamp == stamp) {
    return &*position;
  }
  if (frames.size() == kMaxQueue) {
    ++unpaired_;
    if (position == frames.begin()) {
      return nullptr;
    }
    frames.pop_front();
  }
  return &*frames.insert(position, CameraFrame{stamp, nullptr, nullptr});
}

std::optional<StereoPair> StereoPairs::pairWith(StereoSide side, const CameraFrame& frame) {
  const bool left = side == StereoSide::kLeft;
  Frames& others = left ? right_ : left_;
  const auto partner = std::find_if(others.begin(), others.end(), [&](const CameraFrame& other) {
    return other.complete() && std::abs(secondsBetween(frame.stamp, other.stamp)) <= tolerance_;
  });
  if (!frame.complete() || partner == others.end()) {
    return std::nullopt;
  }
  const StereoPair pair = left ? StereoPair{frame, *partner} : StereoPair{*partner, frame};
  dropUpTo(left_, pair.left.stamp);
  dropUpTo(right_, pair.right.stamp);
  return pair;
}

void StereoPairs::dropUpTo(Frames& frames, Stamp stamp) {
  while (frames.front().stamp < stamp) {
    frames.pop_front();
    ++unpaired_;
  }
  frames.pop_front();
}

InputError unpairedImage() {
  return {"unpaired_image",
          "an image without its calibration or without an image of the other camera: expected all "
          "four messages with the same stamp, or, with approximate_sync, nearly the same"};
}

}  // namespace datmo
