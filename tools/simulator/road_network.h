// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "simulator/path.h"

#include "datmo_fusion/common/box2.h"

namespace datmo::simulator {

/// A street: its center line, its dimensions and its white paint.
struct Road {
  std::string name;
  Path middle;
  double width = 0.0;          ///< m, from curb to curb
  double corner_radius = 0.0;  ///< m, of the curbs where other roads join it
  double dash_length = 0.0;    ///< m, of the dashed center line; 0: none
  double dash_gap = 0.0;       ///< m
  double paint_width = 0.0;    ///< m, of the center line
};

/// A zebra crossing.
struct Crossing {
  std::size_t road = 0;
  double arc_length = 0.0;  ///< m along the road, of its center
  double length = 0.0;      ///< m along the road
};

/// The streets of a scene. Where two of them meet, curbs, fronts and paint are interrupted, and the
/// curbs are connected by rounded corners.
class RoadNetwork {
 public:
  RoadNetwork() = default;
  RoadNetwork(std::vector<Road> roads, std::vector<Crossing> crossings);

  const std::vector<Road>& roads() const { return roads_; }

  /// All curbs, with the corners of junctions as separate lines.
  const std::vector<Polyline>& curbs() const { return curbs_; }

  /// White paint: dashes and zebra stripes.
  std::vector<Box2> paint() const;

  /// Pose beside a road, heading along it; `left` in m from the center line, `arc_length` in m
  /// along it.
  Pose2 beside(std::size_t road, double arc_length, double left) const;

  /// The line along a road at `left` m from its center line, from one arc length (m) to another,
  /// except where it is on another road or closer to one than `clearance` (m).
  std::vector<Polyline> sideLines(std::size_t road, double left, double from, double to,
                                  double clearance) const;

  /// Whether a point on `road` is also on another one or closer to it than `clearance` (m).
  bool onOtherRoad(std::size_t road, const Point2& point, double clearance) const;

  /// Inside a junction, including the openings of its curbs.
  bool atIntersection(const Point2& point) const;

 private:
  void addCurbs(std::size_t road);
  void addCorners();
  void addDashes(std::size_t road, std::vector<Box2>& boxes) const;

  /// The end of a curb at a junction.
  struct CurbEnd {
    std::size_t road = 0;
    Point2 position = Point2::Zero();
    Point2 ahead = Point2::UnitX();  ///< into the junction, length 1
  };

  std::vector<Road> roads_;
  std::vector<Crossing> crossings_;
  std::vector<Polyline> curbs_;
  std::vector<CurbEnd> curb_ends_;
};

}  // namespace datmo::simulator
