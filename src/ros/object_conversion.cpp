#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <vector>

#include "message_parts.h"

#include "datmo_fusion/ros/message_conversion.h"

namespace datmo {

namespace {

/// rad: a full turn in single precision may be a little more than one.
constexpr double kRounding = 1e-5;

geometry_msgs::Vector3 size(const Box2& box, double height) {
  geometry_msgs::Vector3 result;
  result.x = box.length;
  result.y = box.width;
  result.z = height;
  return result;
}

ObjectMessage toMessage(const Object& object) {
  ObjectMessage message;
  message.pose = toMessage(object.box.centre);
  message.size = size(object.box, object.height);
  Eigen::Map<Eigen::Matrix<double, 2, 2, Eigen::RowMajor>>(message.position_covariance.data()) =
      object.position_covariance;
  message.heading_variance = object.heading_variance;
  std::copy(object.side_variance.begin(), object.side_variance.end(),
            message.side_variance.begin());
  message.classification = static_cast<std::uint8_t>(object.object_class);
  message.class_probability = static_cast<float>(object.class_probability);
  message.dynamic_state = static_cast<std::uint8_t>(object.dynamic_state);
  message.moving_fraction = static_cast<float>(object.moving_fraction);
  message.log_odds = static_cast<float>(object.log_odds);
  message.delay = static_cast<float>(object.delay);
  message.sensors = object.sensors;
  for (const Point2& point : object.points) {
    geometry_msgs::Point32 end;
    end.x = static_cast<float>(point.x());
    end.y = static_cast<float>(point.y());
    message.points.push_back(end);
  }
  return message;
}

/// A value beyond the last one that has a name is not known (zero in both enumerations).
template <typename Enumeration>
Enumeration named(std::uint8_t value, Enumeration last) {
  return value <= static_cast<std::uint8_t>(last) ? static_cast<Enumeration>(value)
                                                  : Enumeration::kUnknown;
}

Pose2 boxCentre(const geometry_msgs::Pose& pose) {
  const auto& q = pose.orientation;
  return {pose.position.x, pose.position.y, 2.0 * std::atan2(q.z, q.w)};
}

Object fromMessage(const ObjectMessage& message) {
  Object object;
  object.box = {boxCentre(message.pose), message.size.x, message.size.y};
  object.position_covariance = Eigen::Map<const Eigen::Matrix<double, 2, 2, Eigen::RowMajor>>(
      message.position_covariance.data());
  object.heading_variance = message.heading_variance;
  std::copy(message.side_variance.begin(), message.side_variance.end(),
            object.side_variance.begin());
  object.height = message.size.z;
  object.object_class = classFromMessage(message.classification);
  object.class_probability = message.class_probability;
  object.dynamic_state = named(message.dynamic_state, DynamicState::kMoving);
  object.moving_fraction = message.moving_fraction;
  object.log_odds = message.log_odds;
  object.delay = message.delay;
  object.sensors = message.sensors;
  for (const auto& point : message.points) {
    object.points.emplace_back(point.x, point.y);
  }
  return object;
}

FieldOfViewMessage toMessage(const SensorView& view) {
  FieldOfViewMessage message;
  message.sensor = view.sensor;
  message.pose = toPose2D(view.field.sensor_in_base);
  message.least_bearing = static_cast<float>(view.field.least_bearing);
  message.most_bearing = static_cast<float>(view.field.most_bearing);
  message.sure_range = static_cast<float>(view.field.sure_range);
  message.range = static_cast<float>(view.field.range);
  return message;
}

/// NaN compares false with everything.
bool isValid(const FieldOfViewMessage& view) {
  const geometry_msgs::Pose2D& pose = view.pose;
  const double width = static_cast<double>(view.most_bearing) - view.least_bearing;
  return std::isfinite(pose.x + pose.y + pose.theta) && std::isfinite(view.least_bearing) &&
         width > 0.0 && width <= 2.0 * kPi + kRounding && view.sure_range >= 0.0F &&
         view.sure_range <= view.range && std::isfinite(view.range);
}

SensorView fromMessage(const FieldOfViewMessage& message) {
  const geometry_msgs::Pose2D& pose = message.pose;
  return {message.sensor,
          {Pose2(pose.x, pose.y, pose.theta), message.least_bearing, message.most_bearing,
           message.sure_range, message.range}};
}

template <std::size_t count>
std::vector<float> toFloats(const std::array<double, count>& values) {
  std::vector<float> result;
  std::transform(values.begin(), values.end(), std::back_inserter(result),
                 [](double value) { return static_cast<float>(value); });
  return result;
}

PathPointMessage toMessage(const PathPoint& point) {
  PathPointMessage message;
  message.stamp = toTime(point.stamp);
  message.pose = toPose2D(point.pose);
  return message;
}

TrackMessage toMessage(const Track& track) {
  TrackMessage message;
  message.id = track.id;
  message.pose = toMessage(track.box.centre);
  message.size = size(track.box, track.height);
  message.velocity = planar(track.state(2), track.state(3));
  message.acceleration = planar(track.state(4), track.state(5));
  message.yaw_rate = track.yaw_rate;
  Eigen::Map<Eigen::Matrix<double, kTrackState, kTrackState, Eigen::RowMajor>>(
      message.covariance.data()) = track.covariance;
  message.moving = track.moving;
  message.heading_variance = track.heading_variance;
  message.mode_probabilities = toFloats(track.mode_probabilities);
  const auto& classes = track.class_probabilities;
  const auto most_likely = std::max_element(classes.begin(), classes.end());
  message.classification = static_cast<std::uint8_t>(most_likely - classes.begin());
  message.class_probability = static_cast<float>(*most_likely);
  message.class_probabilities = toFloats(classes);
  message.existence_probability = static_cast<float>(track.existence_probability);
  message.age = ros::Duration(track.age);
  message.since_update = ros::Duration(track.since_update);
  message.hits = track.hits;
  message.sensors = track.sensors;
  for (const PathPoint& point : track.history) {
    message.history.push_back(toMessage(point));
  }
  return message;
}

}  // namespace

ObjectClass classFromMessage(std::uint8_t value) { return named(value, ObjectClass::kPole); }

ObjectArray toMessage(const ObjectList& list, const std::string& base_frame) {
  ObjectArray message;
  message.header = header(list.stamp, base_frame);
  for (const SensorView& view : list.views) {
    message.views.push_back(toMessage(view));
  }
  for (const Object& object : list.objects) {
    message.objects.push_back(toMessage(object));
  }
  return message;
}

ObjectList fromMessage(const ObjectArray& message) {
  ObjectList list;
  list.stamp = toStamp(message.header.stamp);
  for (const FieldOfViewMessage& view : message.views) {
    if (isValid(view)) {
      list.views.push_back(fromMessage(view));
    }
  }
  for (const ObjectMessage& object : message.objects) {
    list.objects.push_back(fromMessage(object));
  }
  return list;
}

TrackArray toMessage(const TrackList& list, const std::string& fixed_frame) {
  TrackArray message;
  message.header = header(list.stamp, fixed_frame);
  for (const Track& track : list.tracks) {
    message.tracks.push_back(toMessage(track));
  }
  return message;
}

}  // namespace datmo
