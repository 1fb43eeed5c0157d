// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo {

enum class StereoSide { kLeft, kRight };

/// One image of one camera with its calibration.
struct CameraFrame {
  Stamp stamp;
  sensor_msgs::ImageConstPtr image;
  sensor_msgs::CameraInfoConstPtr info;

  bool complete() const { return image && info; }
};

struct StereoPair {
  CameraFrame left;
  CameraFrame right;
};

/// Puts together what two cameras send: each image with the calibration of its stamp, and left and
/// right frames whose stamps differ by no more than a tolerance. Frames of one camera are expected
/// to be further apart than twice that, so that the first partner is the only one.
class StereoPairs {
 public:
  /// `tolerance`: s, 0 or more.
  explicit StereoPairs(double tolerance) : tolerance_(tolerance) {}

  /// The pair that the message completes, if any. Older frames are given up then.
  std::optional<StereoPair> takeImage(StereoSide side, const sensor_msgs::ImageConstPtr& image);
  std::optional<StereoPair> takeInfo(StereoSide side, const sensor_msgs::CameraInfoConstPtr& info);

  /// Forgets all frames: the clock was set back.
  void clear();

  /// Frames that were given up for want of a partner, or of a calibration.
  std::uint64_t unpaired() const { return unpaired_; }

 private:
  using Frames = std::deque<CameraFrame>;  ///< by rising stamp, some of them not complete

  Frames& framesOf(StereoSide side) { return side == StereoSide::kLeft ? left_ : right_; }
  /// The frame of this stamp, a new one if there is none; null if the queue is full of newer ones.
  CameraFrame* frameAt(StereoSide side, Stamp stamp);
  std::optional<StereoPair> pairWith(StereoSide side, const CameraFrame& frame);
  void dropUpTo(Frames& frames, Stamp stamp);

  double tolerance_;
  Frames left_;
  Frames right_;
  std::uint64_t unpaired_ = 0;
};

/// Says that an image found no partner, or no calibration (`unpaired_image`).
InputError unpairedImage();

}  // namespace datmo
