// SPDX-License-Identifier: BSD-3-Clause
// The running risk nodelet after a scripted grid_slam and tracker: a stationary car ahead, between
// two walls, and what happens with invalid input. The tests run through one drive, in this order.
#include <limits>
#include <string>
#include <vector>

#include "labeled_scan_harness.h"
#include "ros/risk_samples.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/host_conversion.h"
#include "datmo_fusion/ros/convert/risk_conversion.h"

namespace datmo::risk_test {
namespace {

constexpr double kCarAt = 30.0;  // m, along the drive

/// s; a clock that is late by a step must not look like a jump of the stamps.
constexpr double kLongStep = 0.4;

class RiskHarness : public LabeledScanHarness {
 public:
  RiskHarness() : LabeledScanHarness("risk") {}

  bool waitForNodelet() {
    return LabeledScanHarness::waitForNodelet() && waitFor([this] {
             return risks_.getNumPublishers() >= 1 && tracks_.getNumSubscribers() >= 1 &&
                    odometry_.getNumSubscribers() >= 1 && steering_.getNumSubscribers() >= 1 &&
                    acceleration_.getNumSubscribers() >= 1;
           });
  }

  void sendOdometry(double seconds) {
    odometry_.publish(samples::odometry(samples::kStart + seconds, samples::kHostSpeed));
  }

  /// Front wheels to the left, full braking.
  void sendDriver(double seconds) {
    const Stamp stamp = Stamp::fromSeconds(samples::kStart + seconds);
    steering_.publish(toSteering(0.2, stamp));
    acceleration_.publish(toAcceleration({-6.0, 0.01}, stamp));
  }

  void sendTracks(const TrackArray& list) { tracks_.publish(list); }

  std::vector<RiskArrayConstPtr> risks;

 private:
  ros::Publisher odometry_ = node_.advertise<nav_msgs::Odometry>("odometry", kQueue);
  ros::Publisher steering_ = node_.advertise<sensor_msgs::JointState>("steering", kQueue);
  ros::Publisher acceleration_ =
      node_.advertise<geometry_msgs::AccelWithCovarianceStamped>("acceleration", kQueue);
  ros::Publisher tracks_ = node_.advertise<TrackArray>("tracks", kQueue);
  ros::Subscriber risks_ = node_.subscribe<RiskArray>(
      "risks", kQueue, [this](const RiskArrayConstPtr& risk) { risks.push_back(risk); });
};

TrackArray carAhead(double seconds) { return samples::standingCar(seconds, kCarAt); }

class RiskTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    harness_ = new RiskHarness();
    ASSERT_TRUE(harness_->waitForNodelet());
  }

  static void TearDownTestSuite() { delete harness_; }

  /// Sends the current odometry and scan; waits until the nodelet has them.
  static void sendHost() {
    harness_->setClock(now_);
    harness_->sendOdometry(now_);
    harness_->send(samples::scanBetweenWalls(now_));
    ++steps_;
    ASSERT_TRUE(harness_->waitForCount("odometry received", steps_));
    ASSERT_TRUE(harness_->waitForCount("labeled_scan received", steps_));
  }

  /// Runs one step of the drive; waits for its risks.
  static void step() {
    ASSERT_NO_FATAL_FAILURE(sendHost());
    const TrackArray tracks = carAhead(now_);
    harness_->sendTracks(tracks);
    ASSERT_TRUE(harness_->waitFor([&] {
      return !harness_->risks.empty() &&
             harness_->risks.back()->header.stamp == tracks.header.stamp;
    })) << now_
        << " s: " << harness_->diagnosticMessage();
    now_ += kLongStep;
  }

  static RiskHarness* harness_;
  static double now_;    // s, of the drive
  static double steps_;  // so far
};

RiskHarness* RiskTest::harness_ = nullptr;
double RiskTest::now_ = 0.0;
double RiskTest::steps_ = 0.0;

TEST_F(RiskTest, WarnsBeforeTheCarAhead) {
  for (int i = 0; i < 11; ++i) {
    ASSERT_NO_FATAL_FAILURE(step());
  }
  EXPECT_EQ(harness_->risks.front()->level, RiskArray::LEVEL_NONE);
  const RiskArray& last = *harness_->risks.back();
  EXPECT_GE(last.level, RiskArray::LEVEL_WARNING);
  EXPECT_EQ(last.cause, 7U);
  EXPECT_NE(last.reason.find("vehicle 7"), std::string::npos) << last.reason;
}

TEST_F(RiskTest, DiagnosticsReportTheLevel) {
  EXPECT_TRUE(harness_->waitFor([] {
    return harness_->diagnostic("level, 0 (none) to 3 (imminent)") >= RiskArray::LEVEL_WARNING;
  }));
  EXPECT_EQ(harness_->diagnostic("dropped"), 0.0);
}

TEST_F(RiskTest, InvalidTracksAreCounted) {
  ASSERT_NO_FATAL_FAILURE(sendHost());
  TrackArray tracks = carAhead(now_);
  tracks.tracks.front().covariance[0] = std::numeric_limits<double>::quiet_NaN();
  harness_->sendTracks(tracks);
  EXPECT_TRUE(harness_->waitForCount("warned: bad_track", 1.0));
  now_ += kLongStep;
}

TEST_F(RiskTest, MeasuredSteeringAndBrakingChangeTheExpectedPath) {
  const auto lengthOf = [](const RiskArray& risks) {
    return risks.host_path.back().x - risks.host_path.front().x;
  };
  for (int i = 0; i < 5 && lengthOf(*harness_->risks.back()) > 3.0; ++i) {  // they may come late
    harness_->sendDriver(now_);
    ASSERT_NO_FATAL_FAILURE(step());
  }
  const RiskArray& last = *harness_->risks.back();
  EXPECT_LT(lengthOf(last), 3.0) << "5 m/s at 6 m/s^2";
  EXPECT_GT(last.host_path.back().theta, 0.05);
}

TEST_F(RiskTest, ALoopedBagStartsOver) {
  now_ = 0.0;
  ASSERT_NO_FATAL_FAILURE(step());
  EXPECT_EQ(harness_->risks.back()->level, RiskArray::LEVEL_NONE);
}

}  // namespace
}  // namespace datmo::risk_test
