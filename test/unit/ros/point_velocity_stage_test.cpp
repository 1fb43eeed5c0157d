// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/point_velocity_stage.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "message_samples.h"
#include "monitor_counts.h"
#include <boost/make_shared.hpp>
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/velocity_conversion.h"

namespace datmo::point_velocity_stage_test {
namespace {

using samples::kStart;

constexpr int kColumns = 320;
constexpr int kRows = 240;
constexpr double kFocalLength = 300.0;  // px
constexpr double kBaseline = 0.3;       // m
constexpr int kBoardDisparity = 18;     // px: 5 m
constexpr double kBoardDepth = kFocalLength * kBaseline / kBoardDisparity;
constexpr double kPeriod = 0.1;  // s
/// px, to the right: 0.5 m/s.
constexpr int kBoardShift = 3;
constexpr double kBoardSpeed = kBoardShift / kFocalLength * kBoardDepth / kPeriod;

/// Gray levels that do not repeat, with corners of some pixels' size.
std::uint8_t texture(int row, int column, unsigned seed) {
  const auto cell = static_cast<unsigned>((row / 6) * 1000 + column / 6);
  std::minstd_rand random(cell * 7919U + seed);
  random.discard(3);
  return static_cast<std::uint8_t>(random() >> 8U);
}

/// Disparity of the wall, px: it increases from row to row, as with a single plane and a board in
/// front of it, motion of the board and of the camera would be indistinguishable.
int wallDisparity(int row) { return 3 + 2 * (row / 40); }

/// A wall, and a board in front of it that has moved by `shift`; seen by the `right` or the left
/// camera.
sensor_msgs::ImagePtr image(double seconds, int shift, bool right, const std::string& frame) {
  auto message = boost::make_shared<sensor_msgs::Image>();
  message->header.stamp = ros::Time(seconds);
  message->header.frame_id = frame;
  message->encoding = "mono8";
  message->width = message->step = kColumns;
  message->height = kRows;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const int on_board = column - shift - 120 + (right ? kBoardDisparity : 0);
      const bool board = on_board >= 0 && on_board < 90 && row >= 90 && row < 180;
      message->data.push_back(
          board ? texture(row, on_board, 2U)
                : texture(row, column + 100 + (right ? wallDisparity(row) : 0), 1U));
    }
  }
  return message;
}

sensor_msgs::CameraInfoPtr info(double seconds, bool right, const std::string& frame) {
  auto message = boost::make_shared<sensor_msgs::CameraInfo>();
  message->header.stamp = ros::Time(seconds);
  message->header.frame_id = frame;
  message->width = kColumns;
  message->height = kRows;
  const double shift = right ? -kFocalLength * kBaseline : 0.0;
  message->K = {kFocalLength, 0.0, 160.0, 0.0, kFocalLength, 120.0, 0.0, 0.0, 1.0};
  message->R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  message->P = {kFocalLength, 0.0, 160.0, shift, 0.0, kFocalLength, 120.0, 0.0, 0.0, 0.0, 1.0, 0.0};
  return message;
}

class PointVelocityStageTest : public testing::Test {
 protected:
  PointVelocityStageTest() {
    tf2_msgs::TFMessage mounts;
    mounts.transforms = {samples::transform("base_link", "camera", 2.0)};
    mounts.transforms[0].transform.rotation.x = -0.5;
    mounts.transforms[0].transform.rotation.y = 0.5;
    mounts.transforms[0].transform.rotation.z = -0.5;
    mounts.transforms[0].transform.rotation.w = 0.5;
    buffer_.addStatic(mounts);
  }

  /// The pair number `i`.
  sensor_msgs::PointCloud2Ptr takePair(int i, const std::string& frame = "camera") {
    const double seconds = kStart + i * kPeriod;
    for (const StereoSide side : {StereoSide::kLeft, StereoSide::kRight}) {
      const bool right = side == StereoSide::kRight;
      EXPECT_FALSE(stage_.handleInfo(side, info(seconds, right, frame)));
      const auto points = stage_.handleImage(side, image(seconds, i * kBoardShift, right, frame));
      if (right) {
        return points;
      }
      EXPECT_FALSE(points);
    }
    return nullptr;
  }

  /// Returns the median velocity to the left, m/s, of points as near as the board.
  static double boardSpeed(const sensor_msgs::PointCloud2& message) {
    std::vector<double> speeds;
    for (const PointVelocity& point : pointVelocities(message)) {
      if (std::abs(point.position.x() - 2.0 - kBoardDepth) < 1.0) {
        speeds.push_back(point.velocity.y());
      }
    }
    EXPECT_GT(speeds.size(), 20U);
    std::sort(speeds.begin(), speeds.end());
    return speeds.empty() ? 0.0 : speeds[speeds.size() / 2];
  }

  TransformBuffer buffer_{1.0};
  StageMonitor monitor_{"point_velocity"};
  PointVelocityStageOptions options_;
  PointVelocityStage stage_{options_, buffer_, monitor_};
};

TEST_F(PointVelocityStageTest, PairsOfImagesGivePointsWithVelocity) {
  const auto first = takePair(0);
  ASSERT_TRUE(first);
  EXPECT_TRUE(pointVelocities(*first).empty()) << "nothing to compare with";
  const auto second = takePair(1);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->header.frame_id, "base_link");
  EXPECT_NEAR(boardSpeed(*second), -kBoardSpeed, 0.1 * kBoardSpeed);
  EXPECT_EQ(monitor_.droppedCount(), 0U);
}

/// The interval between the compared images is the one by which velocities are divided.
TEST_F(PointVelocityStageTest, APairThatIsDroppedDoesNotScaleTheNextVelocities) {
  takePair(0);
  takePair(1);
  EXPECT_FALSE(takePair(2, "unknown"));
  EXPECT_EQ(samples::drops(monitor_, "missing_transform"), 1U);
  const auto next = takePair(3);
  ASSERT_TRUE(next);
  EXPECT_NEAR(boardSpeed(*next), -kBoardSpeed, 0.1 * kBoardSpeed);
}

TEST_F(PointVelocityStageTest, AnInvalidImageDoesNotBlockTheStampOfAGoodOne) {
  takePair(0);
  auto broken = image(kStart + kPeriod, 0, false, "camera");
  broken->data.pop_back();
  EXPECT_FALSE(stage_.handleImage(StereoSide::kLeft, broken));
  EXPECT_EQ(samples::drops(monitor_, "wrong_size"), 1U);
  EXPECT_TRUE(takePair(1));
  EXPECT_EQ(samples::drops(monitor_, "repeated_stamp"), 0U);
}

TEST_F(PointVelocityStageTest, ALongGapGivesNoPoints) {
  takePair(0);
  const auto late = takePair(10);
  ASSERT_TRUE(late);
  EXPECT_TRUE(pointVelocities(*late).empty());
}

TEST_F(PointVelocityStageTest, AJumpBackStartsOver) {
  takePair(1000);
  takePair(1001);
  const auto first = takePair(0);
  ASSERT_TRUE(first);
  EXPECT_TRUE(pointVelocities(*first).empty());
  EXPECT_EQ(samples::warnings(monitor_, "clock_restart"), 1U);
  EXPECT_NEAR(boardSpeed(*takePair(1)), -kBoardSpeed, 0.1 * kBoardSpeed);
}

}  // namespace
}  // namespace datmo::point_velocity_stage_test
