// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include "datmo_fusion/device/device_data.h"
#include "datmo_fusion/ros/device_options.h"

namespace datmo {

/// Publishes a device's measurements as messages, on the topics of its kind: `scan`, `points`,
/// `gnss` and `twist`, or `twist` and what else a bus measures of the host.
class DeviceOutput {
 public:
  /// Advertises the topics, relative to `node`.
  DeviceOutput(ros::NodeHandle& node, const DeviceOptions& options);

  /// Full names of the topics.
  std::vector<std::string> topics() const;

  void publish(const DeviceMeasurement& measurement) const;

  /// Maximum number of measurements of this kind of device that wait for publication: at least a
  /// tenth of a second for scanners (10 Hz to 100 Hz) and receivers, a second for a bus at 100 Hz.
  static std::uint32_t queueSize(DeviceKind kind);

 private:
  /// Of a CAN bus, in addition to its motion.
  void advertiseHostSensors(ros::NodeHandle& node, const CanOptions& can);

  template <typename Data>
  void publish(const Data& data, Stamp stamp) const;
  void publish(const GroundVelocity& velocity, Stamp stamp) const;
  void publish(const VehicleTwist& twist, Stamp stamp) const;

  std::string frame_;
  ros::Publisher output_;
  ros::Publisher velocities_;    ///< only of a satellite receiver
  ros::Publisher steering_;      ///< only of a bus
  ros::Publisher acceleration_;  ///< the same
};

}  // namespace datmo
