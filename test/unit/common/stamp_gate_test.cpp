// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/stamp_gate.h"

#include <gtest/gtest.h>

namespace datmo::stamp_gate_test {
namespace {

StampVerdict judge(StampGate& gate, double seconds) {
  return gate.judge(Stamp::fromSeconds(seconds));
}

TEST(StampGate, TimeGoesForward) {
  StampGate gate;
  EXPECT_FALSE(gate.newest());
  EXPECT_EQ(judge(gate, 10.0), StampVerdict::kAccept);
  EXPECT_EQ(judge(gate, 10.1), StampVerdict::kAccept);
  EXPECT_EQ(judge(gate, 100.0), StampVerdict::kAccept) << "a gap is not an error";
  EXPECT_EQ(*gate.newest(), Stamp::fromSeconds(100.0));
}

TEST(StampGate, RepeatedAndOldOnesDoNotMoveTheNewest) {
  StampGate gate;
  judge(gate, 10.0);
  EXPECT_EQ(judge(gate, 10.0), StampVerdict::kRepeated);
  EXPECT_EQ(judge(gate, 9.5), StampVerdict::kOld);
  EXPECT_EQ(*gate.newest(), Stamp::fromSeconds(10.0));
  EXPECT_EQ(judge(gate, 10.06), StampVerdict::kAccept);
}

TEST(StampGate, AJumpBackIsARestartFromItsThresholdOn) {
  StampGate gate(2.0);
  judge(gate, 10.0);
  EXPECT_EQ(judge(gate, 8.1), StampVerdict::kOld);
  EXPECT_EQ(judge(gate, 8.0), StampVerdict::kRestart);
  EXPECT_EQ(*gate.newest(), Stamp::fromSeconds(8.0));
  EXPECT_EQ(judge(gate, 8.1), StampVerdict::kAccept) << "the new run goes on";
}

}  // namespace
}  // namespace datmo::stamp_gate_test
