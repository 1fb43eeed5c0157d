#include "datmo_fusion/detection/box_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace datmo {

namespace {

constexpr double kQuarter = 0.5 * kPi;
constexpr int kHeadings = 15;  ///< over a quarter turn
constexpr double kStep = kQuarter / kHeadings;
constexpr int kRefinements = 3;

/// Cost of a point that lies nowhere near a side, as of one at so many standard deviations squared.
constexpr double kMostCost = 4.0;

/// Points nearer to a line than this, in standard deviations, may lie on it.
constexpr double kOnLine = 3.0;

/// A single point beside a line may be an outlier, two are the other side.
constexpr std::size_t kLeastAlone = 2;

/// The expected noise counts like this many points besides those that there are.
constexpr double kNoisePoints = 4.0;

/// rad; no vehicle is a perfect rectangle, however many points there are on it.
constexpr double kLeastHeadingStd = 0.01;

constexpr double kNone = std::numeric_limits<double>::infinity();

/// Points about the scanner.
using Points = std::vector<Point2>;

/// The axes of a heading.
struct Axes {
  explicit Axes(double heading) : along(std::cos(heading), std::sin(heading)) {}
  Point2 operator()(const Point2& point) const {
    return {along.x() * point.x() + along.y() * point.y(),
            along.x() * point.y() - along.y() * point.x()};
  }
  Point2 along;
};

/// Lines at constant first and second coordinate that face the scanner, which is at the origin;
/// kNone: it does not see the side across this axis.
struct NearSides {
  Point2 place;
  std::array<bool, 2> ahead{};  ///< the side is at the positive end of the object

  /// Distance to the nearer one, m.
  double distance(const Point2& local) const { return (local - place).cwiseAbs().minCoeff(); }

  /// The axis that the nearer one is across.
  int nearest(const Point2& local) const {
    return std::abs(local.x() - place.x()) <= std::abs(local.y() - place.y()) ? 0 : 1;
  }
};

struct Extent {
  Point2 least = Point2::Constant(kNone);
  Point2 most = Point2::Constant(-kNone);

  /// Where the near sides are if no point is in front of them.
  NearSides nearSides() const {
    const auto place = [&](int axis) {
      return least[axis] > 0.0 ? least[axis] : (most[axis] < 0.0 ? most[axis] : kNone);
    };
    NearSides sides{{place(0), place(1)}, {most.x() < 0.0, most.y() < 0.0}};
    if (sides.place.x() == kNone && sides.place.y() == kNone) {
      sides.place = least;  // the scanner is inside: no side is nearer than another
    }
    return sides;
  }
};

Extent extentOf(const Points& points, const Axes& axes) {
  Extent extent;
  for (const Point2& point : points) {
    const Point2 local = axes(point);
    extent.least = extent.least.cwiseMin(local);
    extent.most = extent.most.cwiseMax(local);
  }
  return extent;
}

/// Squared distances in standard deviations, each bounded (Geman & McClure 1985). A second side is
/// one more parameter: it must explain more than that by chance (Schwarz 1978).
double costOf(const Points& points, double heading, double variance) {
  const Axes axes(heading);
  const NearSides sides = extentOf(points, axes).nearSides();
  double cost = 0.0;
  Point2 farthest = Point2::Zero();  // from each side
  for (const Point2& point : points) {
    const Point2 distances = (axes(point) - sides.place).cwiseAbs();
    farthest = farthest.cwiseMax(distances);
    const double nearest = distances.minCoeff();
    const double square = nearest * nearest;
    cost += square / (variance + square / kMostCost);
  }
  const bool both = farthest.minCoeff() > kOnLine * std::sqrt(variance);
  return both ? cost + std::log(static_cast<double>(points.size())) : cost;
}

/// Costs of all headings.
class HeadingSearch {
 public:
  HeadingSearch(const Points& points, double sigma) {
    const Extent extent = extentOf(points, Axes(0.0));
    // The best of the headings that are tried is up to half a step off.
    const double slant = 0.25 * kStep * (extent.most - extent.least).norm();
    for (std::size_t i = 0; i < costs_.size(); ++i) {
      costs_[i] = costOf(points, heading(i), sigma * sigma + slant * slant);
    }
    best_ =
        static_cast<std::size_t>(std::min_element(costs_.begin(), costs_.end()) - costs_.begin());
  }

  double best() const { return heading(best_); }

  /// Variance of the likely headings about this one, modulo a quarter turn, rad^2; what the steps
  /// themselves make of it left out.
  double spreadAbout(double centre) const {
    double sum = 0.0;
    double total = 0.0;
    for (std::size_t i = 0; i < costs_.size(); ++i) {
      const double weight = std::exp(0.5 * (costs_[best_] - costs_[i]));
      const double apart =
          std::max(0.0, std::abs(std::remainder(heading(i) - centre, kQuarter)) - kStep);
      sum += weight * apart * apart;
      total += weight;
    }
    return sum / total;
  }

 private:
  static double heading(std::size_t i) { return kStep * static_cast<double>(i); }

