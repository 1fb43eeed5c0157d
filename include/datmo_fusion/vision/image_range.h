// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/vision/image_detector.h"
#include "datmo_fusion/vision/image_region.h"

namespace datmo {

/// Size of the objects of one class: means and standard deviations, m.
struct ClassSize {
  double length = 0.0, length_sigma = 0.0;
  double width = 0.0, width_sigma = 0.0;
  double height = 0.0, height_sigma = 0.0;
};

/// Returns the sizes in ObjectClassifierOptions; for vehicles a mixture of cars, vans and trucks.
/// Throws std::invalid_argument for a class that no detector reports (unknown, pole).
ClassSize sizeOf(ObjectClass object_class);

struct ImageRangeOptions {
  double edge_share = 0.05;   ///< 1
  double edge_sigma = 1.5;    ///< px
  double pitch_sigma = 0.01;  ///< rad
  double max_range = 80.0;    ///< m

  void visit(OptionVisitor& visitor);
};

/// Horizontal distance from the camera to the near side of a detected object.
struct ImageRange {
  double range = 0.0;  ///< m, > 0
  double sigma = 0.0;  ///< m
};

/// Estimates the range by size (the height of its class over the rectangle's) and by the ground
/// plane (where the line of sight of the rectangle's lower edge meets the road), fused by their
/// covariance, since both depend on that edge. If they contradict each other the variance is raised
/// accordingly (Birge ratio). An edge at the image's border gives no information: without the upper
/// one there is no range by size, without the lower one neither.
///
/// Returns none if neither is available, or the range is beyond `max_range`.
std::optional<ImageRange> rangeOf(const MountedCamera& camera, const ImageDetection& detection,
                                  const ImageRangeOptions& options);

/// Creates an object from a detection without any other sensor, in the base frame, from bearing and
/// range with their uncertainty. Its box is aligned across the line of sight, because its heading
/// is unknown: the rear is the near side, left and right are those of the rectangle, and the far
/// side is hidden. A side is also hidden if it is cut off by the image border or by something
/// nearer in `seen` (whose rectangle reaches farther down). No sensor and no class probability are
/// set.
///
/// Returns none without a range (rangeOf), or if its foot is behind something nearer.
std::optional<Object> objectOf(const MountedCamera& camera, const ImageDetection& detection,
                               const ImageRangeOptions& options,
                               const std::vector<ImageDetection>& seen = {});

}  // namespace datmo
