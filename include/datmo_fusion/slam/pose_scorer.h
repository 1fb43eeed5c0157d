// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/grid/occupancy_map.h"
#include "datmo_fusion/slam/end_points.h"

namespace datmo {

/// Scores poses by the map's mean occupancy where the beams of a scan end (thesis eq. 3.1.17).
///
/// Of many poses the best one is found without looking up all ends of all of them: those of a pose
/// are added up in an order that is spread over the scan, and as soon as those that are left cannot
/// make it the best any more, be they in the most occupied cells within the reach of all poses, it
/// is left (branch and bound). What is found is the same, for sums of occupancies are exact: of a
/// double's 53 bits a float takes 24.
class PoseScorer {
 public:
  /// `map` must outlive this.
  PoseScorer(const OccupancyMap& map, const std::vector<EndPoint>& points);

  /// 0 to 1; 0 without points.
  double score(const Pose2& pose) const;

  /// The first one of those with the highest score; of at least one.
  Pose2 bestOf(const std::vector<Pose2>& poses) const;

 private:
  /// Points whose cells are found together.
  static constexpr std::size_t kBlock = 16;

  /// How far the ends lie from where they are seen from the first pose, at the most.
  struct Reach {
    double x = 0.0;     ///< m
    double y = 0.0;     ///< m
    double turn = 0.0;  ///< rad
  };
  static Reach reachOf(const std::vector<Pose2>& poses);

  /// For each block of points, how much those from it on add to a score at the most.
  std::vector<double> boundsFrom(const Pose2& first, const Reach& reach, std::size_t poses) const;
  double maxAround(const Point2& end, double x_reach, double y_reach) const;

  /// m
  Point2 pointAt(std::size_t index) const;

  struct Cells {
    std::array<int, kBlock> columns;
    std::array<int, kBlock> rows;
  };
  /// Of the points from `begin` on; all of them nearer than max_distance_.
  Cells cellsOfBlock(std::size_t begin, const Pose2& pose, const Eigen::Matrix2d& rotation) const;

  /// Sum of the occupancies of the points from `begin` on, kBlock of them at the most.
  double sumOfBlock(std::size_t begin, const Pose2& pose, const Eigen::Matrix2d& rotation) const;

  const OccupancyMap& map_;
  std::size_t count_;
  double max_distance_;     ///< m, from the map's origin, of points that a cell's index can hold
  double max_range_ = 0.0;  ///< m
  std::vector<double> x_;   ///< of the points, in cells; up to full blocks
  std::vector<double> y_;
};

}  // namespace datmo
