// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/nearest_neighbor.h"

#include "association_scene.h"
#include <gtest/gtest.h>

namespace datmo::nearest_neighbor_test {
namespace {

class NearestNeighborTest : public testing::Test {
 protected:
  ScanSource source_;
  NearestNeighborTargets targets_{TargetOptions(), AssociationOptions()};
};

TEST_F(NearestNeighborTest, EachObjectStartsATargetWithANumberOfItsOwn) {
  see(targets_, source_, objectsAlong({30.0, -30.0}));
  const std::vector<BestTarget> best = targets_.best();
  ASSERT_EQ(best.size(), 2U);
  EXPECT_EQ(best[0].target->number(), 1U);
  EXPECT_EQ(best[1].target->number(), 2U);
  EXPECT_EQ(best[0].probability, 1.0);
  EXPECT_EQ(best[0].target->measurementIndex(), 0U);
  EXPECT_NEAR(best[0].target->box().center.x(), -30.0, 1e-9);
}

TEST_F(NearestNeighborTest, UpdatedMissedAndNew) {
  see(targets_, source_, objectsAlong({0.0, 50.0}));
  see(targets_, source_, objectsAlong({20.0, 0.2}));
  ASSERT_EQ(targets_.best().size(), 3U);
  EXPECT_EQ(measurementIndex(targets_, 1), 0U);
  EXPECT_EQ(targets_.best()[0].target->hits(), 2U);
  EXPECT_EQ(measurementIndex(targets_, 2), kUnseen);
  EXPECT_NEAR(targets_.best()[1].target->sinceUpdate(), 0.1, 1e-9);
  EXPECT_EQ(targets_.best()[2].target->number(), 4U) << "numbers tell scan and object";
  EXPECT_EQ(measurementIndex(targets_, 4), 1U);
}

TEST_F(NearestNeighborTest, TheSumDecidesNotTheNearest) {
  // The object at 1.0 is nearest to the target at 1.2, but then the other target would have none.
  see(targets_, source_, objectsAlong({0.0, 1.2}));
  see(targets_, source_, objectsAlong({1.0, 2.4}));
  ASSERT_EQ(targets_.best().size(), 2U);
  EXPECT_EQ(measurementIndex(targets_, 1), 0U);
  EXPECT_EQ(measurementIndex(targets_, 2), 1U);
}

TEST_F(NearestNeighborTest, NoTargetsAndNoObjects) {
  see(targets_, source_, {});
  EXPECT_TRUE(targets_.best().empty());
  see(targets_, source_, objectsAlong({1.0}));
  see(targets_, source_, {});
  ASSERT_EQ(targets_.best().size(), 1U);
  EXPECT_EQ(measurementIndex(targets_, 1), kUnseen);
}

TEST_F(NearestNeighborTest, AFullListRefusesNewObjectsAndCountsThem) {
  AssociationOptions options;
  options.max_targets = 2;
  NearestNeighborTargets targets(TargetOptions(), options);
  see(targets, source_, objectsAlong({0.0, 10.0, 20.0}));
  EXPECT_EQ(targets.best().size(), 2U);
  EXPECT_EQ(targets.counts().refused_births, 1U);
  see(targets, source_, objectsAlong({0.0, 10.0}));
  EXPECT_EQ(targets.counts().refused_births, 1U) << "those followed are no new ones";
}

TEST_F(NearestNeighborTest, ChangesRemovesAndForgets) {
  see(targets_, source_, objectsAlong({0.0, 10.0, 20.0}));
  targets_.change(2, [](Target& target) {
    target.setId(7);
    target.confirm(1, true);
  });
  EXPECT_EQ(targets_.best()[1].target->id(), 7U);
  EXPECT_EQ(targets_.best()[0].target->id(), 0U);
  targets_.removeIf([](const Target& target) { return target.confirmed(); });
  ASSERT_EQ(targets_.best().size(), 2U);
  EXPECT_EQ(targets_.best()[1].target->number(), 3U);
  targets_.clear();
  EXPECT_TRUE(targets_.best().empty());
  see(targets_, source_, objectsAlong({0.0}));
  EXPECT_EQ(targets_.best()[0].target->number(), 4U) << "numbers go on";
}

}  // namespace
}  // namespace datmo::nearest_neighbor_test
