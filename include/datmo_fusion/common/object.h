#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "datmo_fusion/common/box2.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/common/uniform.h"

namespace datmo {

/// What an object is (thesis 3.3.2); values as in Object.msg.
enum class ObjectClass : std::uint8_t { kUnknown, kPedestrian, kCyclist, kVehicle, kPole };

/// Whether an object moves over ground, as one measurement shows it; values as in Object.msg.
enum class DynamicState : std::uint8_t { kUnknown, kStatic, kMoving };

/// Variance of a heading modulo pi of which nothing is known, rad^2.
inline constexpr double kUnknownHeadingVariance = kPi * kPi * kUniformVariance;

/// One object that a sensor sees in one measurement, without memory of earlier ones.
struct Object {
  Box2 box;                                                           ///< frame of the list
  Eigen::Matrix2d position_covariance = Eigen::Matrix2d::Identity();  ///< m^2, of the box's centre
  double heading_variance = kUnknownHeadingVariance;                  ///< rad^2, modulo pi
  double height = 0.0;                                                ///< m, 0: not measured
  ObjectClass object_class = ObjectClass::kUnknown;
  double class_probability = 0.0;  ///< 0 to 1
  DynamicState dynamic_state = DynamicState::kUnknown;
  double moving_fraction = 0.0;      ///< 0 to 1, share of the points where the map is free
  std::vector<std::string> sensors;  ///< who saw it
  std::vector<Point2> points;        ///< m, frame of the list
};

/// The objects of one source at one time, in the vehicle's frame (base_link).
struct ObjectList {
  Stamp stamp;
  std::vector<Object> objects;
};

}  // namespace datmo
