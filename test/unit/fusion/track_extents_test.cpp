// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/track/track_extents.h"

#include "fusion_tracks.h"
#include <gtest/gtest.h>

namespace datmo::track_extents_test {
namespace {

constexpr double kRounding = 1e-9;
const Point2 kSensor(0.0, 0.0);

/// A lorry ahead, with its rear at x = 20 m, assumed to be this long.
Track lorry(double length) {
  Track track = carTrack(20.0 + 0.5 * length, 0.0, 10.0, 0.0);
  track.box.length = length;
  track.box.width = 2.5;
  track.covariance(0, 0) = 1e-14;  // its center is known
  track.covariance(1, 1) = 1e-14;
  return track;
}

TEST(TrackExtentsTest, AGuessedExtentCountsByTheCertaintyOfItsCenter) {
  // 7 m more; half of it if two standard deviations of the extent, four of the center, equal that.
  Track guessed = lorry(9.0);
  guessed.covariance(0, 0) = 1.75 * 1.75;
  Track rear = lorry(2.0);
  reconcileExtents(guessed, kSensor, rear, kSensor);
  EXPECT_NEAR(rear.box.length, 5.5, kRounding);
  EXPECT_NEAR(rear.state.x(), 22.75, kRounding);
}

TEST(TrackExtentsTest, AViewOfTheRearIsExtendedAwayFromTheSensor) {
  Track whole = lorry(9.0);
  Track rear = lorry(2.0);
  reconcileExtents(whole, kSensor, rear, kSensor);
  EXPECT_NEAR(rear.box.length, 9.0, kRounding);
  EXPECT_NEAR(rear.box.width, 2.5, kRounding);
  EXPECT_NEAR(rear.state.x(), 24.5, kRounding);
  EXPECT_NEAR(rear.box.center.x(), 24.5, kRounding);
  EXPECT_NEAR(rear.state.y(), 0.0, kRounding);
  // Uniform over 3.5 m: 12.25 / 12 m^2 more along the axis, nothing across.
  EXPECT_NEAR(rear.covariance(0, 0), 12.25 / 12.0, kRounding);
  EXPECT_NEAR(rear.covariance(1, 1), 0.0, kRounding);
  EXPECT_NEAR(whole.state.x(), 24.5, kRounding);
  EXPECT_NEAR(whole.covariance(0, 0), 0.0, kRounding);
}

TEST(TrackExtentsTest, IsTheSameWhicheverIsFirstAndWhereverTheFrontIs) {
  Track whole = lorry(9.0);
  Track rear = lorry(2.0);
  rear.box.center = Pose2(rear.box.center.position(), kPi);
  reconcileExtents(rear, kSensor, whole, kSensor);
  EXPECT_NEAR(rear.state.x(), 24.5, kRounding);
  EXPECT_NEAR(whole.state.x(), 24.5, kRounding);
}

TEST(TrackExtentsTest, FromTheOtherSideItGrowsTheOtherWay) {
  Track whole = lorry(9.0);
  Track front = lorry(9.0);
  front.box.length = 2.0;
  front.state.x() = 28.0;  // its front is at 29 m
  front.box.center = Pose2(28.0, 0.0, 0.0);
  reconcileExtents(whole, kSensor, front, Point2(50.0, 0.0));
  EXPECT_NEAR(front.state.x(), 24.5, kRounding);
}

TEST(TrackExtentsTest, AHeadingErrorOfAQuarterTurnDoesNotMatter) {
  Track whole = lorry(9.0);
  Track rear = lorry(2.0);
  rear.box = {Pose2(21.0, 0.0, 0.5 * kPi), 2.5, 2.0};
  rear.heading_variance = 0.5;
  reconcileExtents(whole, kSensor, rear, kSensor);
  EXPECT_NEAR(rear.box.width, 9.0, kRounding);
  EXPECT_NEAR(rear.box.length, 2.5, kRounding);
  EXPECT_NEAR(rear.state.x(), 24.5, kRounding);
}

TEST(TrackExtentsTest, AbreastTheCenterIsKeptAndLessCertain) {
  Track whole = lorry(9.0);
  Track part = lorry(9.0);
  part.box.length = 3.0;
  reconcileExtents(whole, kSensor, part, Point2(24.0, -10.0));
  EXPECT_NEAR(part.box.length, 9.0, kRounding);
  EXPECT_NEAR(part.state.x(), 24.5, kRounding);
  EXPECT_NEAR(part.covariance(0, 0), 36.0 / 12.0, kRounding);
}

TEST(TrackExtentsTest, EqualBoxesAndUnknownSensorsChangeNothing) {
  Track a = lorry(9.0);
  Track b = lorry(9.0);
  reconcileExtents(a, kSensor, b, kSensor);
  EXPECT_EQ(a.state, lorry(9.0).state);
  EXPECT_EQ(b.covariance, lorry(9.0).covariance);
  Track rear = lorry(2.0);
  reconcileExtents(a, kSensor, rear, std::nullopt);
  EXPECT_EQ(rear.state, lorry(2.0).state);
}

}  // namespace
}  // namespace datmo::track_extents_test
