// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/scan_matcher.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "datmo_fusion/common/perpendicular.h"
#include "datmo_fusion/common/square.h"
#include "datmo_fusion/common/uniform.h"
#include "datmo_fusion/slam/pose_covariance.h"
#include "datmo_fusion/slam/pose_scorer.h"

namespace datmo {

namespace {

/// A refinement step smaller than this (m, rad) has converged.
constexpr double kConverged = 1e-4;

/// Hits that spread wider than this share of a uniform distribution over the cells that they come
/// from, and are this many times as wide as thick, belong to a wall that continues outside.
constexpr double kWallShare = 0.6;
constexpr double kWallElongation = 2.0;

/// Information of an end point near these hits on its position, 1/m^2. Along a wall it is 0: the
/// mean of the hits is only the middle of the `aperture` (m) that they come from.
Eigen::Matrix2d informationOf(const Eigen::Matrix2d& spread, double point_variance,
                              double aperture) {
  // Eigenvalues of a symmetric 2 x 2 matrix; computed for each point, so without a solver.
  const double middle = 0.5 * spread.trace();
  const double half_gap =
      std::sqrt(square(0.5 * (spread(0, 0) - spread(1, 1))) + square(spread(0, 1)));
  const double across = middle - half_gap;
  const double along = middle + half_gap;
  if (along > kUniformVariance * square(kWallShare * aperture) &&
      along > square(kWallElongation) * across) {
    // (along - spread) / (along - across) projects onto the axis across the wall.
    return (along * Eigen::Matrix2d::Identity() - spread) /
           (2.0 * half_gap * (std::max(0.0, across) + point_variance));
  }
  return (spread + point_variance * Eigen::Matrix2d::Identity()).inverse();
}

/// The pose, shifted by a small x, y (map frame) and heading.
Pose2 shifted(const Pose2& pose, const Eigen::Vector3d& by) {
  return {pose.x() + by[0], pose.y() + by[1], pose.heading() + by[2]};
}

}  // namespace

/// Input of a match.
struct ScanMatcher::Task {
  const OccupancyMap& map;
  const std::vector<EndPoint>& points;
  const PoseWithCovariance& prediction;
  PoseScorer scorer;
  double full_maturity = 1.0;  ///< maturity of surfaces that count fully
};

/// Normal equations of a match around a pose: information * step = gradient.
struct ScanMatcher::Normal {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  int points = 0;
  double max_maturity = 0.0;
  double weakest_sigma = std::numeric_limits<double>::infinity();  ///< m, of the position
  bool degenerate = false;
  double weight = 0.0;  ///< 1/m^2, of all points
  double age = 0.0;     ///< s/m^2, of their surfaces, by weight

  /// Adds an end point's information (1/m^2) and error (m), both in the map frame; `arm`: from the
  /// pose to the point, m.
  void add(const Eigen::Matrix2d& of_point, const Point2& arm, const Point2& error) {
    const Point2 per_turn = perpendicular(arm);  // m/rad
    const Point2 turning = of_point * per_turn;
    const Point2 pull = of_point * error;
    information.topLeftCorner<2, 2>() += of_point;
    information.topRightCorner<2, 1>() += turning;
    information.bottomLeftCorner<1, 2>() += turning.transpose();
    information(2, 2) += per_turn.dot(turning);
    gradient.head<2>() += pull;
    gradient[2] += per_turn.dot(pull);
  }

  /// Removes directions of the position that are less certain than `limit` (m).
  void leaveOutWeak(double limit) {
    if (information(2, 2) <= 0.0) {
      degenerate = true;
      return;
    }
    // Information on position alone, after marginalizing the heading.
    const Eigen::Matrix2d position = information.topLeftCorner<2, 2>() -
                                     information.topRightCorner<2, 1>() *
                                         information.bottomLeftCorner<1, 2>() / information(2, 2);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(position);
    for (int axis = 0; axis < 2; ++axis) {
      const double known = axes.eigenvalues()[axis];
      const double sigma =
          known > 0.0 ? 1.0 / std::sqrt(known) : std::numeric_limits<double>::infinity();
      weakest_sigma = axis == 0 ? sigma : weakest_sigma;
      if (sigma > limit) {
        degenerate = true;
        leaveOut(axes.eigenvectors().col(axis));
      }
    }
  }

