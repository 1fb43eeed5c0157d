// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "datmo_fusion/common/box2.h"
#include "datmo_fusion/common/scan.h"

namespace datmo {

/// A walled yard of 50 m x 30 m with pillars, in which a car drives; ray casting by hand.
class Yard {
 public:
  /// Returns a scan with 2-degree beams over 160 degrees from this pose, at this time. `box`: an
  /// object in the yard in this scan only. Beams that hit nothing, from outside the walls, have no
  /// return.
  Scan scan(const Pose2& base_in_map, double seconds, const Box2* box = nullptr) const {
    Scan scan;
    scan.stamp = Stamp::fromSeconds(1000.0 + seconds);
    scan.scanner_in_base = Pose2(1.0, 0.0, 0.0);
    scan.field.first_bearing = degrees(-80.0);
    scan.field.beam_spacing = degrees(2.0);
    scan.field.beams = 81;
    scan.field.range = 60.0;
    const Pose2 scanner = base_in_map * scan.scanner_in_base;
    for (std::uint32_t beam = 0; beam < 81; ++beam) {
      Ray ray;
      ray.beam = beam;
      ray.bearing = degrees(-80.0 + 2.0 * beam);
      const double direction = scanner.heading() + ray.bearing;
      double range = rangeTo(scanner.position(), direction);
      if (box != nullptr) {
        range = std::min(range, rangeToBox(*box, scanner.position(), direction));
      }
      ray.hit = range <= scan.field.range;
      ray.range = std::min(range, scan.field.range);
      ray.origin = scan.scanner_in_base.position();
      ray.end = scan.scanner_in_base *
                Point2(ray.range * std::cos(ray.bearing), ray.range * std::sin(ray.bearing));
      scan.rays.push_back(ray);
    }
    return scan;
  }

 private:
  static double rangeToSide(const Point2& a, const Point2& b, const Point2& from,
                            double direction) {
    const Point2 ray(std::cos(direction), std::sin(direction));
    const Point2 side = b - a;
    const double cross = ray.x() * side.y() - ray.y() * side.x();
    if (std::abs(cross) < 1e-12) {
      return std::numeric_limits<double>::infinity();
    }
    const Point2 to_a = a - from;
    const double range = (to_a.x() * side.y() - to_a.y() * side.x()) / cross;
    const double part = (to_a.x() * ray.y() - to_a.y() * ray.x()) / cross;
    return range > 0.0 && part >= 0.0 && part <= 1.0 ? range
                                                     : std::numeric_limits<double>::infinity();
  }

  static double rangeToBox(const Box2& box, const Point2& from, double direction) {
    const auto corners = box.corners();
    double range = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      range = std::min(range, rangeToSide(corners[i], corners[(i + 1) % 4], from, direction));
    }
    return range;
  }

  static double rangeTo(const Point2& from, double direction) {
    double range = rangeToBox({Pose2(15.0, 0.0, 0.0), 50.0, 30.0}, from, direction);
    for (const double x : {5.0, 14.0, 23.0, 32.0}) {
      range = std::min(range, rangeToBox({Pose2(x, 7.3, 0.0), 1.5, 1.0}, from, direction));
      range = std::min(range, rangeToBox({Pose2(x + 4.0, -8.1, 0.3), 2.5, 1.0}, from, direction));
    }
    return range;
  }
};

}  // namespace datmo
