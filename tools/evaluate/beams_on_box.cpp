// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/beams_on_box.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace datmo::evaluation {

namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// Where a line intersects a box, as distances from its start, m.
struct Crossing {
  double entry = -kUnlimited;
  double exit = kUnlimited;
  Point2 normal = Point2::Zero();  // of the side of the entry, frame of the box

  bool isAhead() const { return entry > 0.0 && entry < exit; }
};

/// Method of slabs; start and direction in the frame of the box.
Crossing crossing(const Point2& start, const Point2& direction, const Point2& half_size) {
  Crossing result;
  for (Eigen::Index i = 0; i < 2; ++i) {
    if (direction[i] == 0.0) {
      if (std::abs(start[i]) > half_size[i]) {
        return Crossing{kUnlimited, -kUnlimited, Point2::Zero()};
      }
      continue;
    }
    const double side = direction[i] > 0.0 ? -1.0 : 1.0;
    const double entry = (side * half_size[i] - start[i]) / direction[i];
    if (entry > result.entry) {
      result.entry = entry;
      result.normal = side * Point2::Unit(i);
    }
    result.exit = std::min(result.exit, (-side * half_size[i] - start[i]) / direction[i]);
  }
  return result;
}

double bearingOf(const Point2& vector) { return std::atan2(vector.y(), vector.x()); }

/// Bearings of the box's ends about the scanner, relative to that of its center, and its distance.
struct Silhouette {
  double center = 0.0;
  double first = kUnlimited;
  double last = -kUnlimited;
  double distance = 0.0;  // m, of the center
  double nearest = kUnlimited;

  Silhouette(const Box2& box, const Point2& scanner)
      : center(bearingOf(box.center.position() - scanner)),
        distance((box.center.position() - scanner).norm()) {
    for (const Point2& corner : box.corners()) {
      const double bearing = angleBetween(center, bearingOf(corner - scanner));
      first = std::min(first, bearing);
      last = std::max(last, bearing);
      nearest = std::min(nearest, (corner - scanner).norm());
    }
  }
};

/// Bearings, relative to that of the box's center, that limit its rotation about the scanner.
class TurnLimits {
 public:
  TurnLimits(const Silhouette& silhouette, double tolerance)
      : silhouette_(silhouette), tolerance_(tolerance) {}

  void addHit(double bearing) {
    first_ = std::min(first_, bearing);
    last_ = std::max(last_, bearing);
  }

  void addOther(double bearing, const Ray& ray) {
    const bool is_blocked = ray.hit && ray.range < silhouette_.nearest - tolerance_;
    if (bearing < silhouette_.first && bearing > before_) {
      before_ = bearing;
      free_before_ = !is_blocked;
    } else if (bearing > silhouette_.last && bearing < after_) {
      after_ = bearing;
      free_after_ = !is_blocked;
    }
  }

  double width() const {
    const double before = free_before_ ? before_ : -kUnlimited;
    const double after = free_after_ ? after_ : kUnlimited;
    return std::min(first_ - silhouette_.first, after - silhouette_.last) -
           std::max(before - silhouette_.first, last_ - silhouette_.last);
  }

 private:
  const Silhouette& silhouette_;
  double tolerance_;
  double first_ = kUnlimited;
  double last_ = -kUnlimited;
  double before_ = -kUnlimited;
  double after_ = kUnlimited;
  bool free_before_ = false;
  bool free_after_ = false;
};

}  // namespace

BoxObservation observeBox(const Scan& scan, const Box2& box, double tolerance) {
  const Point2 scanner = scan.scanner_in_base.position();
  const Pose2 base_in_box = box.center.inverse();
  const Point2 half_size = 0.5 * Point2(box.length, box.width);
  const Silhouette silhouette(box, scanner);
  BoxObservation result;
  if (box.contains(scanner)) {
    return result;
  }
  TurnLimits limits(silhouette, tolerance);
  for (const Ray& ray : scan.rays) {
    const Point2 direction = (ray.end - ray.origin).normalized();
    const double bearing = angleBetween(silhouette.center, bearingOf(direction));
    const Crossing met =
        crossing(base_in_box * ray.origin, base_in_box.rotate(direction), half_size);
    if (ray.hit && met.isAhead() && ray.range > met.entry - tolerance &&
        ray.range < met.exit + tolerance) {
      result.beams.push_back({direction, box.center.rotate(met.normal)});
      limits.addHit(bearing);
    } else {
      limits.addOther(bearing, ray);
    }
  }
  const double width = silhouette.distance * limits.width();
  if (!result.beams.empty() && width > 0.0 && std::isfinite(width)) {
    const Point2 direction = (box.center.position() - scanner).normalized();
    result.lateral = {{-direction.y(), direction.x()}, width};
  }
  return result;
}

}  // namespace datmo::evaluation
