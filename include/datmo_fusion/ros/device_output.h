// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <ros/node_handle.h>

#include "datmo_fusion/device/device_data.h"
#include "datmo_fusion/ros/device_options.h"
#include "datmo_fusion/ros/stage/numbered_publisher.h"

namespace datmo {

/// Publishes a device's measurements as messages, on the topics of its kind: `scan`, `points`,
/// `gnss` and `twist`, or `twist` and what else a bus measures of the host.
class DeviceOutput {
 public:
  /// Advertises the topics, relative to `node`.
  DeviceOutput(ros::NodeHandle& node, const DeviceOptions& options);

  /// Full names of the topics.
  std::vector<std::string> topics() const;

  void publish(const DeviceMeasurement& measurement);

  /// Maximum number of measurements of this kind of device that wait for publication: at least a
  /// tenth of a second for scanners (10 Hz to 100 Hz) and receivers, a second for a bus at 100 Hz.
  static std::uint32_t queueSize(DeviceKind kind);

 private:
  /// Of a CAN bus, in addition to its motion.
  void advertiseHostSensors(ros::NodeHandle& node, const CanOptions& can);

  template <typename Data>
  void publish(const Data& data, Stamp stamp);
  void publish(const GroundVelocity& velocity, Stamp stamp);
  void publish(const VehicleTwist& twist, Stamp stamp);

  std::string frame_;
  NumberedPublisher output_;
  NumberedPublisher velocities_;    ///< only of a satellite receiver
  NumberedPublisher steering_;      ///< only of a bus
  NumberedPublisher acceleration_;  ///< the same
};

}  // namespace datmo
