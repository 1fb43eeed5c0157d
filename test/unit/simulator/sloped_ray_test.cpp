// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/sloped_ray.h"

#include "made_worlds.h"
#include <gtest/gtest.h>

namespace datmo::simulator::sloped_ray_test {
namespace {

constexpr double kReach = 100.0;

/// Returns the end of a line of sight from 1.3 m above the origin, along x.
std::optional<RayEnd> endAlongX(const World& world, double fall) {
  // The solids at the end belong to the world, not to the state, because nothing moves here.
  const RayCaster caster(world, world.at(0.0), Point2::Zero(), kReach);
  return endOf({1.3, fall, kReach}, caster.passages(0.0, kReach));
}

TEST(SlopedRay, EndsOnTheRoadOrInTheSky) {
  const World world = emptyWorld();
  const auto road = endAlongX(world, 0.1);
  ASSERT_TRUE(road);
  EXPECT_NEAR(road->range, 13.0, 1e-9);
  EXPECT_EQ(road->solid, nullptr);
  EXPECT_FALSE(endAlongX(world, 0.0));
  EXPECT_FALSE(endAlongX(world, 0.01));  // 130 m away
}

TEST(SlopedRay, EndsOnTheFaceThatItHits) {
  World world = emptyWorld();
  world.addSolid(wallAt(20.0));
  const auto end = endAlongX(world, 0.05);
  ASSERT_TRUE(end);
  EXPECT_NEAR(end->range, 20.0, 1e-9);
  EXPECT_NEAR(end->height, 0.3, 1e-9);
  EXPECT_NE(end->solid, nullptr);
  EXPECT_NEAR(endAlongX(world, -0.08)->height, 2.9, 1e-9);
  EXPECT_FALSE(endAlongX(world, -0.09));  // over it
}

TEST(SlopedRay, PassesOverALowObjectToTheOneBehind) {
  World world = emptyWorld();
  world.addSolid(wallAt(10.0, 1.0));
  world.addSolid(wallAt(20.0));
  EXPECT_NEAR(endAlongX(world, 0.029)->range, 20.0, 1e-9);
  EXPECT_NEAR(endAlongX(world, 0.031)->range, 10.0, 1e-9);
}

TEST(SlopedRay, EndsOnTheTopOfALowObject) {
  World world = emptyWorld();
  world.addSolid({Box2{{10.0, 0.0, 0.0}, 4.0, 2.0}, 0.5, Surface::kBody, kNoObject});
  const auto end = endAlongX(world, 0.08);
  ASSERT_TRUE(end);
  EXPECT_NEAR(end->range, 10.0, 1e-9);
  EXPECT_NEAR(end->height, 0.5, 1e-9);
  EXPECT_NEAR(endAlongX(world, 0.06)->range, 1.3 / 0.06, 1e-9);  // behind it
}

TEST(SlopedRay, CurbsHaveHeightAndPaintDoesNot) {
  World world = emptyWorld();
  world.addSolid({Segment{{10.0, -5.0}, {10.0, 5.0}}, 0.12, Surface::kCurb, kNoObject});
  world.addSolid({Box2{{6.0, 0.0, 0.0}, 3.0, 2.0}, 0.0, Surface::kPaint, kNoObject});
  EXPECT_NEAR(endAlongX(world, 0.12)->range, 10.0, 1e-9);
  EXPECT_EQ(endAlongX(world, 0.2)->solid, nullptr);
}

}  // namespace
}  // namespace datmo::simulator::sloped_ray_test
