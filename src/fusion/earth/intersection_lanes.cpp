// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/earth/intersection_lanes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "datmo_fusion/fusion/wire/wire_error.h"

namespace datmo {

namespace {

constexpr double kMinStep = 0.01;  ///< m; closer nodes are merged

/// Points from the lane's own nodes; empty if they are unusable.
std::vector<Point2> pointsOf(const MapLane& lane, const Point2& reference,
                             const LocalPlane& plane) {
  std::vector<Point2> points;
  Point2 at = reference;
  for (const MapNode& node : lane.nodes) {
    const GeodeticPosition position = geodeticOf(node.y, node.x);
    if (node.is_geodetic && !isValid(position)) {
      return {};
    }
    at = node.is_geodetic ? plane.toPlane(position)
                          : Point2(at + kItsCentimeter * Point2(static_cast<double>(node.x),
                                                                static_cast<double>(node.y)));
    if (points.empty() || (at - points.back()).norm() >= kMinStep) {
      points.push_back(at);
    }
  }
  return points;
}

std::vector<Point2> pointsOf(const MapLane& lane, const MapIntersection& intersection,
                             const Point2& reference, const LocalPlane& plane) {
  if (!lane.computed) {
    return pointsOf(lane, reference, plane);
  }
  const MapComputedLane& computed = *lane.computed;
  const auto other =
      std::find_if(intersection.lanes.begin(), intersection.lanes.end(),
                   [&computed](const MapLane& one) { return one.id == computed.reference; });
  if (other == intersection.lanes.end() || computed.is_changed) {
    return {};
  }
  std::vector<Point2> points = pointsOf(*other, reference, plane);
  for (Point2& point : points) {
    point +=
        kItsCentimeter * Point2(static_cast<double>(computed.x), static_cast<double>(computed.y));
  }
  return points;
}

/// Whether a lane is for vehicles, or shared by them.
bool isForVehicles(const MapLane& lane) {
  constexpr std::int64_t kMotorVehicles = 1 << 6;  // the fourth of ten flags
  return (lane.direction & MapLane::kIngress) != 0 &&
         (lane.type == MapLane::kVehicle || (lane.sharing & kMotorVehicles) != 0);
}

}  // namespace

ApproachLanes approachLanes(const MapIntersection& intersection, const LocalPlane& plane) {
  const GeodeticPosition position = geodeticOf(intersection.latitude, intersection.longitude);
  if (!isValid(position)) {
    throw WireError("no_position", "intersection " + toText(intersection.id) +
                                       " without a reference point: expected one on the earth");
  }
  const Point2 reference = plane.toPlane(position);
  ApproachLanes found;
  for (const MapLane& lane : intersection.lanes) {
    if (!isForVehicles(lane)) {
      continue;
    }
    ApproachLane approach;
    approach.id = lane.id;
    approach.points = pointsOf(lane, intersection, reference, plane);
    approach.width = kItsCentimeter * static_cast<double>(intersection.lane_width.value_or(0));
    for (const MapConnection& connection : lane.connections) {
      const auto& groups = approach.groups;
      if (connection.group &&
          std::find(groups.begin(), groups.end(), *connection.group) == groups.end()) {
        approach.groups.push_back(*connection.group);
      }
    }
    if (approach.points.size() < 2) {
      ++found.left_out;
    } else {
      found.lanes.push_back(approach);
    }
  }
  return found;
}

LanePosition positionOn(const ApproachLane& lane, const Point2& point) {
  LanePosition best;
  double nearest = std::numeric_limits<double>::infinity();
  double before = 0.0;  // m, from the stop line to the segment
  for (std::size_t i = 0; i + 1 < lane.points.size(); ++i) {
    const Point2 step = lane.points[i + 1] - lane.points[i];
    const double length = step.norm();
    const Point2 outward = step / length;
    const Point2 from_start = point - lane.points[i];
    const double along = from_start.dot(outward);
    const bool is_last = i + 2 == lane.points.size();
    const double inner = i == 0 ? along : std::max(along, 0.0);
    const double used = is_last ? inner : std::min(inner, length);
    const double lateral = (from_start - used * outward).norm();
    if (lateral < nearest) {
      nearest = lateral;
      best = {before + used, lateral, std::atan2(-outward.y(), -outward.x()),
              std::max(used - length, 0.0)};
    }
    before += length;
  }
  return best;
}

}  // namespace datmo
