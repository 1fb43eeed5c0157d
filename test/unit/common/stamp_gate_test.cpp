// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/stamp_gate.h"

#include <gtest/gtest.h>

namespace datmo::stamp_gate_test {
namespace {

StampVerdict judge(StampGate& gate, double seconds) {
  return gate.judge(Stamp::fromSeconds(seconds));
}

StampVerdict judgeAt(StampGate& gate, double seconds, double now) {
  return gate.judge(Stamp::fromSeconds(seconds), Stamp::fromSeconds(now));
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

TEST(StampGate, AJumpBackIsARestartWhenASecondMessageConfirmsIt) {
  StampGate gate(2.0);
  judgeAt(gate, 10.0, 50.0);
  EXPECT_EQ(judgeAt(gate, 8.1, 50.1), StampVerdict::kOld);
  EXPECT_EQ(judgeAt(gate, 8.0, 50.2), StampVerdict::kStray);
  EXPECT_EQ(*gate.newest(), Stamp::fromSeconds(10.0));
  EXPECT_EQ(judgeAt(gate, 8.1, 50.3), StampVerdict::kRestart) << "even where it would be late";
  EXPECT_EQ(*gate.newest(), Stamp::fromSeconds(8.1));
  EXPECT_EQ(judgeAt(gate, 8.2, 50.4), StampVerdict::kAccept) << "the new run goes on";
}

TEST(StampGate, WithoutRosTimeEachJumpIsFollowed) {
  StampGate gate(2.0);
  judge(gate, 10.0);
  EXPECT_EQ(judge(gate, 8.1), StampVerdict::kOld);
  EXPECT_EQ(judge(gate, 8.0), StampVerdict::kRestart);
  EXPECT_EQ(*gate.newest(), Stamp::fromSeconds(8.0));
  EXPECT_EQ(judge(gate, 8.1), StampVerdict::kAccept) << "the new run goes on";
}

TEST(StampGate, AStrayStampCostsOneMessage) {
  for (const double off : {1.0, -1.0, 3600.0, -3600.0, 1e6, -1e6}) {
    StampGate gate;
    int used = 0;
    for (int message = 0; message < 20; ++message) {
      const double seconds = 1e7 + 0.1 * message;
      const StampVerdict verdict =
          judgeAt(gate, seconds + (message == 10 ? off : 0.0), seconds + 0.02);
      EXPECT_NE(verdict, StampVerdict::kRestart) << off;
      used += verdict == StampVerdict::kAccept ? 1 : 0;
    }
    EXPECT_EQ(used, 19) << off;
  }
}

TEST(StampGate, TwoStrayStampsThatDisagreeCostTwoMessages) {
  StampGate gate;
  judgeAt(gate, 100.0, 100.0);
  EXPECT_EQ(judgeAt(gate, 300.0, 100.1), StampVerdict::kStray);
  EXPECT_EQ(judgeAt(gate, 20.0, 100.2), StampVerdict::kStray);
  EXPECT_EQ(judgeAt(gate, 100.3, 100.3), StampVerdict::kAccept);
}

TEST(StampGate, RosTimeConfirmsAJumpAtOnce) {
  StampGate gate;
  judgeAt(gate, 100.0, 100.0);
  EXPECT_EQ(judgeAt(gate, 120.0, 120.05), StampVerdict::kAccept) << "it was silent";
  EXPECT_EQ(judgeAt(gate, 50.0, 50.1), StampVerdict::kRestart) << "a looped bag";
}

TEST(StampGate, AJumpAheadIsFollowedFromTheSecondMessageOn) {
  StampGate gate;
  judgeAt(gate, 100.0, 100.0);
  EXPECT_EQ(judgeAt(gate, 200.0, 100.1), StampVerdict::kStray);
  EXPECT_EQ(judgeAt(gate, 200.1, 100.2), StampVerdict::kAhead) << "no time has passed";
  EXPECT_EQ(judgeAt(gate, 200.2, 100.3), StampVerdict::kAccept);
}

TEST(StampGate, ASilenceThatEndsLateIsNoJumpOfTheClock) {
  StampGate gate;
  judgeAt(gate, 100.0, 101.0);
  EXPECT_EQ(judgeAt(gate, 103.1, 103.15), StampVerdict::kStray);
  EXPECT_EQ(judgeAt(gate, 103.2, 103.25), StampVerdict::kAccept) << "the last one before was late";
}

TEST(StampGate, OneClockThatJumpsAmongOthersIsNotFollowed) {
  StampGate gate;
  const auto judgeBeside = [&](double seconds, double now, double others) {
    return gate.judge(Stamp::fromSeconds(seconds), Stamp::fromSeconds(now),
                      Stamp::fromSeconds(others));
  };
  judgeBeside(100.0, 50.0, 99.9);
  for (int message = 1; message < 30; ++message) {
    const double later = 0.1 * message;
    EXPECT_EQ(judgeBeside(105.0 + later, 50.0 + later, 99.9 + later), StampVerdict::kStray);
  }
  EXPECT_EQ(judgeBeside(103.0, 53.0, 102.9), StampVerdict::kAccept) << "it is right again";
  EXPECT_EQ(judgeBeside(20.0, 53.1, 103.0), StampVerdict::kStray);
  EXPECT_EQ(judgeBeside(20.1, 53.2, 20.05), StampVerdict::kRestart) << "the others jumped, too";
}

TEST(StampGate, AClockThatIsSetToThatOfTheOthersIsFollowed) {
  StampGate gate;
  const auto others = Stamp::fromSeconds(5000.0);
  gate.judge(Stamp::fromSeconds(10.0), Stamp::fromSeconds(5000.0), others);
  EXPECT_EQ(gate.judge(Stamp::fromSeconds(5000.1), Stamp::fromSeconds(5000.1), others),
            StampVerdict::kStray);
  EXPECT_EQ(gate.judge(Stamp::fromSeconds(5000.2), Stamp::fromSeconds(5000.2), others),
            StampVerdict::kAccept);
}

TEST(StampGate, ASlowStreamThatRosTimeDoesNotFollowIsUsed) {
  StampGate gate;
  int used = 0;
  for (int message = 0; message < 20; ++message) {  // every 2 s, played five times as fast
    used += judgeAt(gate, 100.0 + 2.0 * message, 100.0 + 0.4 * message) == StampVerdict::kAccept;
  }
  EXPECT_EQ(used, 19);
}

TEST(StampGate, OfTwoClocksOnOneTopicTheFirstIsUsed) {
  StampGate gate;
  judgeAt(gate, 100.0, 100.0);
  for (int message = 1; message < 10; ++message) {
    const double now = 100.0 + 0.1 * message;
    EXPECT_EQ(judgeAt(gate, now - 5.0, now), StampVerdict::kStray);
    EXPECT_EQ(judgeAt(gate, now, now), StampVerdict::kAccept);
  }
}

}  // namespace
}  // namespace datmo::stamp_gate_test
