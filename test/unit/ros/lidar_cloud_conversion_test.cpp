// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/convert/lidar_cloud_conversion.h"

#include <limits>

#include "lidar_messages.h"
#include <gtest/gtest.h>

namespace datmo::lidar_cloud_conversion_test {
namespace {

using samples::addTimes;
using samples::cloud;
using samples::reasonOf;
using sensor_msgs::PointField;

constexpr double kMaxSweep = 0.25;  // s

sensor_msgs::PointCloud2 twoPoints() { return cloud({{1.0F, 2.0F, 3.0F}, {4.0F, 5.0F, 6.0F}}); }

TEST(LidarCloudConversionTest, PointsAreThoseOfTheMessage) {
  const ConvertedCloud converted = toLidarCloud(twoPoints(), kMaxSweep);
  ASSERT_EQ(converted.cloud.points->size(), 2U);
  EXPECT_EQ((*converted.cloud.points)[1].x, 4.0F);
  EXPECT_EQ((*converted.cloud.points)[1].z, 6.0F);
  EXPECT_TRUE(converted.cloud.times.empty());
  EXPECT_EQ(converted.time_field, "");
}

TEST(LidarCloudConversionTest, HolesAreLeftOutAndCounted) {
  auto message = cloud({{1.0F, 2.0F, 3.0F},
                        {std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F},
                        {0.0F, std::numeric_limits<float>::infinity(), 0.0F},
                        {4.0F, 5.0F, 6.0F}});
  addTimes<float>(message, "time", PointField::FLOAT32, {0.01F, 0.02F, 0.03F, 0.04F});
  const ConvertedCloud converted = toLidarCloud(message, kMaxSweep);
  EXPECT_EQ(converted.holes, 2U);
  ASSERT_EQ(converted.cloud.points->size(), 2U);
  EXPECT_EQ(converted.cloud.times, (std::vector<float>{0.01F, 0.04F}));
}

TEST(LidarCloudConversionTest, RowsOfAnOrganizedCloudFollowEachOther) {
  auto message = twoPoints();
  message.height = 2;
  message.width = 1;
  message.row_step = message.point_step;
  EXPECT_EQ((*toLidarCloud(message, kMaxSweep).cloud.points)[1].y, 5.0F);
}

TEST(LidarCloudConversionTest, TimesMayBeNanosecondsOrSecondsOrSince1970) {
  auto nanoseconds = twoPoints();
  addTimes<std::uint32_t>(nanoseconds, "t", PointField::UINT32, {0U, 50000000U});
  EXPECT_NEAR(toLidarCloud(nanoseconds, kMaxSweep).cloud.times.at(1), 0.05F, 1e-6F);
  auto seconds = twoPoints();
  addTimes<float>(seconds, "time", PointField::FLOAT32, {-0.1F, 0.0F});
  EXPECT_NEAR(toLidarCloud(seconds, kMaxSweep).cloud.times.at(0), -0.1F, 1e-6F);
  auto since_1970 = twoPoints();
  since_1970.header.stamp = ros::Time(1600000000.0);
  addTimes<double>(since_1970, "timestamp", PointField::FLOAT64, {1600000000.0, 1600000000.1});
  EXPECT_NEAR(toLidarCloud(since_1970, kMaxSweep).cloud.times.at(1), 0.1F, 1e-5F);
}

TEST(LidarCloudConversionTest, TimesFarFromTheStampDoNotCostTheCloud) {
  auto message = twoPoints();
  addTimes<float>(message, "time", PointField::FLOAT32, {0.0F, 7.0F});
  const ConvertedCloud converted = toLidarCloud(message, kMaxSweep);
  ASSERT_TRUE(converted.unusable_times);
  EXPECT_EQ(converted.unusable_times->reason(), "bad_point_times");
  EXPECT_TRUE(converted.cloud.times.empty());
  EXPECT_EQ(converted.cloud.points->size(), 2U);
}

TEST(LidarCloudConversionTest, ATimeFieldBeyondThePointIsIgnored) {
  auto message = twoPoints();
  addTimes<float>(message, "time", PointField::FLOAT32, {0.0F, 0.0F});
  message.fields.back().offset = message.point_step - 1;
  EXPECT_EQ(toLidarCloud(message, kMaxSweep).time_field, "");
}

TEST(LidarCloudConversionTest, InvalidCloudsAreRefused) {
  EXPECT_EQ(reasonOf([] { toLidarCloud(cloud({}), kMaxSweep); }), "empty_cloud");
  auto big_endian = twoPoints();
  big_endian.is_bigendian = 1;
  EXPECT_EQ(reasonOf([&] { toLidarCloud(big_endian, kMaxSweep); }), "big_endian");
  auto no_height = twoPoints();
  no_height.fields[2].name = "intensity";
  EXPECT_EQ(reasonOf([&] { toLidarCloud(no_height, kMaxSweep); }), "missing_field");
  auto doubles = twoPoints();
  doubles.fields[0].datatype = PointField::FLOAT64;
  EXPECT_EQ(reasonOf([&] { toLidarCloud(doubles, kMaxSweep); }), "wrong_field_type");
  auto cut = twoPoints();
  cut.data.pop_back();
  EXPECT_EQ(reasonOf([&] { toLidarCloud(cut, kMaxSweep); }), "wrong_size");
}

}  // namespace
}  // namespace datmo::lidar_cloud_conversion_test
