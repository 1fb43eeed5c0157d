// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include "datmo_fusion/common/options.h"
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

/// Which images of two cameras belong together; parameters of stereo_image_proc, under its names.
struct StereoSyncOptions {
  bool approximate_sync = false;
  double pair_tolerance = 0.01;  ///< s

  /// s; maximum difference of the stamps of left and right image.
  double pairTolerance() const { return approximate_sync ? pair_tolerance : 0.0; }

  void visit(OptionVisitor& visitor);
};

/// Pairs the messages of two cameras: each image with the calibration of its stamp, and left and
/// right frames whose stamps differ by at most a tolerance. Frames of one camera must be more than
/// twice that apart, so that the first partner is the only one.
class StereoPairs {
 public:
  /// `tolerance`: s, 0 or more.
  explicit StereoPairs(double tolerance) : tolerance_(tolerance) {}

  /// Returns the pair that the message completes, if any. Older frames are then dropped.
  std::optional<StereoPair> handleImage(StereoSide side, const sensor_msgs::ImageConstPtr& image);
  std::optional<StereoPair> handleInfo(StereoSide side,
                                       const sensor_msgs::CameraInfoConstPtr& info);

  /// Forgets all frames; call it when the clock was set back.
  void clear();

  /// Number of frames dropped without a partner or a calibration.
  std::uint64_t unpaired() const { return unpaired_; }

 private:
  using Frames = std::deque<CameraFrame>;  ///< by rising stamp, some incomplete

  Frames& framesOf(StereoSide side) { return side == StereoSide::kLeft ? left_ : right_; }
  /// The frame of this stamp, created if necessary; null if the queue is full of newer ones.
  CameraFrame* frameAt(StereoSide side, Stamp stamp);
  std::optional<StereoPair> pairWith(StereoSide side, const CameraFrame& frame);
  void dropUpTo(Frames& frames, Stamp stamp);

  double tolerance_;
  Frames left_;
  Frames right_;
  std::uint64_t unpaired_ = 0;
};

/// Returns the error for an image without partner or calibration (`unpaired_image`).
InputError unpairedImage();

}  // namespace datmo
