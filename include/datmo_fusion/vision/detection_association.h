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
  double min_coverage = 0.5;       ///< 1
  double column_share = 0.25;      ///< 1
  double range_gate = 9.0;         ///< 1
  double unrelated_density = 0.3;  ///< 1, of the logarithm of range
  double piece_coverage = 0.8;     ///< 1

  void visit(OptionVisitor& visitor);
};

/// An object of the scanner in the image.
struct ProjectedObject {
  ImageRegion region;
  double range = 0.0;        ///< m, from the camera over ground to its nearest point, > 0
  double range_sigma = 0.0;  ///< m
};

/// Which detection each object is seen as (an index, or none).
///
/// A pair must share the object's columns by `min_coverage`, up to the uncertainty of where it is
/// in the image, and its distance must be that of the detection (rangeOf) within `range_gate`: what
/// is hidden behind or stands before it is another. The likeliest assignment over all pairs, by how
/// far the ranges and the middles are apart (solveAssignment); each must be likelier than that both
/// are unrelated. Of a vehicle the scanner may have several pieces: those inside of its columns are
/// seen as the same detection.
std::vector<std::optional<std::size_t>> associate(const std::vector<ProjectedObject>& objects,
                                                  const std::vector<ImageDetection>& detections,
                                                  const MountedCamera& camera,
                                                  const ImageRangeOptions& range,
                                                  const DetectionAssociationOptions& options);

}  // namespace datmo
