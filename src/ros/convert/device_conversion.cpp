// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/convert/device_conversion.h"

#include <cstddef>
#include <cstdint>

#include <boost/make_shared.hpp>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/convert/point_field.h"

namespace datmo {

namespace {

std::int8_t statusOf(SatelliteFix::Kind kind) {
  using sensor_msgs::NavSatStatus;
  switch (kind) {
    case SatelliteFix::Kind::kSatellites:
      return NavSatStatus::STATUS_FIX;
    case SatelliteFix::Kind::kDifferential:
      return NavSatStatus::STATUS_SBAS_FIX;
    case SatelliteFix::Kind::kRealTimeKinematic:
      return NavSatStatus::STATUS_GBAS_FIX;
    case SatelliteFix::Kind::kNone:
      break;
  }
  return NavSatStatus::STATUS_NO_FIX;
}

}  // namespace

sensor_msgs::LaserScanPtr toMessage(const DeviceScan& scan, Stamp stamp, const std::string& frame) {
  auto message = boost::make_shared<sensor_msgs::LaserScan>();
  const double last = static_cast<double>(scan.ranges.size()) - 1.0;
  message->header.stamp = toTime(stamp);
  message->header.frame_id = frame;
  message->angle_min = static_cast<float>(scan.first_bearing);
  message->angle_increment = static_cast<float>(scan.beam_spacing);
  message->angle_max = static_cast<float>(scan.first_bearing + scan.beam_spacing * last);
  message->time_increment = static_cast<float>(scan.beam_time);
  message->scan_time = static_cast<float>(scan.scan_time);
  message->range_min = static_cast<float>(scan.min_range);
  message->range_max = static_cast<float>(scan.max_range);
  message->ranges = scan.ranges;
  message->intensities = scan.intensities;
  return message;
}

sensor_msgs::PointCloud2Ptr toMessage(const DeviceCloud& cloud, Stamp stamp,
                                      const std::string& frame) {
  auto message = boost::make_shared<sensor_msgs::PointCloud2>();
  message->header.stamp = toTime(stamp);
  message->header.frame_id = frame;
  message->fields = {
      pointField("x", offsetof(CloudPoint, x)),
      pointField("y", offsetof(CloudPoint, y)),
      pointField("z", offsetof(CloudPoint, z)),
      pointField("intensity", offsetof(CloudPoint, intensity)),
      pointField("ring", offsetof(CloudPoint, ring), sensor_msgs::PointField::UINT16),
      pointField("time", offsetof(CloudPoint, time))};
  message->height = 1;
  message->width = static_cast<std::uint32_t>(cloud.points.size());
  message->point_step = sizeof(CloudPoint);
  message->row_step = message->point_step * message->width;
  message->is_bigendian = 0;
  message->is_dense = 1;
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(cloud.points.data());
  message->data.assign(bytes, bytes + message->row_step);
  return message;
}

sensor_msgs::NavSatFixPtr toMessage(const SatelliteFix& fix, Stamp stamp,
                                    const std::string& frame) {
  constexpr std::size_t kNextOfDiagonal = 4;
  auto message = boost::make_shared<sensor_msgs::NavSatFix>();
  message->header.stamp = toTime(stamp);
  message->header.frame_id = frame;
  message->status.status = statusOf(fix.kind);
  message->status.service = sensor_msgs::NavSatStatus::SERVICE_GPS;
  message->latitude = fix.latitude;
  message->longitude = fix.longitude;
  message->altitude = fix.altitude;
  message->position_covariance[0] = fix.sigma * fix.sigma;
  message->position_covariance[kNextOfDiagonal] = fix.sigma * fix.sigma;
  message->position_covariance[2 * kNextOfDiagonal] = fix.vertical_sigma * fix.vertical_sigma;
  message->position_covariance_type = fix.kind == SatelliteFix::Kind::kNone
                                          ? sensor_msgs::NavSatFix::COVARIANCE_TYPE_UNKNOWN
                                          : sensor_msgs::NavSatFix::COVARIANCE_TYPE_APPROXIMATED;
  return message;
}

geometry_msgs::TwistStampedPtr toMessage(const GroundVelocity& velocity, Stamp stamp,
                                         const std::string& /*frame*/) {
  auto message = boost::make_shared<geometry_msgs::TwistStamped>();
  message->header.stamp = toTime(stamp);
  message->twist.linear.x = velocity.speed;
  return message;
}

geometry_msgs::TwistStampedPtr toMessage(const VehicleTwist& twist, Stamp stamp,
                                         const std::string& /*frame*/) {
  auto message = boost::make_shared<geometry_msgs::TwistStamped>();
  message->header.stamp = toTime(stamp);
  message->twist.linear.x = twist.speed;
  message->twist.angular.z = twist.yaw_rate;
  return message;
}

}  // namespace datmo
