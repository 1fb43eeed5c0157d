// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/convert/road_conversion.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>

#include "message_parts.h"

#include "datmo_fusion/common/physical_bounds.h"
#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo {

namespace {

/// s: a day. A border unseen for longer is not followed, and the message's duration is bounded.
constexpr double kMaxUnseen = 86400.0;

/// False for NaN.
bool isProbability(double value) { return value >= 0.0 && value <= 1.0; }

InputError badBorder(const std::string& what, const std::string& expected) {
  return {"bad_border", "border of a road " + what + ": expected " + expected};
}

void checkAge(double unseen) {
  if (!(unseen >= 0.0 && unseen <= kMaxUnseen)) {
    throw badBorder("unseen for " + std::to_string(unseen) + " s",
                    "0 to " + std::to_string(kMaxUnseen) + " s");
  }
}

void checkPoints(const RoadBorderMessage& border) {
  const std::size_t count = border.points.size();
  if (count < 2) {
    throw badBorder("of " + std::to_string(count) + " points", "two at least");
  }
  if (border.sigma.size() != count) {
    throw badBorder("of " + std::to_string(count) + " points with " +
                        std::to_string(border.sigma.size()) + " standard deviations",
                    "one for each point");
  }
  for (const auto& point : border.points) {
    if (!isWithin(Point2(point.x, point.y), kMaxCoordinate)) {
      throw badBorder("at " + std::to_string(point.x) + ", " + std::to_string(point.y),
                      "coordinates within 20000 km");
    }
  }
  for (const float sigma : border.sigma) {
    if (!(sigma >= 0.0F && sigma <= kMaxCoordinate)) {
      throw badBorder("with a standard deviation of " + std::to_string(sigma) + " m",
                      "0 to 20000 km");
    }
  }
}

void check(const RoadBorderMessage& border) {
  if (border.side > RoadBorderMessage::RIGHT) {
    throw badBorder("on side " + std::to_string(border.side), "0 (left) or 1 (right)");
  }
  if (!isProbability(border.probability)) {
    throw badBorder("with probability " + std::to_string(border.probability), "0 to 1");
  }
  checkAge(border.unseen.toSec());
  checkPoints(border);
}

void check(const RoadBorders& message) {
  if (!isProbability(message.intersection_probability)) {
    throw InputError("bad_road", "intersection with probability " +
                                     std::to_string(message.intersection_probability) +
                                     ": expected 0 to 1");
  }
  std::size_t points = 0;
  for (const RoadBorderMessage& border : message.borders) {
    check(border);
    points += border.points.size();
  }
  if (points > kMaxBorderPoints) {
    throw InputError("many_points", "borders of " + std::to_string(points) +
                                        " points in all: expected at most " +
                                        std::to_string(kMaxBorderPoints));
  }
}

RoadBorderMessage toMessage(const RoadBorder& border) {
  RoadBorderMessage message;
  message.side = static_cast<std::uint8_t>(border.side);
  message.side_street = static_cast<std::uint8_t>(border.side_street);
  message.probability = static_cast<float>(border.probability);
  checkAge(border.unseen_for);  // the message's duration would throw another error
  message.unseen = ros::Duration(border.unseen_for);
  for (const BorderPoint& point : border.points) {
    geometry_msgs::Point32 position;
    position.x = static_cast<float>(point.position.x());
    position.y = static_cast<float>(point.position.y());
    message.points.push_back(position);
    message.sigma.push_back(static_cast<float>(point.sigma));
  }
  return message;
}

RoadBorder fromMessage(const RoadBorderMessage& message) {
  RoadBorder border;
  border.side = static_cast<RoadSide>(message.side);
  border.side_street = message.side_street != 0;
  border.probability = message.probability;
  border.unseen_for = message.unseen.toSec();
  border.points.reserve(message.points.size());
  std::transform(message.points.begin(), message.points.end(), message.sigma.begin(),
                 std::back_inserter(border.points), [](const auto& position, float sigma) {
                   return BorderPoint{{position.x, position.y}, sigma};
                 });
  return border;
}

DroppedObjectMessage toMessage(const DroppedObject& dropped) {
  DroppedObjectMessage message;
  message.object = toMessage(dropped.object);
  message.reason = static_cast<std::uint8_t>(dropped.reason);
  message.side = static_cast<std::uint8_t>(dropped.side);
  message.beyond = static_cast<float>(dropped.beyond);
  return message;
}

}  // namespace

RoadBorders toMessage(const RoadModel& road, const std::string& fixed_frame) {
  RoadBorders message;
  message.header = header(road.stamp, fixed_frame);
  message.at_intersection = road.at_intersection;
  message.intersection_probability = static_cast<float>(road.intersection_probability);
  for (const RoadBorder& border : road.borders) {
    message.borders.push_back(toMessage(border));
  }
  check(message);
  return message;
}

RoadModel fromMessage(const RoadBorders& message) {
  check(message);
  RoadModel road;
  road.stamp = toStamp(message.header.stamp);
  road.at_intersection = message.at_intersection != 0;
  road.intersection_probability = message.intersection_probability;
  for (const RoadBorderMessage& border : message.borders) {
    road.borders.push_back(fromMessage(border));
  }
  return road;
}

DroppedObjects toMessage(const std::vector<DroppedObject>& dropped, Stamp stamp,
                         const std::string& base_frame) {
  DroppedObjects message;
  message.header = header(stamp, base_frame);
  for (const DroppedObject& object : dropped) {
    message.objects.push_back(toMessage(object));
  }
  return message;
}

}  // namespace datmo
