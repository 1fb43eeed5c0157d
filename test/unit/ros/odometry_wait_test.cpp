// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/odometry_wait.h"

#include <vector>

#include <gtest/gtest.h>

namespace datmo::odometry_wait_test {
namespace {

constexpr double kMaxWait = 0.1;  // s
constexpr double kHold = 0.5;     // s

class OdometryWaitTest : public testing::Test {
 protected:
  static Stamp at(double seconds) { return Stamp::fromSeconds(seconds); }

  void add(OdometryWait& wait, double scan, double now) {
    wait.add(at(scan), at(now), [this, scan] { served_.push_back(scan); });
  }

  void know(double odometry) { odometry_.add({at(odometry), {1.0, 0.0}}); }

  OdometryBuffer odometry_{kHold, kOdometryMemory};
  OdometryWait wait_{odometry_, kMaxWait, kHold};
  std::vector<double> served_;
};

TEST_F(OdometryWaitTest, AScanWaitsForTheOdometryOfItsStamp) {
  know(10.00);
  add(wait_, 10.02, 500.0);
  EXPECT_FALSE(wait_.serveNext(at(500.0)));
  know(10.02);
  EXPECT_TRUE(wait_.serveNext(at(500.01)));
  EXPECT_FALSE(wait_.serveNext(at(500.01)));
  EXPECT_EQ(served_, std::vector<double>{10.02});
}

TEST_F(OdometryWaitTest, NotForTheNextOneThatIsDueAfterIt) {
  know(10.00);
  know(10.02);
  add(wait_, 10.03, 500.0);
  EXPECT_TRUE(wait_.serveNext(at(500.0)));
  add(wait_, 10.05, 500.0);
  EXPECT_FALSE(wait_.serveNext(at(500.0))) << "one of 10.04 is on its way";
  know(10.04);
  EXPECT_TRUE(wait_.serveNext(at(500.0)));
}

TEST_F(OdometryWaitTest, OdometryInBurstsIsDueAfterTheLongestOfItsLastIntervals) {
  for (const double seconds : {10.0, 10.001, 10.1, 10.101}) {
    know(seconds);
  }
  add(wait_, 10.15, 500.0);
  EXPECT_TRUE(wait_.serveNext(at(500.0))) << "the next burst is due at 10.2";
  add(wait_, 10.21, 500.0);
  EXPECT_FALSE(wait_.serveNext(at(500.0)));
}

TEST_F(OdometryWaitTest, NotForever) {
  know(10.00);
  add(wait_, 10.02, 500.0);
  EXPECT_FALSE(wait_.serveNext(at(500.09)));
  EXPECT_TRUE(wait_.serveNext(at(500.1)));
}

TEST_F(OdometryWaitTest, ALaterScanDoesNotOvertake) {
  know(10.00);
  add(wait_, 10.02, 500.0);
  add(wait_, 10.08, 500.0);
  know(10.08);
  EXPECT_TRUE(wait_.serveNext(at(500.0)));
  EXPECT_TRUE(wait_.serveNext(at(500.0)));
  EXPECT_EQ(served_, (std::vector<double>{10.02, 10.08}));
}

TEST_F(OdometryWaitTest, NotForOdometryThatIsSilentOrHasNotBegun) {
  add(wait_, 10.0, 500.0);
  EXPECT_TRUE(wait_.serveNext(at(500.0)));
  know(9.0);
  add(wait_, 10.0, 500.0);
  EXPECT_TRUE(wait_.serveNext(at(500.0)));
  know(9.9);
  odometry_ = OdometryBuffer(kHold, kOdometryMemory);
  add(wait_, 10.0, 500.0);
  EXPECT_TRUE(wait_.serveNext(at(500.0)));
}

TEST_F(OdometryWaitTest, NotAtAllWithoutAWait) {
  OdometryWait wait(odometry_, 0.0, kHold);
  know(10.00);
  add(wait, 10.02, 500.0);
  EXPECT_TRUE(wait.serveNext(at(500.0)));
}

TEST_F(OdometryWaitTest, ABoundedNumberWaits) {
  know(10.0);
  for (int i = 0; i < 60; ++i) {
    add(wait_, 10.001, 500.0);
    while (wait_.serveNext(at(500.0))) {
    }
  }
  EXPECT_EQ(served_.size(), 10U);
}

TEST_F(OdometryWaitTest, AClockThatIsSetBackEndsTheWait) {
  know(10.0);
  add(wait_, 10.02, 500.0);
  EXPECT_TRUE(wait_.serveNext(at(400.0)));
}

}  // namespace
}  // namespace datmo::odometry_wait_test
