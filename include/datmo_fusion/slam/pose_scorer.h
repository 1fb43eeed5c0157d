// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/grid/occupancy_map.h"
#include "datmo_fusion/slam/end_points.h"

namespace datmo {

/// Scores poses by the mean occupancy of the map at the ends of a scan's beams (thesis eq. 3.1.17).
///
/// The best of many poses is found without looking up all ends of all of them (branch and bound):
/// the ends of a pose are summed in an order that is spread over the scan, and a pose is dropped as
/// soon as the remaining ends could not make it the best, even if they were in the most occupied
/// cells within reach of all poses. The result is identical, because sums of occupancies are exact:
/// a float takes 24 of a double's 53 bits.
class PoseScorer {
 public:
  /// `map` must outlive this object.
  PoseScorer(const OccupancyMap& map, const std::vector<EndPoint>& points);

  /// Returns the score of a pose, 0 to 1; 0 without points.
  double score(const Pose2& pose) const;

  /// Returns the first one with the highest score; `poses` must not be empty.
  Pose2 bestOf(const std::vector<Pose2>& poses) const;

 private:
  /// Points whose cells are computed together.
  static constexpr std::size_t kBlock = 16;
  using Block = std::array<double, kBlock>;

  /// How far at most the ends move relative to the first pose.
  struct Reach {
    double x = 0.0;     ///< m
    double y = 0.0;     ///< m
    double turn = 0.0;  ///< rad
  };
  static Reach reachOf(const std::vector<Pose2>& poses);

  /// For each block of points, an upper bound of what it and the following ones add to a score.
  std::vector<double> boundsFrom(const Pose2& first, const Reach& reach, std::size_t poses) const;
  double maxAround(const Point2& end, double x_reach, double y_reach) const;

  /// m
  Point2 pointAt(std::size_t index) const;

  /// Sum of the occupancies of at most kBlock points from `begin` on.
  double sumOfBlock(std::size_t begin, const Pose2& pose, const Eigen::Matrix2d& rotation) const;

  const OccupancyMap& map_;
  std::size_t count_;
  double max_distance_;  ///< m, from the map's origin, of points within the range of a cell index
  double max_range_ = 0.0;  ///< m
  std::vector<double> x_;   ///< of the points, in cells; padded to full blocks
  std::vector<double> y_;
};

}  // namespace datmo
