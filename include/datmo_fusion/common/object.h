// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "datmo_fusion/common/box2.h"
#include "datmo_fusion/common/field_of_view.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/common/uniform.h"

namespace datmo {

/// What an object is (thesis 3.3.2); values as in Object.msg.
enum class ObjectClass : std::uint8_t { kUnknown, kPedestrian, kCyclist, kVehicle, kPole };
inline constexpr std::size_t kObjectClasses = 5;

/// Probability of each ObjectClass, in the order of its values.
using ClassProbabilities = std::array<double, kObjectClasses>;

/// One lower-case word.
const char* nameOf(ObjectClass object_class);

/// Whether an object moves over ground, as one measurement shows it; values as in Object.msg.
enum class DynamicState : std::uint8_t { kUnknown, kStatic, kMoving };

/// Variance of an unknown heading modulo pi, rad^2.
inline constexpr double kUnknownHeadingVariance = kPi * kPi * kUniformVariance;

/// The same modulo a quarter turn, if the length and width axes cannot be told apart.
inline constexpr double kUnknownAxisVariance = kQuarterTurn * kQuarterTurn * kUniformVariance;

/// Sides of a box, in the order used by all arrays of sides; the front is ahead along its heading.
enum class BoxSide : std::uint8_t { kFront, kRear, kLeft, kRight };
inline constexpr std::size_t kBoxSides = 4;

/// Variance of a side that was not seen: the object may extend farther, unseen.
inline constexpr double kHiddenSide = std::numeric_limits<double>::infinity();

/// Velocity over ground, as a sensor measured it on an object's surface.
struct MeasuredVelocity {
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();        ///< m/s, axes of the list's frame
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< m^2/s^2, positive definite
  /// 0 to 1, probability that the measurement belongs to something else, as reported by the sensor.
  double wrong_probability = 0.0;
};

/// One object that a sensor detects in one measurement, without memory of earlier ones.
struct Object {
  Box2 box;                                                           ///< frame of the list
  Eigen::Matrix2d position_covariance = Eigen::Matrix2d::Identity();  ///< m^2, of the box's center
  double heading_variance = kUnknownHeadingVariance;                  ///< rad^2, modulo pi
  /// m^2, of each side along its own normal, in addition to position_covariance, which moves the
  /// box as a whole. 0 or more, or kHiddenSide.
  std::array<double, kBoxSides> side_variance{};
  double height = 0.0;  ///< m, 0: not measured
  /// Of each class, from this measurement alone; of kUnknown: that it is none of the known ones.
  /// Sum at most 1; the remainder is spread evenly over all classes but the most likely one.
  ClassProbabilities class_probabilities{};
  DynamicState dynamic_state = DynamicState::kUnknown;
  std::optional<MeasuredVelocity> velocity;  ///< none: not measured
  double moving_fraction = 0.0;  ///< 0 to 1, share of its points in cells that the map has as free
  /// Log odds that the detection is an object at all, relative to the detector's average detection;
  /// 0: not reported.
  double log_odds = 0.0;
  /// Log odds that something at this position moves, relative to elsewhere, from the road geometry:
  /// below 0 on road borders and beyond; 0: unknown.
  double motion_log_odds = 0.0;
  /// s, mean time of its points relative to the list's stamp (negative: earlier). A moving object
  /// was at `box` at that time.
  double delay = 0.0;
  std::vector<std::string> sensors;  ///< that detected it
  std::vector<Point2> points;        ///< m, frame of the list

  /// Returns its most likely class; kUnknown if nothing is known.
  ObjectClass objectClass() const;
};

/// The field of view of one source of objects.
struct SensorView {
  std::string sensor;  ///< as in Object::sensors
  FieldOfView field;   ///< in the vehicle's frame at the list's stamp
};

/// The objects of one source at one time, in the vehicle's frame (base_link).
struct ObjectList {
  Stamp stamp;
  std::vector<Object> objects;
  std::vector<SensorView>
      views;  ///< of sensors that report objects, not beams; if not listed: unknown
};

}  // namespace datmo
