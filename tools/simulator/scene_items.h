// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/road/road_model.h"

namespace datmo::simulator {

/// Single values of the entries of a scene file; lists (points, speeds) are read separately.

struct RoadItem {
  std::string name;
  double width = 10.0;
  double corner_radius = 5.0;
  double dash_length = 3.0;
  double dash_gap = 6.0;
  double paint_width = 0.12;

  void visit(OptionVisitor& visitor);
};

struct CrossingItem {
  std::string road;
  double at = 0.0;
  double length = 4.0;

  void visit(OptionVisitor& visitor);
};

/// Objects of one kind, or of several in turn, beside a road.
struct RowItem {
  std::string road;
  RoadSide side = RoadSide::kRight;
  double from = 0.0;
  double to = 0.0;
  double spacing = 10.0;
  double from_curb = 0.0;

  void visit(OptionVisitor& visitor);
};

/// A line of buildings or fences beside a road.
struct FrontItem {
  std::string road;
  RoadSide side = RoadSide::kRight;
  double from = 0.0;
  double to = 0.0;
  double from_curb = 4.0;
  double piece = 20.0;
  double gap = 0.0;
  double height = 8.0;

  void visit(OptionVisitor& visitor);
};

/// Something that follows a path.
struct ActorItem {
  std::string kind = "car";
  double corner_radius = 6.0;
  double start = 0.0;

  void visit(OptionVisitor& visitor);
};

/// A path for random traffic.
struct LaneItem {
  double corner_radius = 6.0;
  double min_speed = 10.0;
  double max_speed = 15.0;
  double min_ahead = 0.0;
  double max_ahead = 0.0;

  void visit(OptionVisitor& visitor);
};

}  // namespace datmo::simulator
