// SPDX-License-Identifier: BSD-3-Clause
#include "grazing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "datmo_fusion/common/cross.h"
#include "datmo_fusion/common/square.h"

namespace datmo {

namespace {

/// The 95 % quantile of chi-square with one degree of freedom.
constexpr double kSignificant = 3.84;

/// s, over which the scanner's velocity is averaged, and time between two such velocities.
constexpr double kVelocityTime = 0.3;
constexpr double kTurnTime = 1.0;

/// rad; accuracy of the course as a prediction of where the vehicle will pass on a straight road.
constexpr double kCourseStd = 0.02;

/// m, error of the scanner's motion in kVelocityTime.
constexpr double kMotionStd = 0.02;

/// The newest scan of at least this age (s), but not the oldest one; there must be at least two.
std::size_t scanOfAge(const ScanHistory& history, double age) {
  std::size_t back = 0;
  while (back + 2 < history.size() && history.age(back) < age) {
    ++back;
  }
  return back;
}

/// The scanner's mean velocity in the kVelocityTime before a scan, which is not the oldest one.
Point2 scannerVelocity(const ScanHistory& history, std::size_t last) {
  std::size_t back = last + 1;
  while (back + 1 < history.size() && history.age(back) - history.age(last) < kVelocityTime) {
    ++back;
  }
  return (history.scanner(last) - history.scanner(back)) / (history.age(back) - history.age(last));
}

/// Standard deviation, m, of how far from its current course the vehicle will pass at this range.
double pathStd(const ScanHistory& history, const Point2& velocity, double range) {
  const std::size_t before = scanOfAge(history, kTurnTime);
  const Point2 velocity_before = scannerVelocity(history, before);
  const double turn =
      std::atan2(cross(velocity_before, velocity), velocity_before.dot(velocity));  // rad
  const double distance = velocity.norm() * std::max(kVelocityTime, history.age(before));
  const double bend = 0.5 * square(range) * turn / distance;
  const double direction = kMotionStd / (velocity.norm() * kVelocityTime);
  return std::hypot(range * std::hypot(kCourseStd, direction), bend);
}

}  // namespace

double grazingShare(const ScanHistory& history, const BeamPositions& seen, const MovingBody& body,
                    const MotionLikelihoodOptions& options) {
  if (history.size() < 2 || body.velocity.isZero() || !seen.keepsItsBeam()) {
    return 0.0;
  }
  const Point2 line_of_sight = body.box.center.position() - history.scanner(0);
  const Point2 velocity = scannerVelocity(history, 0);
  const double across = cross(line_of_sight.normalized(), body.velocity - velocity);
  if (square(across) >= kSignificant * body.speed_variance || velocity.isZero()) {
    return 0.0;
  }
  const double lateral = std::abs(cross(velocity.normalized(), line_of_sight));
  const double sigma = pathStd(history, velocity, line_of_sight.norm());
  const double beside_path =
      0.5 * std::erfc((options.free_path - lateral) / (std::sqrt(2.0) * sigma));
  return options.grazing_share * beside_path;
}

}  // namespace datmo
