// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/risk/box_contact.h"

#include <cmath>

#include <gtest/gtest.h>

#include "datmo_fusion/common/random.h"

namespace datmo::box_contact_test {
namespace {

constexpr BodySize kCar{2.0, 1.0};
constexpr BodySize kSquare{0.5, 0.5};
/// Contact is found to within 1 cm.
constexpr double kReached = 0.011;

BodyMove moveFromTo(const Point2& from, const Point2& to, const BodySize& size,
                    double heading = 0.0, double turn = 0.0) {
  return {bodyPose(from, heading), bodyPose(to, heading + turn), size};
}

TEST(Separation, IsTheGapBetweenParallelSides) {
  const Separation ahead = separation(bodyPose({0, 0}, 0), kCar, bodyPose({5, 0}, 0), kSquare);
  EXPECT_NEAR(ahead.gap, 2.5, 1e-12);
  EXPECT_NEAR(ahead.axis.x(), 1.0, 1e-12);
  const Separation right = separation(bodyPose({0, 0}, 0), kCar, bodyPose({0, -4}, 0), kSquare);
  EXPECT_NEAR(right.gap, 2.5, 1e-12);
  EXPECT_NEAR(right.axis.y(), -1.0, 1e-12);
}

TEST(Separation, OfATurnedBoxIsMeasuredFromItsCorner) {
  const double half_diagonal = kSquare.radius();
  const Separation gap = separation(bodyPose({0, 0}, 0), kCar, bodyPose({4, 0}, kPi / 4), kSquare);
  EXPECT_NEAR(gap.gap, 4.0 - 2.0 - half_diagonal, 1e-12);
}

TEST(FirstContact, IsWhenTheGapIsClosed) {
  const auto share =
      firstContact(moveFromTo({0, 0}, {0, 0}, kCar), moveFromTo({10, 0}, {0, 0}, kSquare));
  ASSERT_TRUE(share);
  EXPECT_NEAR(*share * 10.0, 7.5, kReached);
}

TEST(FirstContact, IsImmediateIfBoxesOverlap) {
  const auto share =
      firstContact(moveFromTo({0, 0}, {1, 0}, kCar), moveFromTo({1, 0}, {9, 0}, kSquare));
  ASSERT_TRUE(share);
  EXPECT_EQ(*share, 0.0);
}

TEST(FirstContact, DoesNotTunnel) {
  // One move right through the other: far apart at both ends.
  const auto share = firstContact(moveFromTo({-100, 0.3}, {100, 0.3}, kCar),
                                  moveFromTo({0, -80}, {0, 80}, kSquare));
  ASSERT_TRUE(share);
  EXPECT_GT(*share, 0.48);
  EXPECT_LT(*share, 0.5);
}

TEST(FirstContact, MissesByTwoCentimeters) {
  EXPECT_FALSE(
      firstContact(moveFromTo({0, 0}, {50, 0}, kCar), moveFromTo({50, 1.52}, {0, 1.52}, kSquare)));
  EXPECT_TRUE(
      firstContact(moveFromTo({0, 0}, {50, 0}, kCar), moveFromTo({50, 1.49}, {0, 1.49}, kSquare)));
}

TEST(FirstContact, SeesACornerThatSwingsOut) {
  // It turns on the spot: side by side there is a gap of 0.4 m, its corners need 0.74 m more.
  const BodyMove turning = moveFromTo({0, 0}, {0, 0}, kCar, 0.0, kQuarterTurn);
  const BodyMove still = moveFromTo({0, 1.9}, {0, 1.9}, kSquare);
  EXPECT_TRUE(firstContact(turning, still));
}

TEST(FirstContact, OfAnAbsurdSpinEnds) {
  // The circle of the long box meets the car, but the box itself spins far too fast to be followed.
  const BodySize pole{1e6, 1e-3};
  const BodyMove spinning = moveFromTo({0, 5}, {0, 5}, pole, 0.0, 1e12);
  const auto share = firstContact(moveFromTo({0, 0}, {0, 0}, kCar), spinning);
  ASSERT_TRUE(share);
  EXPECT_LE(*share, 1.0);
}

TEST(FirstContact, AgreesWithFineSteps) {
  Random random(7);
  for (int trial = 0; trial < 300; ++trial) {
    const auto point = [&] { return Point2(random.uniform(-6, 6), random.uniform(-6, 6)); };
    const BodyMove a =
        moveFromTo(point(), point(), kCar, random.uniform(-3, 3), random.uniform(-1, 1));
    const BodyMove b =
        moveFromTo(point(), point(), kSquare, random.uniform(-3, 3), random.uniform(-1, 1));
    double first = 2.0;
    for (int i = 0; i <= 4000 && first > 1.0; ++i) {
      const double share = i / 4000.0;
      if (separation(a.at(share), a.size, b.at(share), b.size).gap <= 0.0) {
        first = share;
      }
    }
    const auto found = firstContact(a, b);
    if (first <= 1.0) {
      ASSERT_TRUE(found) << trial;
      EXPECT_LE(*found, first + 1e-9) << trial;
    }
    if (found) {
      EXPECT_LE(separation(a.at(*found), a.size, b.at(*found), b.size).gap, kReached) << trial;
    }
  }
}

TEST(StruckSide, IsThatWhichFacesTheOther) {
  const BodyPose host = bodyPose({0, 0}, 0);
  EXPECT_EQ(struckSide(host, kCar, bodyPose({2.5, 0.4}, 0), kSquare), StruckSide::kFront);
  EXPECT_EQ(struckSide(host, kCar, bodyPose({-2.5, 0.4}, 0), kSquare), StruckSide::kRear);
  EXPECT_EQ(struckSide(host, kCar, bodyPose({1.5, 1.5}, 0), kSquare), StruckSide::kLeft);
  EXPECT_EQ(struckSide(host, kCar, bodyPose({1.5, -1.5}, 0), kSquare), StruckSide::kRight);
}

}  // namespace
}  // namespace datmo::box_contact_test
