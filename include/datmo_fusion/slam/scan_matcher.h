// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <vector>

#include <Eigen/Core>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/random.h"
#include "datmo_fusion/grid/occupancy_map.h"
#include "datmo_fusion/slam/end_points.h"

namespace datmo {

struct ScanMatcherOptions {
  int samples = 300;               ///< poses drawn per scan
  int refinement_steps = 10;       ///< maximum
  double point_sigma = 0.2;        ///< m
  double information_share = 0.5;  ///< 0 to 1
  double degenerate_sigma = 0.5;   ///< m
  double min_maturity = 0.02;      ///< 0 to 1
  int min_points = 5;              ///< minimum for a match

  void visit(OptionVisitor& visitor);
};

/// A predicted pose of the vehicle in the map.
struct Prediction {
  PoseWithCovariance pose;  ///< its covariance positive definite
  /// By odometry. It separates moving objects from static surfaces; without it, surfaces that have
  /// just come into view count in full, because in a turn there may be no others.
  bool measured = true;
};

/// How well a scan fits the map.
struct MatchQuality {
  int matched_points = 0;  ///< end points that lie on surfaces of the map
  double score = 0.0;      ///< 0 to 1, mean occupancy of the map at the ends of the scan's beams
  bool accepted = false;   ///< false: the pose is just the prediction
  /// m, standard deviation of the position by the match alone, in its least observable direction;
  /// infinite if unobservable (a corridor, a guard rail).
  double weakest_sigma = std::numeric_limits<double>::infinity();
  bool degenerate = false;   ///< that direction was taken from the prediction
  double surface_age = 0.0;  ///< s, mean of the surfaces, by their information on position
};

/// The pose at which a scan fits the map best, in the map frame, and its uncertainty.
struct MatchResult {
  PoseWithCovariance pose;
  MatchQuality quality;
};

/// Finds the pose at which a scan fits the map best, near a predicted one.
///
/// First the thesis's method (3.1.1, eq. 3.1.15 and 3.1.17): poses are drawn from the prediction,
/// each is scored by the map's occupancy at the beams' ends, and the best one is taken. Then the
/// pose is refined to subcell accuracy by Gauss-Newton on the distances of the end points to the
/// mean of the hits around them, weighted by their spread (the normal distributions transform:
/// Biber & Strasser, 2003; Stoyanov et al. 2012), with the prediction as prior: first with all hits
/// in the 3 x 3 cells around a point, which has a wide basin of convergence but rounds off corners,
/// then with those of the nearest cell. A direction that the match hardly observes (along a
/// corridor, a guard rail) is taken from the prediction (solution remapping: Zhang, Kaess & Singh
/// 2016), which the covariance reflects.
class ScanMatcher {
 public:
  /// Throws OptionError.
  explicit ScanMatcher(const Checked<ScanMatcherOptions>& options);

  /// Matches the end points. If too few lie on known surfaces, returns the prediction, not
  /// accepted.
  MatchResult match(const OccupancyMap& map, const std::vector<EndPoint>& points,
                    const Prediction& prediction, Random& random) const;

 private:
  struct Normal;

  /// Which hits of the map an end point is compared with.
  enum class Resolution {
    kNeighborhood,  ///< all in 3 x 3 cells: wide convergence
    kCell,          ///< those of the nearest cell: accurate
  };

  struct Task;

  /// Normal equations around this pose, without the direction that is hardly observed.
  Normal linearize(const Task& task, const Pose2& pose, Resolution resolution) const;
  Normal sumOf(const Task& task, const Pose2& pose, Resolution resolution) const;
  Pose2 bestSample(const Task& task, Random& random) const;
  Pose2 refine(const Task& task, Resolution resolution, Pose2 pose) const;

  ScanMatcherOptions options_;
};

}  // namespace datmo
