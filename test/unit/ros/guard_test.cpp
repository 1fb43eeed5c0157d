// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/guard.h"

#include <stdexcept>

#include "monitor_counts.h"
#include <gtest/gtest.h>

#include <ros/time.h>

namespace datmo::guard_test {
namespace {

TEST(Guarded, RunsWhatItIsGiven) {
  StageMonitor monitor("stage");
  bool ran = false;
  guarded(monitor, "scan", [&ran] { ran = true; });
  EXPECT_TRUE(ran);
  EXPECT_EQ(monitor.droppedCount(), 0U);
}

TEST(Guarded, ARefusedMessageIsCountedByItsReason) {
  StageMonitor monitor("stage");
  guarded(monitor, "scan", [] { throw InputError("wrong_size", "3 beams: expected 4"); });
  EXPECT_EQ(samples::drops(monitor, "wrong_size"), 1U);
}

TEST(Guarded, NoExceptionOfOthersLeavesIt) {
  StageMonitor monitor("stage");
  guarded(monitor, "objects", [] { ros::Time(4294967295U, 0) + ros::Duration(1.0); });
  guarded(monitor, "objects", [] { throw std::logic_error("a fault of the code"); });
  EXPECT_EQ(samples::drops(monitor, "unexpected_error"), 2U);
  EXPECT_EQ(monitor.lastError().find("at a message on objects: a fault of the code"), 0U);
}

}  // namespace
}  // namespace datmo::guard_test
