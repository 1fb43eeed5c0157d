// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <optional>

#include "message_parts.h"

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/common/physical_bounds.h"
#include "datmo_fusion/ros/convert/message_conversion.h"

namespace datmo {

namespace {

/// rad: a full turn in single precision may slightly exceed the exact one.
constexpr double kRounding = 1e-5;

/// A value beyond the last defined one becomes unknown (zero in both enumerations).
template <typename Enumeration>
Enumeration named(std::uint8_t value, Enumeration last) {
  return value <= static_cast<std::uint8_t>(last) ? static_cast<Enumeration>(value)
                                                  : Enumeration::kUnknown;
}

using RowMajor2 = Eigen::Matrix<double, 2, 2, Eigen::RowMajor>;

/// None if the message has none.
std::optional<MeasuredVelocity> velocityOf(const ObjectMessage& message) {
  const Eigen::Map<const RowMajor2> covariance(message.velocity_covariance.data());
  if ((covariance.array() == 0.0).all()) {
    return std::nullopt;
  }
  return MeasuredVelocity{
      {message.velocity.x, message.velocity.y}, covariance, message.velocity_wrong_probability};
}

/// All NaN if one is no probability, or if there is another number of classes.
ClassProbabilities classProbabilitiesOf(const ObjectMessage& message) {
  if (!(message.class_probability >= 0.0F && message.class_probability <= 1.0F)) {
    return fromFloats<kObjectClasses>({});
  }
  return message.class_probabilities.empty()
             ? reportedClass(classFromMessage(message.classification), message.class_probability)
             : fromFloats<kObjectClasses>(message.class_probabilities);
}

Object fromMessage(const ObjectMessage& message) {
  Object object;
  object.box = {boxCenter(message.pose), message.size.x, message.size.y};
  object.position_covariance = Eigen::Map<const RowMajor2>(message.position_covariance.data());
  object.heading_variance = message.heading_variance;
  std::copy(message.side_variance.begin(), message.side_variance.end(),
            object.side_variance.begin());
  object.height = message.size.z;
  object.class_probabilities = classProbabilitiesOf(message);
  object.dynamic_state = named(message.dynamic_state, DynamicState::kMoving);
  object.velocity = velocityOf(message);
  object.moving_fraction = message.moving_fraction;
  object.log_odds = message.log_odds;
  object.motion_log_odds = message.motion_log_odds;
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
  message.min_bearing = static_cast<float>(view.field.min_bearing);
  message.max_bearing = static_cast<float>(view.field.max_bearing);
  message.sure_range = static_cast<float>(view.field.sure_range);
  message.range = static_cast<float>(view.field.range);
  return message;
}

/// Comparisons with NaN are false.
bool isValid(const FieldOfViewMessage& view) {
  const geometry_msgs::Pose2D& pose = view.pose;
  const double width = static_cast<double>(view.max_bearing) - view.min_bearing;
  return std::abs(pose.x) <= kMaxCoordinate && std::abs(pose.y) <= kMaxCoordinate &&
         std::isfinite(pose.theta) && std::abs(view.min_bearing) <= kMaxBearing && width > 0.0 &&
         width <= 2.0 * kPi + kRounding && view.sure_range >= 0.0F &&
         view.sure_range <= view.range && std::isfinite(view.range);
}

SensorView fromMessage(const FieldOfViewMessage& message) {
  return {message.sensor,
          {toPose2(message.pose), message.min_bearing, message.max_bearing, message.sure_range,
           message.range}};
}

}  // namespace

ObjectMessage toMessage(const Object& object) {
  ObjectMessage message;
  message.pose = toMessage(object.box.center);
  message.size = size(object.box, object.height);
  Eigen::Map<RowMajor2>(message.position_covariance.data()) = object.position_covariance;
  message.heading_variance = object.heading_variance;
  std::copy(object.side_variance.begin(), object.side_variance.end(),
            message.side_variance.begin());
  setClasses(object.class_probabilities, message);
  message.dynamic_state = static_cast<std::uint8_t>(object.dynamic_state);
  if (object.velocity) {
    message.velocity.x = object.velocity->velocity.x();
    message.velocity.y = object.velocity->velocity.y();
    Eigen::Map<RowMajor2>(message.velocity_covariance.data()) = object.velocity->covariance;
    message.velocity_wrong_probability = static_cast<float>(object.velocity->wrong_probability);
  }
  message.moving_fraction = static_cast<float>(object.moving_fraction);
  message.log_odds = static_cast<float>(object.log_odds);
  message.motion_log_odds = static_cast<float>(object.motion_log_odds);
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

}  // namespace datmo
