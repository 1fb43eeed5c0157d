// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/convert/message_conversion.h"

#include <limits>

#include "grid/small_map.h"
#include "message_samples.h"
#include <gtest/gtest.h>

namespace datmo::message_conversion_test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const Stamp kStamp = Stamp::fromSeconds(samples::kStart);

TEST(PoseConversion, RoundTrip) {
  for (const double heading : {0.0, 1.0, -2.5, kPi}) {
    const Pose2 back = fromMessage(toMessage(Pose2(3.0, -4.0, heading)));
    EXPECT_EQ(back.position(), Point2(3.0, -4.0));
    EXPECT_NEAR(angleBetween(back.heading(), heading), 0.0, 1e-12);
  }
}

TEST(PoseConversion, InvalidPosesAreRefused) {
  geometry_msgs::Pose pose = toMessage(Pose2());
  pose.orientation.w = 0.0;
  EXPECT_EQ(samples::reasonOf([&] { fromMessage(pose); }), "bad_pose") << "quaternion of zeros";
  pose = toMessage(Pose2());
  pose.position.x = kNan;
  EXPECT_EQ(samples::reasonOf([&] { fromMessage(pose); }), "bad_pose");
  pose = toMessage(Pose2());
  pose.orientation.z = kNan;
  EXPECT_EQ(samples::reasonOf([&] { fromMessage(pose); }), "bad_pose");
  pose = toMessage(Pose2());
  pose.position.y = -1e308;
  EXPECT_EQ(samples::reasonOf([&] { fromMessage(pose); }), "bad_pose") << "its square is none";
}

TEST(PoseConversion, InvalidCovariancesAreRefused) {
  const geometry_msgs::PoseWithCovariance good = toMessage(PoseWithCovariance());
  EXPECT_EQ(samples::reasonOf([&] { fromMessage(good); }), "");
  for (const double bad : {kNan, -1.0, 1e308}) {
    geometry_msgs::PoseWithCovariance pose = good;
    pose.covariance[7] = bad;
    EXPECT_EQ(samples::reasonOf([&] { fromMessage(pose); }), "bad_pose") << bad;
  }
}

TEST(PoseConversion, CovarianceIsAtXYAndYaw) {
  PoseWithCovariance pose;
  pose.covariance << 1, 2, 3, 2, 4, 5, 3, 5, 6;
  const auto message = toMessage(pose);
  EXPECT_EQ(message.covariance[0], 1.0);
  EXPECT_EQ(message.covariance[1], 2.0);
  EXPECT_EQ(message.covariance[5], 3.0);
  EXPECT_EQ(message.covariance[7], 4.0);
  EXPECT_EQ(message.covariance[11], 5.0);
  EXPECT_EQ(message.covariance[35], 6.0);
  EXPECT_EQ(message.covariance[14], 0.0) << "z";
}

TEST(OdometryConversion, AcceptsSpeedAndYawRateAndRefusesNanAndImpossibleValues) {
  nav_msgs::Odometry message;
  message.header.stamp = ros::Time(samples::kStart);
  message.twist.twist.linear.x = 8.0;
  message.twist.twist.angular.z = 0.1;
  const OdometrySample sample = toSample(message);
  EXPECT_EQ(sample.stamp, kStamp);
  EXPECT_EQ(sample.twist.forward_speed, 8.0);
  EXPECT_EQ(sample.twist.yaw_rate, 0.1);
  message.twist.twist.angular.z = kNan;
  EXPECT_EQ(samples::reasonOf([&] { toSample(message); }), "bad_odometry");
  message.twist.twist.angular.z = 0.1;
  message.twist.twist.linear.x = -1.0e30;
  EXPECT_EQ(samples::reasonOf([&] { toSample(message); }), "bad_odometry");
}

LabeledScan labeledScan() {
  LabeledScan scan;
  scan.stamp = kStamp;
  scan.base_in_map.pose = Pose2(10.0, 20.0, 0.5);
  scan.base_in_map.covariance.diagonal() << 0.1, 0.2, 0.3;
  scan.scanner_in_base = Pose2(3.5, 0.0, 0.25);
  scan.field = {-1.25, 0.125, 21, 0.5, 40.0, 80.0};
  scan.blind_beams = {0, 20};
  scan.points.push_back({Point2(5.0, 1.0), 1.5, 0.75, 7, PointState::kMoving});
  return scan;
}

TEST(LabeledScanConversion, RoundTrip) {
  const LabeledScanMessage message = toMessage(labeledScan(), "base_link", "map");
  EXPECT_EQ(message.header.frame_id, "base_link");
  EXPECT_EQ(message.map_frame, "map");
  const LabeledScan back = fromMessage(message);
  EXPECT_EQ(back.stamp, kStamp);
  EXPECT_NEAR(back.base_in_map.pose.heading(), 0.5, 1e-12);
  EXPECT_EQ(back.base_in_map.covariance, labeledScan().base_in_map.covariance);
  EXPECT_NEAR(back.scanner_in_base.heading(), 0.25, 1e-12);
  EXPECT_EQ(back.field.first_bearing, -1.25);
  EXPECT_EQ(back.field.beam_spacing, 0.125);
  EXPECT_EQ(back.field.beams, 21U);
  EXPECT_EQ(back.field.min_range, 0.5);
  EXPECT_EQ(back.field.free_range, 40.0);
  EXPECT_EQ(back.field.range, 80.0);
  EXPECT_EQ(back.blind_beams, labeledScan().blind_beams);
  ASSERT_EQ(back.points.size(), 1U);
  EXPECT_EQ(back.points[0].position, Point2(5.0, 1.0));
  EXPECT_EQ(back.points[0].range, 1.5);
  EXPECT_EQ(back.points[0].bearing, 0.75);
  EXPECT_EQ(back.points[0].beam, 7U);
  EXPECT_EQ(back.points[0].state, PointState::kMoving);
}

