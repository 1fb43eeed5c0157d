#include "datmo_fusion/slam/end_points.h"

#include <cstddef>

namespace datmo {

namespace {

/// Variance of a uniform distribution over an interval of length 1.
constexpr double kUniformVariance = 1.0 / 12.0;

/// Mean step from the previous and to the next end point, as far as they lie on the same surface;
/// zero where neither does.
Point2 stepAlongSurface(const std::vector<EndPoint>& points, std::size_t index,
                        double longest_step) {
  Point2 sum = Point2::Zero();
  int steps = 0;
  const auto add = [&](std::size_t from, std::size_t to) {
    const Point2 step = points[to].position - points[from].position;
    if (step.norm() < longest_step) {
      sum += step;
      ++steps;
    }
  };
  if (index > 0) {
    add(index - 1, index);
  }
  if (index + 1 < points.size()) {
    add(index, index + 1);
  }
  return steps == 0 ? sum : Point2(sum / steps);
}

}  // namespace

std::vector<EndPoint> endPoints(const Scan& scan, double longest_step) {
  std::vector<EndPoint> points;
  std::vector<Point2> across;
  for (const Ray& ray : scan.rays) {
    if (ray.hit) {
      points.push_back({ray.end, Eigen::Matrix2d::Zero()});
      const Point2 along = ray.end - ray.origin;
      across.push_back(scan.beam_spacing * Point2(-along.y(), along.x()));
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point2 step = stepAlongSurface(points, i, longest_step);
    const Point2& interval = step.isZero() ? across[i] : step;
    points[i].sampling = kUniformVariance * interval * interval.transpose();
  }
  return points;
}

}  // namespace datmo
