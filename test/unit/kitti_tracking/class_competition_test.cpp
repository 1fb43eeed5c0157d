// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/class_competition.h"

#include <cmath>

#include <gtest/gtest.h>

namespace datmo::kitti::class_competition_test {
namespace {

Object objectAt(double x, double log_odds, double length = 1.8, double width = 0.6) {
  Object object;
  object.box = {{x, 0.0, 0.0}, length, width};
  object.log_odds = log_odds;
  return object;
}

ObjectList listOf(const std::vector<Object>& objects) { return {Stamp{}, objects, {}}; }

TEST(ClassCompetition, AtOnePositionTheOddsAreDivided) {
  std::vector<ObjectList> lists = {listOf({objectAt(10.0, 1.0)}), listOf({objectAt(10.5, 2.0)})};
  compete(lists);
  EXPECT_NEAR(lists[0].objects[0].log_odds, 1.0 - std::log(1.0 + std::exp(2.0)), 1e-12);
  EXPECT_NEAR(lists[1].objects[0].log_odds, 2.0 - std::log(1.0 + std::exp(1.0)), 1e-12);
}

TEST(ClassCompetition, ImprobableObjectsHaveLittleEffect) {
  std::vector<ObjectList> lists = {listOf({objectAt(10.0, 5.0)}), listOf({objectAt(10.0, -9.0)})};
  compete(lists);
  EXPECT_NEAR(lists[0].objects[0].log_odds, 5.0, 1e-3);
  EXPECT_NEAR(lists[1].objects[0].log_odds, -14.0, 0.01);
}

TEST(ClassCompetition, OthersAreUnchanged) {
  std::vector<ObjectList> lists = {listOf({objectAt(10.0, 1.0), objectAt(10.2, 3.0)}),
                                   listOf({objectAt(13.0, 2.0)}), listOf({})};
  compete(lists);
  EXPECT_EQ(lists[0].objects[0].log_odds, 1.0) << "of the same class";
  EXPECT_EQ(lists[0].objects[1].log_odds, 3.0);
  EXPECT_EQ(lists[1].objects[0].log_odds, 2.0) << "somewhere else";
}

TEST(ClassCompetition, ASmallBoxInALargeOneIsAtOnePosition) {
  std::vector<ObjectList> lists = {listOf({objectAt(10.0, 4.0, 5.0, 2.0)}),
                                   listOf({objectAt(12.0, 1.0, 0.6, 0.6)})};
  compete(lists);
  EXPECT_LT(lists[1].objects[0].log_odds, -2.9);
}

TEST(ClassCompetition, HugeOddsStayFinite) {
  std::vector<ObjectList> lists = {listOf({objectAt(10.0, 900.0)}),
                                   listOf({objectAt(10.0, 900.0)})};
  compete(lists);
  EXPECT_NEAR(lists[0].objects[0].log_odds, 0.0, 1e-9);
}

}  // namespace
}  // namespace datmo::kitti::class_competition_test
