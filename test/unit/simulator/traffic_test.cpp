// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/traffic.h"

#include <cmath>
#include <set>
#include <string>

#include "made_worlds.h"
#include "simulator/collision.h"
#include "simulator/scene.h"
#include <gtest/gtest.h>

namespace datmo::simulator::traffic_test {
namespace {

constexpr double kDuration = 20.0;
constexpr double kEgoSpeed = 10.0;

/// Beside the ego vehicle, which drives along x; faster than it.
Lane leftLane() {
  return {Path({{0.0, 4.0}, {500.0, 4.0}}, 0.0), {objectKind("car")}, 11.0, 13.0, -5.0, 20.0};
}

World worldWith(int movers, std::uint64_t seed, double gap = 3.0) {
  World world(RoadNetwork(), egoAlongX(kEgoSpeed));
  addTraffic({leftLane()}, {movers, gap}, kDuration, RandomStream(seed, "traffic"), world);
  return world;
}

TEST(Traffic, MeetsTheEgoVehicleWhereTheLaneSays) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const World world = worldWith(1, seed);
    ASSERT_EQ(world.movers().size(), 1U);
    const Mover& mover = world.movers().front();
    const double speed = mover.speed.speed(0.0);
    EXPECT_GE(speed, 11.0);
    EXPECT_LE(speed, 13.0);
    EXPECT_DOUBLE_EQ(mover.axle(3.0).y(), 4.0);
    // It catches up with the ego vehicle: it is -5 m to 20 m ahead at some time in between.
    EXPECT_LE(mover.axle(0.0).x(), 20.0 + 0.5);
    EXPECT_GE(mover.axle(kDuration).x(), kEgoSpeed * kDuration - 5.0 - 0.5);
  }
}

TEST(Traffic, MoreOfItLeavesTheFirstMoversUnchanged) {
  const World few = worldWith(2, 7);
  const World many = worldWith(5, 7);
  ASSERT_EQ(many.movers().size(), 5U);
  for (std::size_t i = 0; i < few.movers().size(); ++i) {
    EXPECT_EQ(few.movers()[i].axle(0.0).x(), many.movers()[i].axle(0.0).x());
    EXPECT_EQ(few.movers()[i].speed.speed(0.0), many.movers()[i].speed.speed(0.0));
  }
}

TEST(Traffic, SeedsDiffer) {
  std::set<double> positions;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    positions.insert(worldWith(1, seed).movers().front().axle(0.0).x());
  }
  EXPECT_EQ(positions.size(), 10U);
}

TEST(Traffic, KeepsTheGap) {
  constexpr double kGap = 6.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const World world = worldWith(4, seed, kGap);
    EXPECT_FALSE(firstCollision(world, kDuration));
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        for (double time = 0.0; time <= kDuration; time += 0.5) {
          const double apart =
              std::abs(world.movers()[i].axle(time).x() - world.movers()[j].axle(time).x());
          EXPECT_GE(apart, objectKind("car").length + kGap - 0.5);
        }
      }
    }
  }
}

TEST(Traffic, TooMuchForTheLanesIsRefused) {
  try {
    worldWith(1000, 1);
    FAIL() << "was taken";
  } catch (const OptionError& error) {
    EXPECT_NE(std::string(error.what()).find("traffic/movers = 1000: expected at most the "),
              std::string::npos)
        << error.what();
  }
  World world = emptyWorld();
  EXPECT_THROW(addTraffic({}, {1, 3.0}, kDuration, RandomStream(1, "traffic"), world), OptionError);
  EXPECT_NO_THROW(addTraffic({}, {0, 3.0}, kDuration, RandomStream(1, "traffic"), world));
}

class RobustnessScene : public testing::TestWithParam<const char*> {};

TEST_P(RobustnessScene, HasRoomForItsTraffic) {
  const std::string file = std::string(DATMO_FUSION_SCENES "/") + GetParam();
  for (const int seed : {1, 2, 3}) {
    const Scene scene = readScene(file, {{"traffic/movers", 16}, {"seed", seed}});
    EXPECT_EQ(scene.world.movers().size(), 16U);
    EXPECT_DOUBLE_EQ(scene.options.duration, 50.0);
  }
  EXPECT_TRUE(readScene(file).world.movers().empty());
}

INSTANTIATE_TEST_SUITE_P(Scenes, RobustnessScene,
                         testing::Values("straight_road.yaml", "guard_rails.yaml"));

}  // namespace
}  // namespace datmo::simulator::traffic_test
