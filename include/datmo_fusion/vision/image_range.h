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

/// As ObjectClassifierOptions has its kinds; of vehicles cars, vans and trucks by their shares.
/// Throws std::invalid_argument for a class that no detector reports (unknown, pole).
ClassSize sizeOf(ObjectClass object_class);

struct ImageRangeOptions {
  double edge_share = 0.05;   ///< 1
  double edge_sigma = 1.5;    ///< px
  double pitch_sigma = 0.01;  ///< rad
  double max_range = 80.0;    ///< m

  void visit(OptionVisitor& visitor);
};

/// How far from the camera the near side of what a detector sees is, over ground.
struct ImageRange {
  double range = 0.0;  ///< m, > 0
  double sigma = 0.0;  ///< m
};

/// Range by size (the height of its class over the rectangle's) and by the ground plane (where the
/// line of sight of the rectangle's lower edge meets the road), fused by their covariance: both err
/// by that edge. Where they contradict each other the variance is raised by as much (Birge ratio).
/// An edge at the image's border says nothing: without the upper one there is no range by size,
/// without the lower one none at all by either.
///
/// None where neither says anything, or the range is beyond `max_range`.
std::optional<ImageRange> rangeOf(const MountedCamera& camera, const ImageDetection& detection,
                                  const ImageRangeOptions& options);

/// What a detector sees where no other sensor has anything: an object by bearing and range, as sure
/// as it is, in the base frame. Its box stands across the line of sight, for its heading is not
/// known: its rear is the near side, left and right are those of the rectangle, and the far side is
/// hidden. A side is hidden, too, where the image or something nearer of what is `seen` cuts it off
/// (its rectangle reaches farther down). Of no sensor and of no class probability yet.
///
/// None where there is no range (rangeOf), or its foot is behind something nearer.
std::optional<Object> objectOf(const MountedCamera& camera, const ImageDetection& detection,
                               const ImageRangeOptions& options,
                               const std::vector<ImageDetection>& seen = {});

}  // namespace datmo