TEST(LabeledScanConversion, BadPointsAreRefused) {
  LabeledScanMessage message = toMessage(labeledScan(), "base_link", "map");
  message.points[0].state = 3;
  EXPECT_EQ(samples::reasonOf([&] { fromMessage(message); }), "bad_point");
  message.points[0].state = 0;
  message.points[0].y = std::numeric_limits<float>::infinity();
  EXPECT_EQ(samples::reasonOf([&] { fromMessage(message); }), "bad_point");
  message.points[0].y = 2000.0F;
  EXPECT_EQ(samples::reasonOf([&] { fromMessage(message); }), "bad_point");
  message.points[0].y = 900.0F;
  message.points[0].range = 1001.0F;
  EXPECT_EQ(samples::reasonOf([&] { fromMessage(message); }), "bad_point");
  message.points[0].range = 1.5F;
  message.points[0].bearing = 1e30F;
  EXPECT_EQ(samples::reasonOf([&] { fromMessage(message); }), "bad_point");
}

TEST(LabeledScanConversion, AScannerFarFromItsVehicleIsRefused) {
  LabeledScanMessage message = toMessage(labeledScan(), "base_link", "map");
  message.scanner.x = 101.0;
  EXPECT_EQ(samples::reasonOf([&] { fromMessage(message); }), "bad_pose");
}

TEST(LabeledScanConversion, BadFieldsAreRefused) {
  const auto reason = [](const std::function<void(ScanFieldMessage&)>& spoil) {
    LabeledScanMessage message = toMessage(labeledScan(), "base_link", "map");
    spoil(message.field);
    return samples::reasonOf([&] { fromMessage(message); });
  };
  EXPECT_EQ(reason([](auto& field) { field.first_bearing = kNan; }), "bad_field");
  EXPECT_EQ(reason([](auto& field) { field.range = std::numeric_limits<float>::infinity(); }),
            "bad_field");
  EXPECT_EQ(reason([](auto& field) { field.free_range = 1001.0F; }), "bad_field");
  EXPECT_EQ(reason([](auto& field) { field.min_range = -1.0F; }), "bad_field");
  EXPECT_EQ(reason([](auto& field) { field.beam_spacing = 0.0; }), "bad_field");
  EXPECT_EQ(reason([](auto& field) { field.beams = 65537; }), "bad_field");
  EXPECT_EQ(reason([](auto& field) { field.beams = 65536; }), "");
  EXPECT_EQ(reason([](auto& field) { field.first_bearing = 1e300; }), "bad_field");
  EXPECT_EQ(reason([](auto& field) { field.beam_spacing = -1e300; }), "bad_field");
  EXPECT_EQ(reason([](auto& field) { field.beam_time = -1e-3; }), "bad_field");
  EXPECT_EQ(reason([](auto& field) { field.beam_time = 1.0; }), "bad_field") << "21 s in all";
}

TEST(LabeledScanConversion, AScannerNowhereIsRefused) {
  LabeledScanMessage message = toMessage(labeledScan(), "base_link", "map");
  message.scanner.theta = kNan;
  EXPECT_EQ(samples::reasonOf([&] { fromMessage(message); }), "bad_pose");
}

/// Percent of the cell that holds a point of the map frame, from the message alone.
int occupancyAt(const nav_msgs::OccupancyGrid& grid, const Point2& point) {
  const auto& origin = grid.info.origin.position;
  const double size = grid.info.resolution;
  const auto column = static_cast<std::size_t>((point.x() - origin.x) / size);
  const auto row = static_cast<std::size_t>((point.y() - origin.y) / size);
  return grid.data.at(row * grid.info.width + column);
}

TEST(MapConversion, IsRightAfterTheWindowHasMoved) {
  OccupancyMapOptions options;
  options.window.length = 30.0;
  options.window.width = 60.0;
  OccupancyMap map(options);
  for (const double x : {0.1, 7.3, 14.5}) {
    map.centerOn(Point2(x, -x));
    const Pose2 base_in_map(x, -x, kPi / 2.0);
    Scan scan = samples::scanTo({Point2(6.05, 0.0)});
    scan.stamp = kStamp + x;
    map.update(scan, {PointState::kStatic}, base_in_map);
    const auto grid = toMessage(map, kStamp, "map");
    EXPECT_EQ(grid.header.frame_id, "map");
    EXPECT_EQ(grid.data.size(), grid.info.width * grid.info.height);
    EXPECT_EQ(grid.info.width, 100U) << "30 m of 0.3 m";
    EXPECT_EQ(grid.info.height, 200U);
    EXPECT_NEAR(grid.info.origin.position.x + 15.0, x, 2.0 * options.window.cell_size);
    EXPECT_GT(occupancyAt(grid, base_in_map * Point2(6.05, 0.0)), 50) << "the end";
    const int passed = occupancyAt(grid, base_in_map * Point2(3.0, 0.0));
    EXPECT_TRUE(passed >= 0 && passed < 50) << passed << ": the way there";
    EXPECT_EQ(occupancyAt(grid, base_in_map * Point2(8.0, 0.0)), -1) << "behind it";
  }
}

}  // namespace
}  // namespace datmo::message_conversion_test
