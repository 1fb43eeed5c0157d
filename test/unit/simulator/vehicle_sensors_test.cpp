// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/vehicle_sensors.h"

#include <cmath>

#include "made_worlds.h"
#include <gtest/gtest.h>

namespace datmo::simulator::vehicle_sensors_test {
namespace {

VehicleSensorOptions ideal() {
  VehicleSensorOptions options;
  options.steering_noise = 0.0;
  options.acceleration_noise = 1e-3;
  return options;
}

/// Brakes from 8 m/s at 2 m/s^2 to a stop, in a bend of 14 m radius to the left.
World brakingInABend() {
  const Mover ego{objectKind("car"), Path({{0.0, 0.0}, {28.0, 0.0}, {28.0, 80.0}}, 14.0),
                  SpeedProfile({{0.0, 8.0}, {4.0, 0.0}}), 14.0};
  return World(RoadNetwork(), ego);
}

TEST(VehicleSensors, MeasureTheMotionOfTheHost) {
  const World world = brakingInABend();
  VehicleSensors sensors(ideal(), RandomStream(1, "vehicle_sensors"));
  sensors.measure(world.at(0.98));
  const HostMeasurement measured = sensors.measure(world.at(1.0));
  EXPECT_NEAR(measured.steering, std::atan(2.7 / 14.0), 1e-9);
  EXPECT_NEAR(measured.acceleration, -2.0, 0.01);
}

TEST(VehicleSensors, AStationaryVehicleKeepsItsSteering) {
  const World world = brakingInABend();
  VehicleSensors sensors(ideal(), RandomStream(1, "vehicle_sensors"));
  const double before = sensors.measure(world.at(3.5)).steering;
  const HostMeasurement at_rest = sensors.measure(world.at(5.0));
  EXPECT_EQ(at_rest.steering, before);
  EXPECT_NEAR(sensors.measure(world.at(5.02)).acceleration, 0.0, 0.01);
}

// Its message would state the covariance 0: unknown.
TEST(VehicleSensors, AnAccelerationWithoutNoiseIsRefused) {
  VehicleSensorOptions options = ideal();
  options.acceleration_noise = 0.0;
  EXPECT_THROW(VehicleSensors(options, RandomStream(1, "vehicle_sensors")), OptionError);
}

TEST(VehicleSensors, NoiseIsAsStated) {
  VehicleSensorOptions options = ideal();
  options.steering_noise = 0.5;
  options.acceleration_noise = 0.2;
  const World world(RoadNetwork(), egoAlongX(10.0));
  VehicleSensors sensors(options, RandomStream(1, "vehicle_sensors"));
  double steering = 0.0;
  double acceleration = 0.0;
  constexpr int kMeasurements = 20000;
  for (int i = 0; i < kMeasurements; ++i) {
    const HostMeasurement measured = sensors.measure(world.at(i / options.rate));
    steering += std::pow(measured.steering, 2);
    acceleration += std::pow(measured.acceleration, 2);
  }
  EXPECT_NEAR(std::sqrt(steering / kMeasurements), degrees(0.5), 1e-4);
  EXPECT_NEAR(std::sqrt(acceleration / kMeasurements), 0.2, 0.005);
}

}  // namespace
}  // namespace datmo::simulator::vehicle_sensors_test
