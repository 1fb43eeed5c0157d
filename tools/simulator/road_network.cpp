// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/road_network.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "datmo_fusion/common/cross.h"

namespace datmo::simulator {

namespace {

/// Step (m) in which lines along roads are sampled to find where other roads open into them.
constexpr double kSampleStep = 0.25;
/// Points closer than this (m) to the straight line between their neighbors are omitted.
constexpr double kStraight = 1e-3;
/// Number of segments of a corner between two curbs.
constexpr int kCornerPieces = 6;
/// Zebra stripes and the gaps between them, m (Richtlinien fuer Fussgaengerueberwege: 0.5 m).
constexpr double kStripe = 0.5;

/// Whether a point is at most `reach` m beside the road's center line; a road has square ends.
bool covers(const Road& road, const Point2& point, double reach) {
  const Polyline line = road.middle.points(kSampleStep);
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Point2 leg = line[i + 1] - line[i];
    const double along = (point - line[i]).dot(leg) / leg.squaredNorm();
    const bool behind = along < 0.0;
    const bool beyond = along > 1.0;
    if ((behind && i == 0) || (beyond && i + 2 == line.size())) {
      continue;
    }
    const Point2 nearest = line[i] + std::clamp(along, 0.0, 1.0) * leg;
    if ((point - nearest).norm() <= reach) {
      return true;
    }
  }
  return false;
}

/// The same line without points that are on the straight line between their neighbors.
Polyline simplified(const Polyline& line) {
  Polyline simple{line.front()};
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    const Point2 edge = (line[i + 1] - simple.back()).normalized();
    const Point2 to_point = line[i] - simple.back();
    if (std::abs(cross(edge, to_point)) > kStraight) {
      simple.push_back(line[i]);
    }
  }
  simple.push_back(line.back());
  return simple;
}

/// The intersection of two lines given by points and directions; for parallel lines, the midpoint
/// of the points.
Point2 meetingPoint(const Point2& a, const Point2& a_ahead, const Point2& b,
                    const Point2& b_ahead) {
  const double denominator = cross(a_ahead, b_ahead);
  if (std::abs(denominator) < kStraight) {
    return 0.5 * (a + b);
  }
  const Point2 between = b - a;
  return a + a_ahead * cross(between, b_ahead) / denominator;
}

/// A bend from one point to another that starts and ends along the lines to `control` (a quadratic
/// Bezier curve).
Polyline bend(const Point2& from, const Point2& control, const Point2& to) {
  Polyline line;
  for (int i = 0; i <= kCornerPieces; ++i) {
    const double t = static_cast<double>(i) / kCornerPieces;
    line.emplace_back((1.0 - t) * (1.0 - t) * from + 2.0 * t * (1.0 - t) * control + t * t * to);
  }
  return line;
}

}  // namespace

RoadNetwork::RoadNetwork(std::vector<Road> roads, std::vector<Crossing> crossings)
    : roads_(std::move(roads)), crossings_(std::move(crossings)) {
  for (std::size_t i = 0; i < roads_.size(); ++i) {
    addCurbs(i);
  }
  addCorners();
}

void RoadNetwork::addCurbs(std::size_t road) {
  const Road& street = roads_[road];
  const double length = street.middle.length();
  for (const double left : {0.5 * street.width, -0.5 * street.width}) {
    const Point2 first = beside(road, 0.0, left).position();
    const Point2 last = beside(road, length, left).position();
    for (const Polyline& curb : sideLines(road, left, 0.0, length, street.corner_radius)) {
      if (curb.front() != first) {
        curb_ends_.push_back({road, curb.front(), (curb[0] - curb[1]).normalized()});
      }
      if (curb.back() != last) {
        curb_ends_.push_back(
            {road, curb.back(), (curb.back() - curb[curb.size() - 2]).normalized()});
      }
      curbs_.push_back(curb);
    }
  }
}

void RoadNetwork::addCorners() {
  for (std::size_t i = 0; i < curb_ends_.size(); ++i) {
    const CurbEnd& end = curb_ends_[i];
    std::size_t partner = i;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < curb_ends_.size(); ++j) {
      const double distance = (curb_ends_[j].position - end.position).norm();
      if (curb_ends_[j].road != end.road && distance < nearest) {
        partner = j;
        nearest = distance;
      }
    }
    const CurbEnd& other = curb_ends_[partner];
    if (partner > i) {
      curbs_.push_back(bend(end.position,
                            meetingPoint(end.position, end.ahead, other.position, other.ahead),
                            other.position));
    }
  }
}

std::vector<Box2> RoadNetwork::paint() const {
  std::vector<Box2> boxes;
  for (std::size_t i = 0; i < roads_.size(); ++i) {
    addDashes(i, boxes);
  }
  for (const Crossing& crossing : crossings_) {
    const double half = 0.5 * roads_[crossing.road].width;
    for (double left = -half + kStripe; left < half; left += 2.0 * kStripe) {
      boxes.push_back({beside(crossing.road, crossing.arc_length, left), crossing.length, kStripe});
    }
  }
  return boxes;
}

void RoadNetwork::addDashes(std::size_t road, std::vector<Box2>& boxes) const {
  const Road& street = roads_[road];
  if (street.dash_length == 0.0) {
    return;
  }
  const double period = street.dash_length + street.dash_gap;
  for (double arc_length = 0.5 * period; arc_length < street.middle.length();
       arc_length += period) {
    const bool on_crossing =
        std::any_of(crossings_.begin(), crossings_.end(), [&](const Crossing& crossing) {
          return crossing.road == road && std::abs(crossing.arc_length - arc_length) <
                                              0.5 * (crossing.length + street.dash_length);
        });
    const Pose2 middle = beside(road, arc_length, 0.0);
    if (!on_crossing && !onOtherRoad(road, middle.position(), street.corner_radius)) {
      boxes.push_back({middle, street.dash_length, street.paint_width});
    }
  }
}

Pose2 RoadNetwork::beside(std::size_t road, double arc_length, double left) const {
  return roads_[road].middle.at(arc_length).pose * Pose2(0.0, left, 0.0);
}

std::vector<Polyline> RoadNetwork::sideLines(std::size_t road, double left, double from, double to,
                                             double clearance) const {
  std::vector<Polyline> lines;
  Polyline line;
  const auto finish = [&lines, &line] {
    if (line.size() > 1) {
      lines.push_back(simplified(line));
    }
    line.clear();
  };
  const int steps = std::max(1, static_cast<int>(std::ceil((to - from) / kSampleStep)));
  for (int i = 0; i <= steps; ++i) {
    const Point2 point = beside(road, from + (to - from) * i / steps, left).position();
    if (onOtherRoad(road, point, clearance)) {
      finish();
    } else {
      line.push_back(point);
    }
  }
  finish();
  return lines;
}

bool RoadNetwork::onOtherRoad(std::size_t road, const Point2& point, double clearance) const {
  for (std::size_t i = 0; i < roads_.size(); ++i) {
    if (i != road && covers(roads_[i], point, 0.5 * roads_[i].width + clearance)) {
      return true;
    }
  }
  return false;
}

bool RoadNetwork::atIntersection(const Point2& point) const {
  for (std::size_t i = 0; i < roads_.size(); ++i) {
    if (covers(roads_[i], point, 0.5 * roads_[i].width) &&
        onOtherRoad(i, point, roads_[i].corner_radius)) {
      return true;
    }
  }
  return false;
}

}  // namespace datmo::simulator
