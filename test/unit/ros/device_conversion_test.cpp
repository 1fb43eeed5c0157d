// SPDX-License-Identifier: BSD-3-Clause
// Measurements of devices, as messages that the stages subscribe to.
#include "datmo_fusion/ros/convert/device_conversion.h"

#include <limits>

#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/earth_conversion.h"
#include "datmo_fusion/ros/convert/lidar_cloud_conversion.h"
#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo::device_conversion_test {
namespace {

const Stamp kStamp = Stamp::fromSeconds(1.7e9);

TEST(DeviceConversionTest, ACloudIsReadWithTheTimesOfItsPoints) {
  DeviceCloud cloud;
  cloud.points = {{1.0F, 2.0F, 3.0F, 77.0F, 0.0F, 5}, {4.0F, 5.0F, 6.0F, 78.0F, 0.05F, 6}};
  const auto message = toMessage(cloud, kStamp, "roof");
  EXPECT_EQ(message->header.frame_id, "roof");
  EXPECT_EQ(message->data.size(), std::size_t{message->row_step} * message->height);
  const ConvertedCloud converted = toLidarCloud(*message, 0.25);
  EXPECT_EQ(converted.time_field, "time");
  EXPECT_FALSE(converted.unusable_times);
  EXPECT_EQ(converted.cloud.times, (std::vector<float>{0.0F, 0.05F}));
  ASSERT_EQ(converted.cloud.points->size(), 2U);
  EXPECT_FLOAT_EQ((*converted.cloud.points)[1].z, 6.0F);
}

TEST(DeviceConversionTest, AScanHasItsLastBeamAtItsLastAngle) {
  DeviceScan scan;
  scan.first_bearing = -1.0;
  scan.beam_spacing = 0.5;
  scan.beam_time = 0.001;
  scan.scan_time = 0.04;
  scan.max_range = 20.0;
  scan.ranges = {1.0F, std::numeric_limits<float>::infinity(), 3.0F};
  const auto message = toMessage(scan, kStamp, "laser");
  EXPECT_FLOAT_EQ(message->angle_max, 0.0F);
  EXPECT_EQ(message->ranges, scan.ranges);
  EXPECT_TRUE(message->intensities.empty());
}

TEST(DeviceConversionTest, APositionIsConvertedAndAMissingOneRefused) {
  const SatelliteFix fix{SatelliteFix::Kind::kDifferential, 45.0, 5.0, 250.0, 1.5, 2.0, 9};
  const auto message = toMessage(fix, kStamp, "antenna");
  EXPECT_NEAR(positionOf(*message).altitude, 250.0, 1e-9);
  EXPECT_NEAR(covarianceOf(*message, 9.0)(1, 1), 2.25, 1e-9);
  const auto none = toMessage(SatelliteFix(), kStamp, "antenna");
  EXPECT_EQ(none->position_covariance_type, sensor_msgs::NavSatFix::COVARIANCE_TYPE_UNKNOWN);
  EXPECT_THROW(positionOf(*none), InputError);
}

TEST(DeviceConversionTest, AVehiclesTwistIsInItsOwnFrame) {
  const auto message = toMessage(VehicleTwist{-2.0, 0.1, 0, {}, {}}, kStamp, "laser");
  EXPECT_EQ(toStamp(message->header.stamp), kStamp);
  EXPECT_TRUE(message->header.frame_id.empty());
  EXPECT_EQ(message->twist.linear.x, -2.0);
  EXPECT_EQ(message->twist.angular.z, 0.1);
}

}  // namespace
}  // namespace datmo::device_conversion_test
