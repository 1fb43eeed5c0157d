// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/velocity_wait.h"

#include <utility>
#include <vector>

#include "monitor_counts.h"
#include <gtest/gtest.h>

namespace datmo::velocity_wait_test {
namespace {

constexpr double kFirst = 100.0;  // s
constexpr double kPeriod = 0.08;  // s

Stamp at(double seconds) { return Stamp::fromSeconds(seconds); }

class VelocityWaitTest : public testing::Test {
 protected:
  void addPoints(double seconds) { wait_.addPoints(at(seconds), std::vector<PointVelocity>(1)); }

  void addObjects(double seconds) {
    ObjectList list;
    list.stamp = at(seconds);
    wait_.addObjects(std::move(list), 0.01);
  }

  /// Points are published, and they are of some use.
  void begin() {
    addPoints(kFirst);
    addObjects(kFirst);
    expect(wait_.next(), kFirst, true);
  }

  static void expect(const std::optional<VelocityWait::Served>& served, double seconds,
                     bool with_points) {
    ASSERT_TRUE(served);
    EXPECT_EQ(served->list.stamp, at(seconds));
    EXPECT_EQ(served->seconds, 0.01);
    EXPECT_EQ(served->points.has_value(), with_points);
  }

  std::uint64_t drops(const std::string& reason) const { return samples::drops(monitor_, reason); }
  std::uint64_t warnings() const { return samples::warnings(monitor_, "no_velocities"); }

  StageMonitor monitor_{"stereo_objects"};
  VelocityWaitOptions options_;
  VelocityWait wait_{options_, monitor_};
};

TEST_F(VelocityWaitTest, WithoutAPublisherOfPointsThereIsNoWait) {
  for (int i = 0; i < 3; ++i) {
    addObjects(kFirst + i * kPeriod);
    expect(wait_.next(), kFirst + i * kPeriod, false);
  }
  EXPECT_EQ(warnings(), 0U);
}

TEST_F(VelocityWaitTest, ObjectsWaitForThePointsOfTheirStamp) {
  begin();
  addObjects(kFirst + kPeriod);
  EXPECT_FALSE(wait_.next());
  EXPECT_FALSE(wait_.next(at(500.0))) << "whatever the caller's clock says";
  addPoints(kFirst + kPeriod);
  expect(wait_.next(at(500.05)), kFirst + kPeriod, true);
  EXPECT_FALSE(wait_.next(at(500.05)));
  EXPECT_EQ(monitor_.droppedCount() + warnings(), 0U);
}

TEST_F(VelocityWaitTest, PointsWaitForASlowCloudAndAreNotOverwritten) {
  begin();
  addPoints(kFirst + kPeriod);
  addPoints(kFirst + 2.0 * kPeriod);
  addObjects(kFirst + kPeriod);
  expect(wait_.next(), kFirst + kPeriod, true);
  addObjects(kFirst + 2.0 * kPeriod);
  expect(wait_.next(), kFirst + 2.0 * kPeriod, true);
  EXPECT_EQ(monitor_.droppedCount() + warnings(), 0U);
}

TEST_F(VelocityWaitTest, TheWaitEndsByTheCallersClock) {
  begin();
  addObjects(kFirst + kPeriod);
  EXPECT_FALSE(wait_.next(at(500.0)));
  EXPECT_FALSE(wait_.next(at(500.0 + 0.9 * options_.max_wait)));
  expect(wait_.next(at(500.0 + 1.1 * options_.max_wait)), kFirst + kPeriod, false);
  EXPECT_EQ(warnings(), 1U);
  addPoints(kFirst + kPeriod);
  EXPECT_EQ(drops("late_velocities"), 1U);
}

TEST_F(VelocityWaitTest, TheWaitEndsByTheStampsOfLaterClouds) {
  begin();
  addObjects(kFirst + kPeriod);
  addObjects(kFirst + 2.0 * kPeriod);
  EXPECT_FALSE(wait_.next());
  addObjects(kFirst + 3.0 * kPeriod);
  expect(wait_.next(), kFirst + kPeriod, false);
  EXPECT_FALSE(wait_.next()) << "these have not waited for long enough";
  addPoints(kFirst + 2.0 * kPeriod);
  expect(wait_.next(), kFirst + 2.0 * kPeriod, true);
}

TEST_F(VelocityWaitTest, PointsOfALaterStampShowThatThereAreNone) {
  begin();
  addObjects(kFirst + kPeriod);
  addPoints(kFirst + 2.0 * kPeriod);
  expect(wait_.next(), kFirst + kPeriod, false);
  EXPECT_EQ(warnings(), 1U);
  addObjects(kFirst + 2.0 * kPeriod);
  expect(wait_.next(), kFirst + 2.0 * kPeriod, true);
}

TEST_F(VelocityWaitTest, ASilentPublisherIsNotWaitedFor) {
  begin();
  addObjects(kFirst + 1.1 * options_.silent_after);
  expect(wait_.next(), kFirst + 1.1 * options_.silent_after, false);
  EXPECT_EQ(warnings(), 0U);
}

TEST_F(VelocityWaitTest, TheFirstPointsMayBeLate) {
  addObjects(kFirst);
  expect(wait_.next(), kFirst, false);
  addPoints(kFirst);
  EXPECT_EQ(monitor_.droppedCount(), 0U);
  addObjects(kFirst + kPeriod);
  EXPECT_FALSE(wait_.next()) << "now they are known of";
}

TEST_F(VelocityWaitTest, PointsWithoutACloudAreDroppedAndCounted) {
  begin();
  addPoints(kFirst + kPeriod);
  addPoints(kFirst + 2.0 * kPeriod);
  addObjects(kFirst + 2.0 * kPeriod);
  expect(wait_.next(), kFirst + 2.0 * kPeriod, true);
  EXPECT_EQ(drops("velocities_without_cloud"), 1U);
}

TEST_F(VelocityWaitTest, BoundedNumbersWait) {
  begin();
  for (int i = 1; i <= 1000; ++i) {
    addPoints(kFirst + i * kPeriod);
  }
  EXPECT_GT(drops("velocities_without_cloud"), 900U);
  wait_.clear();
  options_.max_wait = 2.0;
  VelocityWait patient(options_, monitor_);
  patient.addPoints(at(kFirst), {});
  int waiting = 0;
  for (int i = 1; i <= 1000; ++i) {
    ObjectList list;
    list.stamp = at(kFirst + i * 1e-4);
    patient.addObjects(std::move(list), 0.0);
    waiting += patient.next() ? 0 : 1;
  }
  EXPECT_LT(waiting, 100);
}

TEST_F(VelocityWaitTest, ForgetsEverything) {
  begin();
  addObjects(kFirst + kPeriod);
  wait_.clear();
  EXPECT_FALSE(wait_.next(at(1000.0)));
  addObjects(50.0);
  expect(wait_.next(), 50.0, false);
}

TEST_F(VelocityWaitTest, RefusesBadOptions) {
  options_.max_wait = -1.0;
  EXPECT_THROW(VelocityWait(options_, monitor_), OptionError);
}

}  // namespace
}  // namespace datmo::velocity_wait_test