  std::array<double, kHeadings> costs_;
  std::size_t best_;
};

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

/// Heading and near sides, and what the least squares tell of them.
struct Corner {
  double heading;
  NearSides sides;
  double squares = 0.0;      ///< m^2, weighted sum of the points' distances squared
  double information = 0.0;  ///< m^2, of the heading for a noise of 1 m
  double weight = 0.0;       ///< points that it rests on
};

/// One step of least squares over the heading and both near sides, which are at right angles; each
/// point counts for its nearer side.
Corner refined(const Points& points, const Corner& corner, double sigma) {
  const Axes axes(corner.heading);
  std::array<SideMoments, 2> moments;
  for (const Point2& point : points) {
    const Point2 local = axes(point);
    const double ratio = corner.sides.distance(local) / sigma;
    const double bound = 1.0 / (1.0 + ratio * ratio / kMostCost);
    moments[static_cast<std::size_t>(corner.sides.nearest(local))].add(local, bound * bound);
  }
  const Eigen::Matrix2d across_first = moments[0].scatter();
  const Eigen::Matrix2d across_second = moments[1].scatter();
  // Sum of squares for the first axis turned by a: of the second side, a quarter turn farther on.
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
      result.sides.place[axis] = turned(side.sum / side.weight)[axis];
    }
  }
  return result;
}

double noiseOf(const Corner& corner, double sigma) {
  const double parameters = corner.information > 0.0 ? 3.0 : 2.0;
  const double freedom = std::max(0.0, corner.weight - parameters);
  return std::sqrt((corner.squares + kNoisePoints * sigma * sigma) / (freedom + kNoisePoints));
}

/// How many points lie on the side across each axis. A side of which most points may as well lie on
/// the other one is not seen.
std::array<std::size_t, 2> pointsOnSides(const Points& points, const Corner& corner, double noise) {
  const Axes axes(corner.heading);
  std::array<std::size_t, 2> counts{};
  std::array<std::size_t, 2> alone{};
  for (const Point2& point : points) {
    const Point2 distances = (axes(point) - corner.sides.place).cwiseAbs();
    const std::size_t axis = distances.x() <= distances.y() ? 0 : 1;
    ++counts[axis];
    alone[axis] += distances.maxCoeff() > kOnLine * noise ? 1 : 0;
  }
  const std::size_t smaller = counts[0] < counts[1] ? 0 : 1;
  if (alone[smaller] < kLeastAlone || 2 * alone[smaller] < counts[smaller]) {
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
    const double place = corner.sides.place[axis];
    const bool ahead = corner.sides.ahead[i];
    double& near = ahead ? extent.most[axis] : extent.least[axis];
    double& far = ahead ? extent.least[axis] : extent.most[axis];
    near = place;
    if (std::abs(far - near) < kOnLine * noise || (far < near) != ahead) {
      far = near;
    }
    const BoxSide side = i == 0 ? (ahead ? BoxSide::kFront : BoxSide::kRear)
                                : (ahead ? BoxSide::kLeft : BoxSide::kRight);
    fit.points_on_side[static_cast<std::size_t>(side)] = counts[i];
  }
  const Pose2 turn(Point2::Zero(), corner.heading);
  const Point2 size = extent.most - extent.least;
  fit.box = {Pose2(scanner + turn.rotate(0.5 * (extent.least + extent.most)), corner.heading),
             size.x(), size.y()};
  return fit;
}

/// Its side is across the line of sight.
BoxFit boxOfPoint(const Point2& point, const Point2& scanner, double sigma) {
  const Point2 sight = point - scanner;
  BoxFit fit;
  fit.box.centre = Pose2(point, std::atan2(sight.y(), sight.x()));
  fit.noise = sigma;
  fit.points_on_side[static_cast<std::size_t>(BoxSide::kRear)] = 1;
  return fit;
}

}  // namespace

BoxFit fitBox(const std::vector<Point2>& points, const Point2& scanner, double sigma) {
  if (points.empty()) {
    throw std::invalid_argument("fitBox: 0 points, expected 1 or more");
  }
  if (points.size() == 1) {
    return boxOfPoint(points.front(), scanner, sigma);
  }
  Points seen = points;
  for (Point2& point : seen) {
    point -= scanner;
  }
  const HeadingSearch search(seen, sigma);
  const Point2 between = seen.back() - seen.front();
  // Two points are most simply explained by one side; many headings fit them as well.
  const double start =
      seen.size() == 2 ? std::atan2(between.y(), between.x()) + kQuarter : search.best();
  Corner corner{start, extentOf(seen, Axes(start)).nearSides()};
  for (int i = 0; i < kRefinements; ++i) {
    corner = refined(seen, corner, sigma);
  }
  const double noise = noiseOf(corner, sigma);
  BoxFit fit = boxAround(seen, scanner, corner, noise);
  if (corner.information > 0.0) {
    fit.heading_variance =
        std::min(kUnknownHeadingVariance, kLeastHeadingStd * kLeastHeadingStd +
                                              noise * noise / corner.information +
                                              search.spreadAbout(corner.heading));
  }
  return fit;
}

}  // namespace datmo
