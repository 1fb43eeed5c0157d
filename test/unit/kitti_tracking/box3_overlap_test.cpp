// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/box3_overlap.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"

namespace datmo::kitti::box3_overlap_test {
namespace {

constexpr double kTiny = 1e-12;

/// 4 m long, 2 m wide, 1.5 m high.
Box3 car(double x = 0.0, double z = 0.0, double rotation_y = 0.0) {
  return {x, 1.7, z, 4.0, 2.0, 1.5, rotation_y};
}

Box3 square(double side, double rotation_y) { return {0.0, 0.0, 0.0, side, side, 1.0, rotation_y}; }

TEST(Overlap3d, IdenticalBoxes) {
  EXPECT_NEAR(overlap3d(car(), car()), 1.0, kTiny);
  EXPECT_NEAR(overlap3d(car(30.0, 40.0, 0.3), car(30.0, 40.0, 0.3)), 1.0, kTiny);
}

TEST(Overlap3d, ShiftedByAQuarterOfTheLength) {
  EXPECT_NEAR(overlap3d(car(), car(1.0)), 6.0 / 10.0, kTiny);
}

TEST(Overlap3d, ShiftedByHalfTheWidth) {
  EXPECT_NEAR(overlap3d(car(), car(0.0, 1.0)), 1.0 / 3.0, kTiny);
}

TEST(Overlap3d, LiftedByAThirdOfTheHeight) {
  Box3 lifted = car();
  lifted.y -= 0.5;
  EXPECT_NEAR(overlap3d(car(), lifted), 8.0 / 16.0, kTiny);
}

TEST(Overlap3d, StackedBoxesOnlyTouch) {
  Box3 above = car();
  above.y -= above.height;
  EXPECT_NEAR(overlap3d(car(), above), 0.0, kTiny);
}

TEST(Overlap3d, DisjointBoxes) {
  EXPECT_EQ(overlap3d(car(), car(10.0)), 0.0);
  EXPECT_EQ(overlap3d(car(), car(0.0, 2.5)), 0.0);  // circles around them intersect
}

TEST(Overlap3d, OneInsideTheOther) {
  EXPECT_NEAR(overlap3d(square(2.0, 0.0), square(1.0, 0.4)), 0.25, kTiny);
}

TEST(Overlap3d, LengthAcrossWidth) {
  EXPECT_NEAR(overlap3d(car(), car(0.0, 0.0, 0.5 * kPi)), 4.0 / 12.0, kTiny);
}

TEST(Overlap3d, SquaresTurnedBy45DegreesShareAnOctagon) {
  const double octagon = 2.0 * (std::sqrt(2.0) - 1.0);
  EXPECT_NEAR(groundIntersection(square(1.0, 0.0), square(1.0, 0.25 * kPi)), octagon, kTiny);
  EXPECT_NEAR(overlap3d(square(1.0, 0.0), square(1.0, 0.25 * kPi)), octagon / (2.0 - octagon),
              kTiny);
}

TEST(Overlap3d, TurnsFromXToMinusZ) {
  const Box3 ahead = car(0.0, 0.0, 0.25 * kPi);
  const Box3 probe{1.0, 1.7, -1.0, 0.1, 0.1, 1.5, 0.0};
  EXPECT_NEAR(groundIntersection(ahead, probe), 0.01, kTiny);
  EXPECT_EQ(groundIntersection(car(0.0, 0.0, -0.25 * kPi), probe), 0.0);
}

TEST(Overlap3d, TurnedByAHalfTurnIsTheSame) {
  EXPECT_NEAR(overlap3d(car(1.0, 2.0, 0.7), car(1.0, 2.0, 0.7 + kPi)), 1.0, kTiny);
}

TEST(Overlap3d, WithoutVolumeNothingOverlaps) {
  EXPECT_EQ(overlap3d(Box3(), Box3()), 0.0);
  EXPECT_EQ(overlap3d(Box3(), car()), 0.0);
}

TEST(Overlap3d, IsSymmetricAndAFraction) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> any(-2.0, 2.0);
  for (int i = 0; i < 1000; ++i) {
    const Box3 a = car(any(random), any(random), any(random));
    const Box3 b = car(any(random), any(random), any(random));
    const double overlap = overlap3d(a, b);
    EXPECT_NEAR(overlap, overlap3d(b, a), 1e-9);
    EXPECT_GE(overlap, 0.0);
    EXPECT_LE(overlap, 1.0 + kTiny);
  }
}

/// Two boxes moved and turned together overlap as before.
TEST(Overlap3d, DoesNotDependOnTheFrame) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> any(-1.5, 1.5);
  for (int i = 0; i < 200; ++i) {
    const double x = any(random);
    const double z = any(random);
    const double heading = any(random);
    const double turn = any(random);
    const Box3 moved = car(50.0 + std::cos(turn) * x + std::sin(turn) * z,
                           -20.0 - std::sin(turn) * x + std::cos(turn) * z, heading + turn);
    EXPECT_NEAR(overlap3d(car(), car(x, z, heading)), overlap3d(car(50.0, -20.0, turn), moved),
                1e-9);
  }
}

/// For coincident sides, rounding decides what is inside.
TEST(Overlap3d, NearlyTheSameBox) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> tiny(-1e-15, 1e-15);
  for (int i = 0; i < 1000; ++i) {
    const Box3 a = car(3.0, 4.0, 0.1 * i);
    const Box3 b = car(3.0 + tiny(random), 4.0 + tiny(random), 0.1 * i + tiny(random));
    EXPECT_NEAR(overlap3d(a, b), 1.0, 1e-9);
  }
}

}  // namespace
}  // namespace datmo::kitti::box3_overlap_test
