// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/vision/image_detector.h"
#include "datmo_fusion/vision/image_range.h"
#include "datmo_fusion/vision/image_region.h"

namespace datmo {

struct DetectionAssociationOptions {
  /// 0.01 to 1: minimum share of an object's columns that a detection must cover to be associated
  /// with it
  double min_coverage = 0.5;
  /// 0.01 to 10: standard deviation between the centers of an object and its detection, as a share
  /// of the detection's width: the scanner sees one side, the image the whole object
  double column_share = 0.25;
  /// 0.1 to 1000: largest squared Mahalanobis distance between the ranges from scanner and image
  double range_gate = 9.0;
  double unrelated_density = 0.3;  ///< 1, of the logarithm of range
  /// 0.01 to 1: an object without a detection is part of a vehicle that covers this share of its
  /// columns
  double piece_coverage = 0.8;

  void visit(OptionVisitor& visitor);
};

/// An object of the scanner, projected into the image.
struct ProjectedObject {
  ImageRegion region;
  double range = 0.0;        ///< m, horizontal, from the camera to its nearest point, > 0
  double range_sigma = 0.0;  ///< m
};

/// Returns for each object the index of its detection, or none.
///
/// A pair must share `min_coverage` of the object's columns, within the uncertainty of its position
/// in the image, and its range must agree with the detection's (rangeOf) within `range_gate`: what
/// is hidden behind or stands in front is a different object. The most likely assignment over all
/// pairs is chosen, by the differences of ranges and of column centers (solveAssignment); each pair
/// must be likelier than two unrelated objects. The scanner may see a vehicle as several pieces:
/// those inside its columns get the same detection.
std::vector<std::optional<std::size_t>> associate(const std::vector<ProjectedObject>& objects,
                                                  const std::vector<ImageDetection>& detections,
                                                  const MountedCamera& camera,
                                                  const ImageRangeOptions& range,
                                                  const DetectionAssociationOptions& options);

}  // namespace datmo
