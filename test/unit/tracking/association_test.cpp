#include "datmo_fusion/tracking/association.h"

#include "tracking_scene.h"
#include <gtest/gtest.h>

namespace datmo {
namespace {

std::vector<Target> targetsAt(const std::vector<double>& places) {
  const TargetOptions options;
  std::vector<Target> targets;
  for (const double x : places) {
    targets.emplace_back(objectAt(x, 0.0), options);
    targets.back().predict(0.1, immStep(options.filter, 0.1), options);
  }
  return targets;
}

std::vector<Object> objectsAt(const std::vector<double>& places) {
  std::vector<Object> objects;
  for (const double x : places) {
    objects.push_back(objectAt(x, 0.0));
  }
  return objects;
}

const GlobalNearestNeighbour kAssociator{AssociationOptions()};

TEST(GlobalNearestNeighbour, NamesPairsMissedAndUnexplained) {
  const Association result = kAssociator.associate(targetsAt({0.0, 50.0}), objectsAt({20.0, 0.2}));
  ASSERT_EQ(result.pairs.size(), 1U);
  EXPECT_EQ(result.pairs[0].target, 0U);
  EXPECT_EQ(result.pairs[0].object, 1U);
  EXPECT_EQ(result.missed, std::vector<std::size_t>{1});
  EXPECT_EQ(result.unexplained, std::vector<std::size_t>{0});
}

TEST(GlobalNearestNeighbour, TheSumDecidesNotTheNearest) {
  // The object at 1.0 is nearest to the target at 1.2, but then the other target would have none.
  const Association result = kAssociator.associate(targetsAt({0.0, 1.2}), objectsAt({1.0, 2.4}));
  ASSERT_EQ(result.pairs.size(), 2U);
  EXPECT_EQ(result.pairs[0].object, 0U);
  EXPECT_EQ(result.pairs[1].object, 1U);
}

TEST(GlobalNearestNeighbour, NothingAndNothing) {
  EXPECT_TRUE(kAssociator.associate({}, {}).pairs.empty());
  EXPECT_EQ(kAssociator.associate({}, objectsAt({1.0})).unexplained.size(), 1U);
  EXPECT_EQ(kAssociator.associate(targetsAt({1.0}), {}).missed.size(), 1U);
}

TEST(GlobalNearestNeighbour, DifferentClassesAreNeverJoinedAnUnknownOneIsWithAny) {
  const TargetOptions options;
  Object cyclist = objectAt(0.0, 0.0);
  cyclist.object_class = ObjectClass::kCyclist;
  Object vehicle = objectAt(0.1, 0.0);
  vehicle.object_class = ObjectClass::kVehicle;
  const std::vector<Target> target{Target(cyclist, options)};
  EXPECT_TRUE(kAssociator.associate(target, {vehicle}).pairs.empty());
  EXPECT_EQ(kAssociator.associate(target, {cyclist}).pairs.size(), 1U);
  EXPECT_EQ(kAssociator.associate(target, objectsAt({0.1})).pairs.size(), 1U);
}

TEST(GlobalNearestNeighbour, OutsideOfTheGateIsAnother) {
  AssociationOptions tight;
  tight.gate = 0.1;
  const auto targets = targetsAt({0.0});
  const auto objects = objectsAt({1.0});
  EXPECT_EQ(kAssociator.associate(targets, objects).pairs.size(), 1U);
  EXPECT_TRUE(GlobalNearestNeighbour(tight).associate(targets, objects).pairs.empty());
}

TEST(GlobalNearestNeighbour, WhatIsHiddenWidensTheGate) {
  const TargetOptions options;
  Object lorry = objectAt(0.0, 0.0);
  const auto associated = [&](const Object& first) {
    std::vector<Target> targets{Target(first, options)};
    targets[0].predict(0.1, immStep(options.filter, 0.1), options);
    return !kAssociator.associate(targets, objectsAt({5.5})).pairs.empty();
  };
  EXPECT_FALSE(associated(lorry));
  lorry.box.length = 10.0;
  EXPECT_TRUE(associated(lorry)) << "its end, seen alone";
}

}  // namespace
}  // namespace datmo