  void leaveOut(const Eigen::Vector2d& direction) {
    Eigen::Matrix3d keep = Eigen::Matrix3d::Identity();
    keep.topLeftCorner<2, 2>() -= direction * direction.transpose();
    information = (keep * information * keep).eval();
    gradient = (keep * gradient).eval();
  }
};

void ScanMatcherOptions::visit(OptionVisitor& visitor) {
  visitor.integer({"samples", "1", "poses sampled for each scan (thesis 3.3.1: 300)"}, samples,
                  {1, 100000});
  visitor.integer({"refinement_steps", "1",
                   "maximum number of Gauss-Newton steps at each resolution; 0: the best sample as "
                   "it is (thesis)"},
                  refinement_steps, {0, 100});
  visitor.number({"point_sigma", "m", "standard deviation of an end point about the surface it hit",
                  Tier::kPublic},
                 point_sigma, {0.005, 2.0});
  visitor.number({"information_share", "1",
                  "share of the end points' information that counts: their errors are not "
                  "independent (shape of the surface, pose of earlier scans)"},
                 information_share, {0.001, 1.0});
  visitor.number({"degenerate_sigma", "m",
                  "a direction in which the scan alone would locate the vehicle worse than this "
                  "(along a corridor, a guard rail) is left to the prediction"},
                 degenerate_sigma, {0.01, 1000.0});
  visitor.number({"min_maturity", "1",
                  "with odometry: weight of surfaces that have just come into view, and so may "
                  "move, relative to the visible ones that have been hit longest, up to "
                  "static_after; 1: all are equal (thesis)"},
                 min_maturity, {0.001, 1.0});
  visitor.integer({"min_points", "1", "minimum number of end points on known surfaces for a match"},
                  min_points, {1, 10000});
}

ScanMatcher::ScanMatcher(const Checked<ScanMatcherOptions>& options) : options_(*options) {}

Pose2 ScanMatcher::bestSample(const Task& task, Random& random) const {
  const PoseWithCovariance& prediction = task.prediction;
  const Eigen::Matrix3d spread = prediction.covariance.llt().matrixL();
  std::vector<Pose2> samples{prediction.pose};
  samples.reserve(static_cast<std::size_t>(options_.samples));
  for (int i = 1; i < options_.samples; ++i) {
    // In sequence, because compilers may evaluate arguments in any order.
    const double turn = random.normal(1.0);
    const double y = random.normal(1.0);
    const double x = random.normal(1.0);
    samples.push_back(shifted(prediction.pose, spread * Eigen::Vector3d(x, y, turn)));
  }
  return task.scorer.bestOf(samples);
}

ScanMatcher::Normal ScanMatcher::sumOf(const Task& task, const Pose2& pose,
                                       Resolution resolution) const {
  const OccupancyMap& map = task.map;
  Normal normal;
  const double variance = options_.point_sigma * options_.point_sigma;
  const double aperture = (resolution == Resolution::kCell ? 1.0 : 3.0) * map.window().cell_size;
  const Eigen::Matrix2d rotation = pose.rotation();
  for (const EndPoint& point : task.points) {
    const Point2 turned = rotation * point.position;
    const Point2 end = pose.position() + turned;
    const auto surface =
        resolution == Resolution::kCell ? map.nearestHits(end) : map.hitsAround(end);
    if (!surface) {
      continue;
    }
    const Eigen::Matrix2d information = informationOf(
        surface->covariance + rotation * point.sampling * rotation.transpose(), variance, aperture);
    const Point2 error = surface->mean - end;
    const double distance = error.dot(information * error);
    // Points that do not fit are faded out (this Gaussian is the score of Biber & Strasser). Recent
    // surfaces may be movers: vehicles driving alongside at equal speed would drag the pose along.
    const double maturity =
        surface->maturity < task.full_maturity ? surface->maturity / task.full_maturity : 1.0;
    const double weight = std::exp(-0.5 * distance) * std::max(options_.min_maturity, maturity);
    normal.max_maturity = std::max(normal.max_maturity, surface->maturity);
    normal.add(weight * information, turned, error);
    const double point_weight = weight * information.trace();
    normal.weight += point_weight;
    normal.age += point_weight * surface->age;
    ++normal.points;
  }
  normal.information *= options_.information_share;
  normal.gradient *= options_.information_share;
  return normal;
}

ScanMatcher::Normal ScanMatcher::linearize(const Task& task, const Pose2& pose,
                                           Resolution resolution) const {
  Normal normal = sumOf(task, pose, resolution);
  normal.leaveOutWeak(options_.degenerate_sigma);
  return normal;
}

Pose2 ScanMatcher::refine(const Task& task, Resolution resolution, Pose2 pose) const {
  const Eigen::Matrix3d prior = task.prediction.covariance.inverse();
  for (int step = 0; step < options_.refinement_steps; ++step) {
    const Normal normal = linearize(task, pose, resolution);
    const Eigen::Vector3d move =
        (normal.information + prior)
            .ldlt()
            .solve(normal.gradient + prior * differenceOf(pose, task.prediction.pose));
    pose = shifted(pose, move);
    if (move.cwiseAbs().maxCoeff() < kConverged) {
      break;
    }
  }
  return pose;
}

MatchResult ScanMatcher::match(const OccupancyMap& map, const std::vector<EndPoint>& points,
                               const Prediction& prediction, Random& random) const {
  MatchResult result{prediction.pose, {}};
  Task task{map, points, prediction.pose, {map, points}};
  Pose2 pose = bestSample(task, random);
  const Normal coarse = sumOf(task, pose, Resolution::kNeighborhood);
  result.quality.matched_points = coarse.points;
  if (coarse.points < options_.min_points) {
    return result;
  }
  // In a new map nothing is mature yet.
  task.full_maturity =
      prediction.measured ? std::max(coarse.max_maturity, options_.min_maturity) : 0.0;
  for (const Resolution resolution : {Resolution::kNeighborhood, Resolution::kCell}) {
    pose = refine(task, resolution, pose);
  }
  const Normal normal = linearize(task, pose, Resolution::kCell);
  if (normal.points < options_.min_points) {
    return result;
  }
  result.pose.pose = pose;
  result.pose.covariance = (normal.information + prediction.pose.covariance.inverse()).inverse();
  result.quality = {normal.points,
                    task.scorer.score(pose),
                    true,
                    normal.weakest_sigma,
                    normal.degenerate,
                    normal.weight > 0.0 ? normal.age / normal.weight : 0.0};
  return result;
}

}  // namespace datmo
