// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/detection/box_fit.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "heading_search.h"
#include "near_sides.h"

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/square.h"

namespace datmo {

namespace {

constexpr int kRefinements = 3;

/// A single point off a line may be an outlier, two are the other side.
constexpr std::size_t kMinAlone = 2;

/// The expected noise counts like this many additional points.
constexpr double kNoisePoints = 4.0;

/// rad; minimum standard deviation: no vehicle is a perfect rectangle, however many points it has.
constexpr double kMinHeadingStd = 0.01;

/// Weighted moments of the points on one side.
struct SideMoments {
  double weight = 0.0;
  Point2 sum = Point2::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();

  void add(const Point2& local, double w) {
    weight += w;
    sum += w * local;
    squares += w * local * local.transpose();
  }
  Eigen::Matrix2d scatter() const {
    return weight > 0.0 ? Eigen::Matrix2d(squares - sum * sum.transpose() / weight)
                        : Eigen::Matrix2d::Zero();
  }
};

/// Heading and near sides, and their least-squares statistics.
struct Corner {
  double heading;
  NearSides sides;
  double squares = 0.0;      ///< m^2, weighted sum of the points' distances squared
  double information = 0.0;  ///< m^2, of the heading for a noise of 1 m
  double weight = 0.0;       ///< points on which it is based
};

/// One least-squares step over the heading and both near sides, which are at right angles; each
/// point counts for its nearer side.
Corner refined(const Points& points, const Corner& corner, double sigma) {
  const Axes axes(corner.heading);
  std::array<SideMoments, 2> moments;
  for (const Point2& point : points) {
    const Point2 local = axes(point);
    const double ratio = corner.sides.distance(local) / sigma;
    const double bound = 1.0 / (1.0 + ratio * ratio / kMaxCost);
    moments[static_cast<std::size_t>(corner.sides.nearest(local))].add(local, bound * bound);
  }
  const Eigen::Matrix2d across_first = moments[0].scatter();
  const Eigen::Matrix2d across_second = moments[1].scatter();
  // Sum of squares for the first axis turned by a: for the second side, a quarter turn further.
  const double first = across_first(0, 0) + across_second(1, 1);
  const double second = across_first(1, 1) + across_second(0, 0);
  const double mixed = across_first(0, 1) - across_second(0, 1);
  const double turn = 0.5 * std::atan2(-2.0 * mixed, second - first);
  Corner result = corner;
  result.heading += turn;
  result.information = std::hypot(first - second, 2.0 * mixed);
  result.squares = std::max(0.0, 0.5 * (first + second - result.information));
  result.weight = moments[0].weight + moments[1].weight;
  const Axes turned(turn);
  for (int axis = 0; axis < 2; ++axis) {
    const SideMoments& side = moments[static_cast<std::size_t>(axis)];
    if (side.weight > 0.0) {
      result.sides.position[axis] = turned(side.sum / side.weight)[axis];
    }
  }
  return result;
}

double noiseOf(const Corner& corner, const PointNoise& expected) {
  const double parameters = corner.information > 0.0 ? 3.0 : 2.0;
  const double independent = corner.weight / expected.correlated_points;
  const double freedom = std::max(0.0, independent - parameters);
  return std::sqrt(
      (corner.squares / expected.correlated_points + kNoisePoints * square(expected.sigma)) /
      (freedom + kNoisePoints));
}

/// Number of points on the side across each axis. A side is not seen if most of its points may as
/// well lie on the other one.
std::array<std::size_t, 2> pointsOnSides(const Points& points, const Corner& corner, double noise) {
  const Axes axes(corner.heading);
  std::array<std::size_t, 2> counts{};
  std::array<std::size_t, 2> alone{};
  for (const Point2& point : points) {
    const Point2 distances = (axes(point) - corner.sides.position).cwiseAbs();
    const std::size_t axis = distances.x() <= distances.y() ? 0 : 1;
    ++counts[axis];
    alone[axis] += distances.maxCoeff() > kOnLine * noise ? 1 : 0;
  }
  const std::size_t smaller = counts[0] < counts[1] ? 0 : 1;
  if (alone[smaller] < kMinAlone || 2 * alone[smaller] < counts[smaller]) {
    counts[1 - smaller] += counts[smaller];
    counts[smaller] = 0;
  }
  return counts;
}

BoxFit boxAround(const Points& points, const Point2& scanner, const Corner& corner, double noise) {
  BoxFit fit;
  fit.noise = noise;
  const Axes axes(corner.heading);
  Extent extent = extentOf(points, axes);
  const std::array<std::size_t, 2> counts = pointsOnSides(points, corner, noise);
  for (std::size_t i = 0; i < 2; ++i) {
    const int axis = static_cast<int>(i);
    if (counts[i] == 0) {
      continue;
    }
    const double position = corner.sides.position[axis];
    const bool ahead = corner.sides.ahead[i];
    double& near = ahead ? extent.max[axis] : extent.min[axis];
    double& far = ahead ? extent.min[axis] : extent.max[axis];
    near = position;
    if (std::abs(far - near) < kOnLine * noise || (far < near) != ahead) {
      far = near;
    }
    const BoxSide side = i == 0 ? (ahead ? BoxSide::kFront : BoxSide::kRear)
                                : (ahead ? BoxSide::kLeft : BoxSide::kRight);
    fit.points_on_side[static_cast<std::size_t>(side)] = counts[i];
  }
  const Pose2 turn(Point2::Zero(), corner.heading);
  const Point2 size = extent.max - extent.min;
  fit.box = {Pose2(scanner + turn.rotate(0.5 * (extent.min + extent.max)), corner.heading),
             size.x(), size.y()};
  return fit;
}

}  // namespace

BoxFit fitBox(const std::vector<Point2>& points, const Point2& scanner,
              const PointNoise& expected) {
  if (points.size() <= 1) {
    return boxAcross(points, scanner, expected.sigma);
  }
  Points seen = points;
  for (Point2& point : seen) {
    point -= scanner;
  }
  const HeadingSearch search(seen, expected);
  const Point2 between = seen.back() - seen.front();
  // Two points are best explained by one side, although many headings fit them as well.
  const double start =
      seen.size() == 2 ? std::atan2(between.y(), between.x()) + kQuarterTurn : search.best();
  Corner corner{start, extentOf(seen, Axes(start)).nearSides()};
  for (int i = 0; i < kRefinements; ++i) {
    corner = refined(seen, corner, expected.sigma);
  }
  const double noise = noiseOf(corner, expected);
  BoxFit fit = boxAround(seen, scanner, corner, noise);
  if (corner.information > 0.0) {
    fit.heading_variance =
        std::min(kUnknownHeadingVariance,
                 kMinHeadingStd * kMinHeadingStd +
                     square(noise) * expected.correlated_points / corner.information +
                     search.spreadAbout(corner.heading));
  }
  return fit;
}

BoxFit boxAcross(const std::vector<Point2>& points, const Point2& scanner, double noise) {
  if (points.empty()) {
    throw std::invalid_argument("box fit: 0 points, expected 1 or more");
  }
  Points seen = points;
  Point2 sum = Point2::Zero();
  for (Point2& point : seen) {
    point -= scanner;
    sum += point;
  }
  const double heading = std::atan2(sum.y(), sum.x());
  const Axes axes(heading);
  const Extent extent = extentOf(seen, axes);
  const Point2 mean = axes(sum / static_cast<double>(points.size()));
  const Point2 middle(mean.x(), 0.5 * (extent.min.y() + extent.max.y()));
  BoxFit fit;
  fit.box = {Pose2(scanner + Pose2(Point2::Zero(), heading).rotate(middle), heading), 0.0,
             extent.max.y() - extent.min.y()};
  fit.noise = noise;
  fit.points_on_side[static_cast<std::size_t>(BoxSide::kRear)] = points.size();
  return fit;
}

}  // namespace datmo
