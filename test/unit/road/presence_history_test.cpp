// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/presence_history.h"

#include <gtest/gtest.h>

#include "datmo_fusion/common/random.h"

namespace datmo::presence_history_test {
namespace {

TEST(PresenceHistoryTest, CountsTheDistanceDriven) {
  PresenceHistory history{PresenceHistoryOptions{}};
  for (int i = 0; i <= 100; ++i) {
    history.update({}, Pose2(0.1 * i, 0.0, 0.0), 0.06);
  }
  EXPECT_NEAR(history.presence().arc_length, 10.0, 0.2);
}

TEST(PresenceHistoryTest, TheJitterOfAStationaryVehicleIsNoDistance) {
  PresenceHistory history{PresenceHistoryOptions{}};
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    history.update({}, Pose2(random.normal(0.01), random.normal(0.01), 0.0), 0.06);
  }
  EXPECT_LT(history.presence().arc_length, 0.2);
}

TEST(PresenceHistoryTest, DrivingBackwardIsNotCounted) {
  PresenceHistory history{PresenceHistoryOptions{}};
  for (int i = 0; i <= 20; ++i) {
    history.update({}, Pose2(-0.5 * i, 0.0, 0.0), 0.06);
  }
  EXPECT_DOUBLE_EQ(history.presence().arc_length, 0.0);
}

TEST(PresenceHistoryTest, WithoutBordersItIsUnknown) {
  PresenceHistory history{PresenceHistoryOptions{}};
  history.update({}, Pose2(), 0.06);
  for (const double probability : history.presence().left.probability) {
    EXPECT_DOUBLE_EQ(probability, 0.5);
  }
  EXPECT_EQ(history.presence().left.probability.size(),
            history.presence().right.probability.size());
}

}  // namespace
}  // namespace datmo::presence_history_test
