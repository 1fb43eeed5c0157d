// SPDX-License-Identifier: BSD-3-Clause
// Packets of Velodyne lidars: tables by model, points and their times, and invalid packets.
#include "datmo_fusion/device/velodyne_packet.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "device/device_reason.h"
#include "device/velodyne_packets.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"

namespace datmo::velodyne_packet_test {
namespace {

using samples::kDual;
using samples::kHdl32e;
using samples::kVlp16;
using samples::kVlp32c;
using samples::reasonOf;
using samples::VelodyneSample;

const VelodyneModel& model(std::uint8_t product) {
  const auto& models = velodyneModels();
  return *std::find_if(models.begin(), models.end(),
                       [product](const VelodyneModel& one) { return one.product == product; });
}

double elevation(const VelodyneModel& lidar, std::size_t laser) {
  return toDegrees(
      std::atan2(lidar.lasers[laser].sin_elevation, lidar.lasers[laser].cos_elevation));
}

std::vector<CloudPoint> pointsOf(const VelodyneSample& sample, std::size_t block) {
  const std::string bytes = sample.bytes();
  std::vector<CloudPoint> points;
  appendPoints(VelodynePacket(bytes), block, model(sample.product), RangeLimits(), 0.0, points);
  return points;
}

TEST(VelodyneModelTest, ElevationsAreThoseOfTheManuals) {
  EXPECT_NEAR(elevation(model(kVlp16), 0), -15.0, 1e-4);
  EXPECT_NEAR(elevation(model(kVlp16), 1), 1.0, 1e-4);
  EXPECT_NEAR(elevation(model(kVlp16), 14), -1.0, 1e-4);
  EXPECT_NEAR(elevation(model(kVlp16), 15), 15.0, 1e-4);
  EXPECT_NEAR(elevation(model(0x24), 0), -10.0, 1e-4);
  EXPECT_NEAR(elevation(model(0x24), 15), 10.0, 1e-4);
  EXPECT_NEAR(elevation(model(kVlp32c), 0), -25.0, 1e-4);
  EXPECT_NEAR(elevation(model(kVlp32c), 13), 1.333, 1e-4);
  EXPECT_NEAR(elevation(model(kVlp32c), 29), 15.0, 1e-4);
  EXPECT_NEAR(elevation(model(kHdl32e), 0), -30.67, 5e-3);
  EXPECT_NEAR(elevation(model(kHdl32e), 15), 0.0, 1e-4);
  EXPECT_NEAR(elevation(model(kHdl32e), 30), -10.67, 5e-3);
  EXPECT_NEAR(elevation(model(kHdl32e), 31), 10.67, 5e-3);
}

TEST(VelodyneModelTest, RingsRiseWithElevation) {
  for (const VelodyneModel& lidar : velodyneModels()) {
    std::set<unsigned> rings;
    for (std::size_t i = 0; i < lidar.lasers.size(); ++i) {
      rings.insert(lidar.lasers[i].ring);
      for (std::size_t j = 0; j < lidar.lasers.size(); ++j) {
        EXPECT_EQ(lidar.lasers[i].ring < lidar.lasers[j].ring,
                  elevation(lidar, i) < elevation(lidar, j));
      }
    }
    EXPECT_EQ(rings.size(), lidar.lasers.size()) << lidar.name;
  }
}

TEST(VelodynePacketTest, APointIsWhereTheManualHasIt) {
  VelodyneSample sample;  // 10 m
  sample.azimuth = 9000;  // to the right
  sample.step = 0;
  const std::vector<CloudPoint> points = pointsOf(sample, 0);
  ASSERT_EQ(points.size(), VelodyneModel::kChannels);
  EXPECT_NEAR(points[0].x, 0.0, 1e-5);
  EXPECT_NEAR(points[0].y, -10.0 * std::cos(degrees(15.0)), 1e-5);
  EXPECT_NEAR(points[0].z, -10.0 * std::sin(degrees(15.0)) + 0.0112, 1e-5);
  EXPECT_EQ(points[0].ring, 0U);
  EXPECT_EQ(points[15].ring, 15U);
  EXPECT_FLOAT_EQ(points[0].intensity, 77.0F);
}

TEST(VelodynePacketTest, AzimuthOffsetsOfLasersAreApplied) {
  VelodyneSample sample;
  sample.product = kVlp32c;
  sample.azimuth = 9000;  // to the right
  sample.step = 0;
  sample.distances = {2500};  // 10 m
  const std::vector<CloudPoint> points = pointsOf(sample, 0);
  ASSERT_EQ(points.size(), VelodyneModel::kChannels);
  // 10 cos(-25 deg) at 91.4 deg clockwise.
  EXPECT_NEAR(points[0].x, -0.221431, 1e-5);
  EXPECT_NEAR(points[0].y, -9.060372, 1e-5);
  EXPECT_NEAR(points[0].z, -4.226183, 1e-5);
  EXPECT_EQ(points[0].ring, 0U);
  // 10 cos(-1 deg) at 85.8 deg.
  EXPECT_NEAR(points[1].x, 0.732270, 1e-5);
  EXPECT_NEAR(points[1].y, -9.971626, 1e-5);
  EXPECT_NEAR(points[1].z, -0.174524, 1e-5);
  // 10 cos(15 deg) at 88.6 deg.
  EXPECT_NEAR(points[29].x, 0.235997, 1e-5);
  EXPECT_NEAR(points[29].y, -9.656375, 1e-5);
  EXPECT_NEAR(points[29].z, 2.588190, 1e-5);
  EXPECT_EQ(points[29].ring, 31U);
}

TEST(VelodynePacketTest, LasersThatFireTogetherHaveOneTime) {
  VelodyneSample sample;
  sample.product = kVlp32c;
  sample.step = 20;
  const std::vector<CloudPoint> points = pointsOf(sample, 0);
  ASSERT_EQ(points.size(), VelodyneModel::kChannels);
  EXPECT_FLOAT_EQ(points[1].time, 0.0F);
  EXPECT_NEAR(points[2].time, 2.304e-6, 1e-9);
  EXPECT_NEAR(points[3].time, 2.304e-6, 1e-9);
  EXPECT_NEAR(points[31].time, 15 * 2.304e-6, 1e-9);
  EXPECT_NEAR(toDegrees(std::atan2(-points[31].y, points[31].x)), -1.4 + 0.2 * 34.56 / 55.296,
              1e-4);
  EXPECT_NEAR(packetSpan(model(kVlp32c), false), 642.816e-6, 1e-9);
  EXPECT_NEAR(packetSpan(model(kVlp32c), true), 311.04e-6, 1e-9);
}

TEST(VelodynePacketTest, EachFiringHasItsOwnTimeAndAzimuth) {
  VelodyneSample sample;
  sample.azimuth = 35980;
  sample.step = 40;  // across 0
  const std::vector<CloudPoint> points = pointsOf(sample, 0);
  const auto azimuthOf = [](const CloudPoint& point) {
    return toDegrees(std::atan2(-point.y, point.x));
  };
  // The first laser of the second sequence, and the last one.
  EXPECT_NEAR(points[16].time, 55.296e-6, 1e-9);
  EXPECT_NEAR(azimuthOf(points[16]), -0.2 + 0.4 * 0.5, 1e-4);
  EXPECT_NEAR(points[31].time, 55.296e-6 + 15 * 2.304e-6, 1e-9);
  EXPECT_NEAR(azimuthOf(points[31]), -0.2 + 0.4 * (55.296 + 15 * 2.304) / 110.592, 1e-4);
  // The last block turns like the one before it.
  EXPECT_NEAR(azimuthOf(pointsOf(sample, 11)[16]), -0.2 + 11.5 * 0.4, 1e-4);
}

TEST(VelodynePacketTest, BlocksOfTwoReturnsAreOfOneFiring) {
  VelodyneSample sample;
  sample.product = kHdl32e;
  sample.returns = kDual;
  sample.second_distances = {4000, 5000};
  EXPECT_EQ(pointsOf(sample, 2).size(), 32U);
  EXPECT_EQ(pointsOf(sample, 3).size(), 16U);  // equal returns count once
  EXPECT_NEAR(pointsOf(sample, 2)[0].y, pointsOf(sample, 3)[0].y * 5000.0 / 4000.0, 1e-5);
  EXPECT_DOUBLE_EQ(blockOffset(model(kHdl32e), true, 3), 46.08e-6);
  EXPECT_NEAR(packetSpan(model(kHdl32e), false), 542.592e-6, 1e-9);  // the manual's
}

TEST(VelodynePacketTest, ReturnsOutOfRangeAreLeftOut) {
  VelodyneSample sample;
  sample.distances = {0, 100, 1000, 65535};  // none, 0.2 m, 2 m, 131 m
  EXPECT_EQ(pointsOf(sample, 0).size(), 8U);
}

TEST(VelodynePacketTest, InvalidPacketsAreRefused) {
  const std::string good = VelodyneSample().bytes();
  EXPECT_EQ(reasonOf([&] { VelodynePacket packet(good); }), "none");
  for (std::size_t length : {0U, 512U, 1205U}) {
    EXPECT_EQ(reasonOf([&] { VelodynePacket packet(good.substr(0, length)); }), "bad_packet");
  }
  EXPECT_EQ(reasonOf([&] { VelodynePacket packet(good + "x"); }), "bad_packet");
  std::string flag = good;
  flag[500] = 0;
  EXPECT_EQ(reasonOf([&] { VelodynePacket packet(flag); }), "bad_packet");
  std::string azimuth = good;
  azimuth[3] = '\xFF';
  EXPECT_EQ(reasonOf([&] { VelodynePacket packet(azimuth); }), "bad_packet");
  std::string hdl64 = good;
  hdl64[101] = '\xDD';
  EXPECT_EQ(reasonOf([&] { VelodynePacket packet(hdl64); }), "wrong_device");
}

}  // namespace
}  // namespace datmo::velodyne_packet_test
