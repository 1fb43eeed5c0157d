// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kitti_tracking/camera_mount.h"
#include "kitti_tracking/kitti_tracking_files.h"

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/visibility/visibility.h"

namespace datmo::kitti {

struct DetectionModelOptions {
  double score_slope = 0.9;          ///< 1
  double score_even = 2.5;           ///< 1
  double along_sigma = 0.06;         ///< m
  double along_per_meter = 2.5e-3;   ///< 1
  double across_sigma = 0.04;        ///< m
  double across_per_meter = 1.2e-3;  ///< 1
  double length_sigma = 0.2;         ///< m
  double width_sigma = 0.07;         ///< m
  double heading_sigma = 0.05;       ///< rad
  double sure_range = 45.0;          ///< m
  double range = 90.0;               ///< m

  void visit(OptionVisitor& visitor);
};

/// Measurement model of the boxes of a 3D detector.
class DetectionModel {
 public:
  /// Throws OptionError.
  explicit DetectionModel(const DetectionModelOptions& options);

  /// Logarithm of the odds that a detection of this score is true (logistic regression).
  double logOdds(double score) const {
    return options_.score_slope * (score - options_.score_even);
  }

  /// The detection in the vehicle's frame.
  Object object(const Detection& detection, const CameraMount& mount) const;

  /// The field of view of the detector: the image.
  FieldOfView view(const CameraMount& mount) const;

 private:
  DetectionModelOptions options_;
};

}  // namespace datmo::kitti
