// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "chain.h"
#include <gtest/gtest.h>

namespace datmo {

/// Tests that run through one drive with both sensors, in their order. `Level`: a StereoChain whose
/// isFusedAt(stamp) returns whether the level's output for the scan of that stamp has arrived, and
/// whose kFusion is the nodelet that publishes it.
template <typename Level>
class StereoDriveTest : public testing::Test {
 protected:
  static constexpr double kStep = 1.0 / 16.0;  // s

  static void SetUpTestSuite() {
    chain_ = new Level();
    ASSERT_TRUE(chain_->waitForNodelets());
  }

  static void TearDownTestSuite() { delete chain_; }

  /// Prepares the first step, and the one after a jump of the clock.
  void start() { ASSERT_TRUE(chain_->prepareMotion(now_)); }

  /// Runs one step of the drive with both sensors; waits for its fused output.
  void step() { step(world_.scan(now_)); }
  void step(const sensor_msgs::LaserScan& scan) {
    send(scan);
    finish(scan);
  }

  /// Sends what a step sends.
  void send(const sensor_msgs::LaserScan& scan) {
    chain_->sendMotion(now_);
    chain_->sendCloud(world_.cloud(now_));
    chain_->sendScan(scan);
  }

  /// Waits for the fused output of what was sent.
  void finish(const sensor_msgs::LaserScan& scan) {
    ASSERT_TRUE(chain_->waitFor([&] { return chain_->isFusedAt(scan.header.stamp); }))
        << now_ << " s: " << chain_->diagnosticMessage(Level::kFusion);
    now_ += kStep;
  }

  void driveOn(double seconds) {
    for (const double end = now_ + seconds - 0.5 * kStep; now_ < end;) {
      ASSERT_NO_FATAL_FAILURE(step());
    }
  }

  /// Runs a step with the scanner alone; waits for the lidar's objects of some earlier steps, since
  /// fusion waits for a camera that is not known to be silent.
  void stepWithoutStereo() {
    const ros::Duration wait(3.0 * kStep);
    chain_->sendMotion(now_);
    const auto scan = world_.scan(now_);
    chain_->sendScan(scan);
    ASSERT_TRUE(chain_->waitFor([&] { return newestObjects() + wait >= scan.header.stamp; }))
        << now_ << " s";
    now_ += kStep;
  }

  static ros::Time newestObjects() {
    return chain_->objects.empty() ? ros::Time() : chain_->objects.back()->header.stamp;
  }

  static Level* chain_;
  static double now_;  // s, of the drive
  World world_;
};

template <typename Level>
Level* StereoDriveTest<Level>::chain_ = nullptr;
template <typename Level>
double StereoDriveTest<Level>::now_ = 0.0;

}  // namespace datmo
