#include "datmo_fusion/slam/scan_matcher.h"

#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace datmo {

namespace {

/// A refinement that moves less than this (m, rad) has converged.
constexpr double kConverged = 1e-4;

/// Spread (of cells) beyond which hits are a wall that goes on outside of the neighbourhood they
/// were gathered from; those of a wall through 3 cells have 3 / sqrt(12) = 0.87.
constexpr double kWallSpread = 0.5;

/// What an end point near these hits tells of its place, 1/m^2. Along a wall it tells nothing: the
/// hits' mean is only the middle of the neighbourhood.
Eigen::Matrix2d informationOf(const Eigen::Matrix2d& spread, double point_variance,
                              double cell_size) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(spread);
  Point2 information = (axes.eigenvalues().array().max(0.0) + point_variance).inverse();
  const double longest = kWallSpread * cell_size;
  if (axes.eigenvalues()[1] > longest * longest) {
    information[1] = 0.0;
  }
  return axes.eigenvectors() * information.asDiagonal() * axes.eigenvectors().transpose();
}

/// The shift of a pose by a small x, y (map frame) and heading.
Pose2 shifted(const Pose2& pose, const Eigen::Vector3d& by) {
  return {pose.x() + by[0], pose.y() + by[1], pose.heading() + by[2]};
}

Eigen::Vector3d difference(const Pose2& from, const Pose2& to) {
  return {to.x() - from.x(), to.y() - from.y(), angleBetween(from.heading(), to.heading())};
}

}  // namespace

/// Normal equations of a match around a pose: information * step = gradient.
struct ScanMatcher::Normal {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  int points = 0;
  double weakest_sigma = std::numeric_limits<double>::infinity();  ///< m, of the position
  bool degenerate = false;

  /// Leaves out the direction of the position that is known worse than `limit` (m).
  void leaveOutWeakest(double limit) {
    if (information(2, 2) <= 0.0) {
      return;
    }
    // Of the position alone: the heading is estimated with it.
    const Eigen::Matrix2d position = information.topLeftCorner<2, 2>() -
                                     information.topRightCorner<2, 1>() *
                                         information.bottomLeftCorner<1, 2>() / information(2, 2);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(position);
    const double weakest = axes.eigenvalues()[0];
    weakest_sigma = weakest > 0.0 ? 1.0 / std::sqrt(weakest) : weakest_sigma;
    degenerate = weakest_sigma > limit;
    if (degenerate) {
      Eigen::Vector3d direction = Eigen::Vector3d::Zero();
      direction.head<2>() = axes.eigenvectors().col(0);
      const Eigen::Matrix3d keep = Eigen::Matrix3d::Identity() - direction * direction.transpose();
      information = (keep * information * keep).eval();
      gradient = (keep * gradient).eval();
    }
  }
};

void ScanMatcherOptions::visit(OptionVisitor& visitor) {
  visitor.integer({"samples", "1", "poses drawn for each scan (thesis 3.3.1: 300)"}, samples,
                  {1, 100000});
  visitor.integer({"refinement_steps", "1",
                   "Gauss-Newton steps at the most; 0: the best sample as it is (thesis)"},
                  refinement_steps, {0, 100});
  visitor.number(
      {"point_sigma", "m", "standard deviation of an end point about the surface it hit"},
      point_sigma, {0.005, 2.0});
  visitor.number({"information_share", "1",
                  "share of the end points' information that counts: their errors are not "
                  "independent (shape of the surface, pose of earlier scans)"},
                 information_share, {0.001, 1.0});
  visitor.number({"degenerate_sigma", "m",
                  "a direction in which the scan alone would place the vehicle worse than this "
                  "(along a corridor, a guard rail) is left to the prediction"},
                 degenerate_sigma, {0.01, 1000.0});
  visitor.integer({"least_points", "1", "end points on known surfaces that make a match"},
                  least_points, {1, 10000});
}

ScanMatcher::ScanMatcher(const ScanMatcherOptions& options) : options_(options) {
  checkOptions(options);
}

