// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/device_output.h"

#include <utility>
#include <variant>

#include "datmo_fusion/ros/convert/device_conversion.h"
#include "datmo_fusion/ros/convert/host_conversion.h"
#include "datmo_fusion/ros/convert/message_conversion.h"

namespace datmo {

namespace {

constexpr std::uint32_t kQueue = 10;
constexpr std::uint32_t kCanQueue = 100;

}  // namespace

DeviceOutput::DeviceOutput(ros::NodeHandle& node, const DeviceOptions& options)
    : frame_(options.frame) {
  const std::uint32_t queue = queueSize(options.device.kind);
  switch (options.device.kind) {
    case DeviceKind::kHokuyo:
    case DeviceKind::kSickLms:
      output_ = NumberedPublisher(node.advertise<sensor_msgs::LaserScan>("scan", queue));
      break;
    case DeviceKind::kVelodyne:
      output_ = NumberedPublisher(node.advertise<sensor_msgs::PointCloud2>("points", queue));
      break;
    case DeviceKind::kNmea:
      output_ = NumberedPublisher(node.advertise<sensor_msgs::NavSatFix>("gnss", queue));
      velocities_ = NumberedPublisher(node.advertise<geometry_msgs::TwistStamped>("twist", queue));
      break;
    case DeviceKind::kCan:
      output_ = NumberedPublisher(node.advertise<geometry_msgs::TwistStamped>("twist", queue));
      advertiseHostSensors(node, options.device.can);
      break;
  }
}

void DeviceOutput::advertiseHostSensors(ros::NodeHandle& node, const CanOptions& can) {
  if (can.publishesSteering()) {
    steering_ = NumberedPublisher(node.advertise<sensor_msgs::JointState>("steering", kCanQueue));
  }
  if (!can.acceleration.empty()) {
    acceleration_ = NumberedPublisher(
        node.advertise<geometry_msgs::AccelWithCovarianceStamped>("acceleration", kCanQueue));
  }
}

std::vector<std::string> DeviceOutput::topics() const {
  std::vector<std::string> topics;
  for (const NumberedPublisher* each : {&output_, &velocities_, &steering_, &acceleration_}) {
    if (std::string topic = each->topic(); !topic.empty()) {
      topics.push_back(std::move(topic));
    }
  }
  return topics;
}

std::uint32_t DeviceOutput::queueSize(DeviceKind kind) {
  return kind == DeviceKind::kCan ? kCanQueue : kQueue;
}

void DeviceOutput::publish(const DeviceMeasurement& measurement) {
  std::visit([&](const auto& data) { publish(data, measurement.stamp); }, measurement.data);
}

template <typename Data>
void DeviceOutput::publish(const Data& data, Stamp stamp) {
  output_.publish(toMessage(data, stamp, frame_));
}

void DeviceOutput::publish(const GroundVelocity& velocity, Stamp stamp) {
  velocities_.publish(toMessage(velocity, stamp, frame_));
}

void DeviceOutput::publish(const VehicleTwist& twist, Stamp stamp) {
  output_.publish(toMessage(twist, stamp, frame_));
  if (twist.steering) {
    steering_.publish(toSteering(twist.steering->value, twist.steering->stamp));
  }
  if (twist.acceleration) {
    acceleration_.publish(
        toAcceleration({twist.acceleration->value, 0.0}, twist.acceleration->stamp));
  }
}

}  // namespace datmo
