// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/odometry_wait.h"

#include <map>
#include <string>
#include <vector>

#include "message_samples.h"
#include <boost/make_shared.hpp>
#include <gtest/gtest.h>

#include "datmo_fusion/ros/stage/grid_slam_stage.h"

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

TEST_F(OdometryWaitTest, WhatWaitsIsDroppedOnRequest) {
  know(10.0);
  add(wait_, 10.02, 500.0);
  wait_.clear();
  EXPECT_FALSE(wait_.serveNext(at(600.0)));
  EXPECT_TRUE(served_.empty());
}

/// Sends messages to the inputs of a stage, in simulated time.
class SimulatedPorts : public StagePorts {
 public:
  explicit SimulatedPorts(StageMonitor& monitor) : monitor_(monitor) {}
  bool hasSimulatedTime() const override { return true; }

  template <typename Message>
  void send(const std::string& topic, const Message& message, Stamp now) {
    monitor_.received(topic, now);
    callbacks_.at(topic)(boost::make_shared<Message>(message), now);
  }

 private:
  void addInput(StageInput input) override { callbacks_[input.topic] = input.callback; }
  StageOutput::Publish addOutput(StageOutput /*output*/) override { return {}; }

  StageMonitor& monitor_;
  std::map<std::string, StageInput::Callback> callbacks_;  ///< by topic
};

TEST(GridSlamWaitTest, AScanThatWaitsWhenTheClockJumpsBackIsNotServed) {
  const auto at = [](double seconds) { return Stamp::fromSeconds(seconds); };
  TransformBuffer buffer{1.0};
  buffer.addStatic(samples::transforms({samples::transform("base_link", "scanner", 3.6)}));
  StageMonitor monitor{"grid_slam"};
  GridSlamStageOptions options;
  options.odometry_wait = 0.2;
  GridSlamStage stage(options, buffer, monitor);
  SimulatedPorts ports(monitor);
  stage.connect(ports);
  const std::string odometry = options.motion.odometryTopic();
  const auto scanAt = [&](double seconds) {
    auto scan = samples::laserScan();
    scan.header.stamp = ros::Time(seconds);
    ports.send("scan", scan, at(seconds + 0.01));
  };
  ports.send(odometry, samples::odometry(200.0, 1.0), at(200.0));
  scanAt(200.02);
  EXPECT_EQ(monitor.processedCount(), 0U) << "it waits for odometry";
  ports.send(odometry, samples::odometry(150.0, 1.0), at(150.0));
  EXPECT_EQ(monitor.resetCount(), 1U);
  EXPECT_FALSE(stage.publishNext(at(150.0)));
  EXPECT_EQ(monitor.processedCount(), 0U);
  scanAt(150.0);
  EXPECT_EQ(monitor.processedCount(), 1U);
  EXPECT_EQ(monitor.droppedCount(), 0U);
}

}  // namespace
}  // namespace datmo::odometry_wait_test