double ScanMatcher::score(const OccupancyMap& map, const std::vector<EndPoint>& points,
                          const Pose2& pose) const {
  const Eigen::Matrix2d rotation = pose.rotation();
  double sum = 0.0;
  for (const EndPoint& point : points) {
    sum += map.occupancy(map.window().cellAt(pose.position() + rotation * point.position));
  }
  return points.empty() ? 0.0 : sum / static_cast<double>(points.size());
}

Pose2 ScanMatcher::bestSample(const OccupancyMap& map, const std::vector<EndPoint>& points,
                              const PoseWithCovariance& prediction, Random& random) const {
  const Eigen::Matrix3d spread = prediction.covariance.llt().matrixL();
  Pose2 best = prediction.pose;
  double best_score = score(map, points, best);
  for (int i = 1; i < options_.samples; ++i) {
    const Eigen::Vector3d standard(random.normal(1.0), random.normal(1.0), random.normal(1.0));
    const Pose2 sample = shifted(prediction.pose, spread * standard);
    const double sample_score = score(map, points, sample);
    if (sample_score > best_score) {
      best = sample;
      best_score = sample_score;
    }
  }
  return best;
}

ScanMatcher::Normal ScanMatcher::sumOf(const OccupancyMap& map, const std::vector<EndPoint>& points,
                                       const Pose2& pose) const {
  Normal normal;
  const double variance = options_.point_sigma * options_.point_sigma;
  const Eigen::Matrix2d rotation = pose.rotation();
  for (const EndPoint& point : points) {
    const Point2 turned = rotation * point.position;
    const Point2 end = pose.position() + turned;
    const auto surface = map.hitsAround(end);
    if (!surface) {
      continue;
    }
    const Eigen::Matrix2d information =
        informationOf(surface->covariance + rotation * point.sampling * rotation.transpose(),
                      variance, map.window().cell_size);
    const Point2 error = surface->mean - end;
    const double distance = error.dot(information * error);
    // Points that do not fit fade out (the score of Biber & Strasser is this Gaussian).
    const double weight = std::exp(-0.5 * distance);
    Eigen::Matrix<double, 2, 3> jacobian;
    jacobian << 1.0, 0.0, -turned.y(), 0.0, 1.0, turned.x();
    normal.information += weight * jacobian.transpose() * information * jacobian;
    normal.gradient += weight * jacobian.transpose() * information * error;
    ++normal.points;
  }
  normal.information *= options_.information_share;
  normal.gradient *= options_.information_share;
  return normal;
}

ScanMatcher::Normal ScanMatcher::linearise(const OccupancyMap& map,
                                           const std::vector<EndPoint>& points,
                                           const Pose2& pose) const {
  Normal normal = sumOf(map, points, pose);
  normal.leaveOutWeakest(options_.degenerate_sigma);
  return normal;
}

MatchResult ScanMatcher::match(const OccupancyMap& map, const std::vector<EndPoint>& points,
                               const PoseWithCovariance& prediction, Random& random) const {
  const Eigen::Matrix3d prior = prediction.covariance.inverse();
  Pose2 pose = bestSample(map, points, prediction, random);
  Normal normal = linearise(map, points, pose);
  MatchResult result{prediction, {}};
  result.quality.matched_points = normal.points;
  if (normal.points < options_.least_points) {
    return result;
  }
  for (int step = 0; step < options_.refinement_steps; ++step) {
    const Eigen::Vector3d move =
        (normal.information + prior)
            .ldlt()
            .solve(normal.gradient + prior * difference(pose, prediction.pose));
    pose = shifted(pose, move);
    normal = linearise(map, points, pose);
    if (move.cwiseAbs().maxCoeff() < kConverged) {
      break;
    }
  }
  result.pose.pose = pose;
  result.pose.covariance = (normal.information + prior).inverse();
  result.quality = {normal.points, score(map, points, pose), true, normal.weakest_sigma,
                    normal.degenerate};
  return result;
}

}  // namespace datmo
