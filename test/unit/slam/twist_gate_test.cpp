// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/twist_gate.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace datmo::twist_gate_test {
namespace {

bool passes(TwistGate& gate, double seconds, double speed, double yaw_rate) {
  return gate.passes(Stamp::fromSeconds(seconds), {speed, yaw_rate});
}

TEST(TwistGate, OneImpossibleYawRateCostsOneSample) {
  TwistGate gate{TwistGateOptions(), OdometryNoiseOptions()};
  EXPECT_TRUE(passes(gate, 10.0, 8.0, 0.0));
  EXPECT_FALSE(passes(gate, 10.02, 8.0, 3.0)) << "8 m/s at 3 rad/s is 2.4 g sideways";
  EXPECT_TRUE(passes(gate, 10.04, 8.0, 0.0));
}

TEST(TwistGate, OneImpossibleSpeedCostsOneSample) {
  TwistGate gate{TwistGateOptions(), OdometryNoiseOptions()};
  passes(gate, 10.0, 8.0, 0.0);
  EXPECT_FALSE(passes(gate, 10.1, 40.0, 0.0));
  EXPECT_FALSE(passes(gate, 10.2, -20.0, 0.0)) << "another wrong one does not confirm it";
  EXPECT_TRUE(passes(gate, 10.3, 8.0, 0.0));
}

TEST(TwistGate, FullBrakingAndASteppedTurnPass) {
  TwistGate gate{TwistGateOptions(), OdometryNoiseOptions()};
  for (int message = 0; message < 100; ++message) {
    const double seconds = 0.02 * message;
    const double speed = std::max(0.0, 12.0 - 10.0 * seconds);
    EXPECT_TRUE(passes(gate, seconds, speed, message < 50 ? 0.0 : 0.4)) << message;
  }
}

TEST(TwistGate, ATurnWithinTheTiresLimitMayBeSudden) {
  TwistGate gate{TwistGateOptions(), OdometryNoiseOptions()};
  EXPECT_TRUE(passes(gate, 10.0, 8.0, 0.0));
  EXPECT_TRUE(passes(gate, 10.02, 8.0, 1.2)) << "1 g sideways, on a radius of 7 m";
  EXPECT_TRUE(passes(gate, 10.04, 8.0, 0.0));
  EXPECT_TRUE(passes(gate, 10.06, 7.8, 0.0));
  EXPECT_FALSE(passes(gate, 10.08, 7.8, 2.2)) << "too fast for the tires";
  EXPECT_TRUE(passes(gate, 12.0, 1.0, 0.0));
  EXPECT_FALSE(passes(gate, 12.02, 1.0, 1.0)) << "on a radius of 1 m";
}

TEST(TwistGate, ChangesExplainedByNoisePass) {
  OdometryNoiseOptions wheels_that_slip;
  wheels_that_slip.yaw_rate_noise = 0.2;
  TwistGate gate{TwistGateOptions(), wheels_that_slip};
  EXPECT_TRUE(passes(gate, 10.0, 0.0, 0.0));
  EXPECT_TRUE(passes(gate, 10.02, 0.0, 1.0));
  EXPECT_TRUE(gate.passes(Stamp::fromSeconds(10.04), {5.0, 1.0}, {1.0, 0.0}));
}

TEST(TwistGate, AChangeThatASecondTwistConfirmsIsFollowed) {
  TwistGate gate{TwistGateOptions(), OdometryNoiseOptions()};
  passes(gate, 10.0, 0.0, 0.0);
  EXPECT_FALSE(passes(gate, 10.02, 20.0, 0.0));
  EXPECT_TRUE(passes(gate, 10.04, 20.1, 0.0));
  EXPECT_TRUE(passes(gate, 10.06, 20.2, 0.0));
}

TEST(TwistGate, LongerGapsAllowLargerChanges) {
  TwistGate gate{TwistGateOptions(), OdometryNoiseOptions()};
  passes(gate, 10.0, 0.0, 0.0);
  EXPECT_TRUE(passes(gate, 12.0, 20.0, 0.0)) << "10 m/s^2";
}

TEST(TwistGate, AfterAResetTheFirstOnePasses) {
  TwistGate gate{TwistGateOptions(), OdometryNoiseOptions()};
  passes(gate, 10.0, 0.0, 0.0);
  gate.reset();
  EXPECT_TRUE(passes(gate, 10.02, 40.0, 0.0));
}

TEST(TwistGate, BoundsMustBePositive) {
  EXPECT_THROW(TwistGate({0.0, 9.0}, {}), OptionError);
  EXPECT_THROW(TwistGate({12.0, std::nan("")}, {}), OptionError);
}

}  // namespace
}  // namespace datmo::twist_gate_test
