// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/stamp.h"

#include <gtest/gtest.h>

namespace datmo::stamp_test {
namespace {

TEST(Stamp, SecondsAndBack) {
  EXPECT_EQ(Stamp::fromSeconds(1.5).nanoseconds, 1500000000);
  EXPECT_DOUBLE_EQ(Stamp{2500000000}.seconds(), 2.5);
}

TEST(Stamp, DifferencesKeepNanosecondsAtTodaysEpoch) {
  const Stamp now{1700000000000000001};
  const Stamp later{1700000000000000004};
  EXPECT_DOUBLE_EQ(secondsBetween(now, later), 3e-9);
  EXPECT_DOUBLE_EQ(secondsBetween(later, now), -3e-9);
  EXPECT_EQ((now + 3e-9).nanoseconds, later.nanoseconds);
}

TEST(Stamp, Order) {
  const Stamp early{1};
  const Stamp late{2};
  EXPECT_TRUE(early < late && early <= late && late > early && late >= early && early != late);
  EXPECT_TRUE(early <= Stamp{1} && early >= Stamp{1} && early == Stamp{1});
  EXPECT_FALSE(late < early || early > late || early == late || early < Stamp{1});
}

}  // namespace
}  // namespace datmo::stamp_test
