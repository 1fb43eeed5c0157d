// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/track/track_extents.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/common/box_extent.h"
#include "datmo_fusion/common/uniform.h"

namespace datmo {

namespace {

/// An extent is twice as uncertain as the center, which lies half of it behind the visible side;
/// one that differs by two standard deviations gets half of the weight.
constexpr double kExtentPerCenter = 4.0;

/// m, standard deviation of the center along the axis.
double sigmaAlong(const Track& track, const Point2& axis) {
  return std::sqrt(std::max(0.0, axis.dot(track.covariance.topLeftCorner<2, 2>() * axis)));
}

/// m, likely extent of a track that another one says is longer.
double believedExtent(double shorter, const Track& longer, const Point2& axis) {
  const double more = extentAlong(longer.box, axis) - shorter;
  const double sigma = kExtentPerCenter * sigmaAlong(longer, axis);
  return shorter + more * (more * more / (more * more + sigma * sigma));
}

/// Extends the box to `extent` along the axis, away from the sensor.
void extend(Track& track, double extent, const Point2& axis, const Point2& sensor) {
  const double missing = extent - extentAlong(track.box, axis);
  if (missing <= 0.0) {
    return;
  }
  const Point2 center = track.state.head<2>();
  const double to_sensor = axis.dot(sensor - center);
  const bool abreast = std::abs(to_sensor) <= 0.5 * extent;
  const double away = to_sensor > 0.0 ? -1.0 : 1.0;
  const double range = abreast ? missing : 0.5 * missing;
  track.covariance.topLeftCorner<2, 2>() +=
      range * range * kUniformVariance * axis * axis.transpose();
  if (!abreast) {
    track.state.head<2>() += 0.5 * missing * away * axis;
  }
  const Point2 own = track.box.center.rotation().transpose() * axis;
  (std::abs(own.x()) >= std::abs(own.y()) ? track.box.length : track.box.width) += missing;
  track.box.center = Pose2(track.state.head<2>(), track.box.center.heading());
}

}  // namespace

void reconcileExtents(Track& a, const std::optional<Point2>& sensor_of_a, Track& b,
                      const std::optional<Point2>& sensor_of_b) {
  const Track& surer = a.heading_variance <= b.heading_variance ? a : b;
  const Eigen::Matrix2d axes = surer.box.center.rotation();
  for (int i = 0; i < 2; ++i) {
    const Point2 axis = axes.col(i);
    const double of_a = extentAlong(a.box, axis);
    const double of_b = extentAlong(b.box, axis);
    if (of_a < of_b && sensor_of_a) {
      extend(a, believedExtent(of_a, b, axis), axis, *sensor_of_a);
    } else if (of_b < of_a && sensor_of_b) {
      extend(b, believedExtent(of_b, a, axis), axis, *sensor_of_b);
    }
  }
}

}  // namespace datmo
