// SPDX-License-Identifier: BSD-3-Clause
// Faults on the road: each one is counted and named in the diagnostics, nothing crashes, and the
// chain works again afterward. The tests run through one drive, in this order.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "chain.h"
#include "ros/raw_message.h"
#include <gtest/gtest.h>
#include <tf2_msgs/TFMessage.h>

#include "datmo_fusion/ros/convert/message_conversion.h"

namespace datmo::faults_test {
namespace {

constexpr double kStep = 1.0 / 16.0;  // s, between scans
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Publishes these bytes as a message, over the existing connections of this process.
template <typename Message>
void publishRaw(const std::string& topic, const RawMessage<Message>& raw) {
  ros::NodeHandle().advertise<RawMessage<Message>>(topic, 1).publish(raw);
}

class FaultsTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    chain_ = new Chain();
    ASSERT_TRUE(chain_->waitForNodelets());
  }

  static void TearDownTestSuite() { delete chain_; }

  /// Runs the next part of the drive.
  void driveOn(double seconds) {
    ASSERT_TRUE(chain_->drive(now_, now_ + seconds))
        << chain_->diagnosticMessage("grid_slam") << chain_->diagnosticMessage("tracker");
    now_ += seconds;
  }

  void expectRightPose() {
    const Pose2 pose = fromMessage(chain_->poses.back()->pose.pose);
    const double then = chain_->poses.back()->header.stamp.toSec() - World::kStart;
    const Point2 truth = world_.baseInMap(then).position() - world_.baseInMap(start_).position();
    EXPECT_NEAR((pose.position() - truth).norm(), 0.0, 0.5);
  }

  /// Sends the world's current scan after `spoil`; expects that grid_slam counts it under `key`.
  void expectCounted(const std::string& key,
                     const std::function<void(sensor_msgs::LaserScan&)>& spoil) {
    const double before = chain_->diagnostic("grid_slam", key);
    auto scan = world_.scan(now_);
    spoil(scan);
    chain_->sendMotion(now_);
    chain_->sendScan(scan);
    EXPECT_TRUE(chain_->waitFor([&] { return chain_->diagnostic("grid_slam", key) > before; }))
        << key;
    now_ += kStep;
  }

  /// Sends the bytes of the world's current scan after `spoil`; expects that grid_slam counts them.
  void expectUndecodable(const std::function<void(std::vector<std::uint8_t>&)>& spoil) {
    const std::string key = "dropped: undecodable_message";
    const double before = chain_->diagnostic("grid_slam", key);
    auto raw = toRaw(world_.scan(now_));
    spoil(raw.bytes);
    chain_->sendMotion(now_);
    publishRaw("scan", raw);
    EXPECT_TRUE(
        chain_->waitFor([&] { return chain_->diagnostic("grid_slam", key) == before + 1.0; }));
    now_ += kStep;
  }

  static Chain* chain_;
  static double now_;    // s, of the drive
  static double start_;  // s, where the present map begins
  World world_;
};

Chain* FaultsTest::chain_ = nullptr;
double FaultsTest::now_ = 0.0;
double FaultsTest::start_ = 0.0;

TEST_F(FaultsTest, AMissingTransformThatArrivesLater) {
  expectCounted("dropped: missing_transform", [](auto&) {});
  EXPECT_NE(chain_->diagnosticMessage("grid_slam").find("base_link -> scanner"), std::string::npos);
  EXPECT_TRUE(chain_->poses.empty());
  chain_->mountSensors();
  ASSERT_TRUE(chain_->prepareMotion(now_));
  start_ = now_;
  driveOn(1.0);
  expectRightPose();
}

TEST_F(FaultsTest, InvalidScans) {
  expectCounted("dropped: empty_scan", [](auto& scan) { scan.ranges.clear(); });
  expectCounted("dropped: wrong_size", [](auto& scan) { scan.ranges.resize(7); });
  expectCounted("dropped: bad_geometry", [](auto& scan) { scan.angle_increment = 0.0F; });
  expectCounted("dropped: bad_geometry", [](auto& scan) { scan.range_max = kNan; });
  expectCounted("dropped: zero_stamp", [](auto& scan) { scan.header.stamp = ros::Time(); });
  expectCounted("dropped: missing_frame", [](auto& scan) { scan.header.frame_id = ""; });
  driveOn(0.5);
  expectRightPose();
}

