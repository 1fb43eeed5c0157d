// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/options.h"

namespace datmo::kitti {

struct VerticalExtentOptions {
  double bottom_sigma = 0.06;  ///< m
  double bottom_drift = 0.3;   ///< m/sqrt(s)
  double height_sigma = 0.07;  ///< m

  void visit(OptionVisitor& visitor);
};

/// Lower face and height of a tracked object, filtered separately, because the tracker works only
/// on the ground plane. The lower face moves up and down with the road and with the camera's pitch
/// (a random walk); the height is constant.
class VerticalExtent {
 public:
  /// From the first detection: y of the lower face and height, m.
  VerticalExtent(double bottom, double height, const VerticalExtentOptions& options);

  void predict(double seconds, const VerticalExtentOptions& options);
  void update(double bottom, double height, const VerticalExtentOptions& options);

  double bottom() const { return bottom_; }  ///< m
  double height() const { return height_; }  ///< m

 private:
  double bottom_;
  double height_;
  double bottom_variance_;  ///< m^2
  double height_variance_;  ///< m^2
};

}  // namespace datmo::kitti