TEST_F(FaultsTest, AnUndecodableScanCostsOneMessage) {
  const std::string lost = "dropped: lost_message";
  const double lost_before = chain_->diagnostic("grid_slam", lost);
  expectUndecodable([](auto& bytes) { bytes.resize(bytes.size() / 2); });
  EXPECT_NE(chain_->diagnosticText("grid_slam", "last error")
                .find("/scan from " + ros::this_node::getName()),
            std::string::npos)
      << chain_->diagnosticText("grid_slam", "last error");
  driveOn(0.5);
  const std::size_t ranges_at =
      ros::serialization::serializationLength(world_.scan(now_).header) + 7 * sizeof(float);
  expectUndecodable([ranges_at](auto& bytes) {
    std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(ranges_at), 4, std::uint8_t{0xFF});
  });
  EXPECT_NE(chain_->diagnosticText("grid_slam", "last error").find("4294967295 elements"),
            std::string::npos)
      << chain_->diagnosticText("grid_slam", "last error");
  driveOn(0.5);
  expectRightPose();
  // Diagnostics from after the gaps.
  expectCounted("dropped: empty_scan", [](auto& scan) { scan.ranges.clear(); });
  EXPECT_EQ(chain_->diagnostic("grid_slam", lost), lost_before);
}

TEST_F(FaultsTest, AnUndecodableTransformIsCountedByAllStages) {
  const std::string key = "dropped: undecodable_message";
  const std::vector<std::string> stages = {"grid_slam", "tracker"};
  std::vector<double> before;
  for (const std::string& stage : stages) {
    before.push_back(chain_->diagnostic(stage, key));
  }
  auto raw = toRaw(tf2_msgs::TFMessage());
  raw.bytes[0] = 1;  // one transform, but none follows
  publishRaw("/tf", raw);
  for (std::size_t i = 0; i < stages.size(); ++i) {
    EXPECT_TRUE(chain_->waitFor([&] {
      return chain_->diagnostic(stages[i], key) == before[i] + 1.0;
    })) << stages[i];
  }
  driveOn(0.5);
  expectRightPose();
}

TEST_F(FaultsTest, ATransformAtTheEndOfTimeIsIgnored) {
  tf2_msgs::TFMessage nobody;
  nobody.transforms.resize(1);
  nobody.transforms[0].header.stamp = ros::Time(4294967295U, 0);
  nobody.transforms[0].header.frame_id = "nobody";
  nobody.transforms[0].child_frame_id = "knows";
  nobody.transforms[0].transform.rotation.w = 1.0;
  publishRaw("/tf", toRaw(nobody));
  EXPECT_TRUE(chain_->waitFor(
      [] { return chain_->diagnostic("grid_slam", "warned: stamp_out_of_range") > 0.0; }));
  driveOn(0.5);
  expectRightPose();
}

TEST_F(FaultsTest, ScansWithoutAValidBeam) {
  for (const float range : {kNan, -kInfinity, -1.0F, 0.0F}) {
    expectCounted("warned: no_valid_beam", [range](auto& scan) {
      std::fill(scan.ranges.begin(), scan.ranges.end(), range);
    });
  }
  driveOn(0.5);
  expectRightPose();
}

TEST_F(FaultsTest, AScanIntoTheOpenIsNoFault) {
  expectCounted("processed",
                [](auto& scan) { std::fill(scan.ranges.begin(), scan.ranges.end(), kInfinity); });
  driveOn(0.5);
  expectRightPose();
}

TEST_F(FaultsTest, RepeatedAndLateScans) {
  const double last = now_ - kStep;
  const auto scan_of = [&](double then) {
    return [this, then](sensor_msgs::LaserScan& scan) { scan = world_.scan(then); };
  };
  expectCounted("dropped: repeated_stamp", scan_of(last));
  expectCounted("dropped: old_stamp", scan_of(last - 0.5));
  driveOn(0.5);
  expectRightPose();
}

TEST_F(FaultsTest, AStampFarOffCostsOneMessage) {
  const double restarts = chain_->diagnostic("grid_slam", "warned: clock_restart");
  for (const double off : {1.1, -1.5, 1e6}) {
    expectCounted("dropped: stray_stamp",
                  [off](auto& scan) { scan.header.stamp += ros::Duration(off); });
  }
  driveOn(0.5);
  expectRightPose();
  EXPECT_EQ(chain_->diagnostic("grid_slam", "warned: clock_restart"), restarts);
}

TEST_F(FaultsTest, AGapOfThreeSeconds) {
  now_ += 3.0;
  ASSERT_TRUE(chain_->prepareMotion(now_));
  driveOn(1.0);
  expectRightPose();
}

TEST_F(FaultsTest, ALoopedBag) {
  now_ = start_;
  chain_->sendMotion(now_ - kStep);
  ASSERT_TRUE(chain_->waitFor(
      [] { return chain_->diagnostic("grid_slam", "warned: clock_restart") > 0.0; }));
  driveOn(2.0);
  expectRightPose();
  EXPECT_TRUE(chain_->waitFor(
      [] { return chain_->diagnostic("tracker", "warned: clock_restart") == 1.0; }));
}

}  // namespace
}  // namespace datmo::faults_test
