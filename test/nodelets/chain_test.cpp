// SPDX-License-Identifier: BSD-3-Clause
// The lidar chain on a simulated drive: every scan leads to all outputs, and they are correct.
#include "chain.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/frames.h"
#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo::chain_test {
namespace {

constexpr double kDrive = 3.5;  // s
constexpr std::size_t kScans = 56;

class ChainTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    chain_ = new Chain();
    ASSERT_TRUE(chain_->waitForNodelets());
    chain_->mountSensors();
    ASSERT_TRUE(chain_->prepareMotion(0.0));
    ASSERT_TRUE(chain_->drive(0.0, kDrive)) << chain_->diagnosticMessage("tracker");
  }

  static void TearDownTestSuite() { delete chain_; }

  double endOfDrive() const { return kDrive - kDrive / kScans; }

  static Chain* chain_;
  World world_;
};

Chain* ChainTest::chain_ = nullptr;

TEST_F(ChainTest, NoScanIsDropped) {
  EXPECT_TRUE(chain_->waitFor([&] { return chain_->poses.size() == kScans; }));
  EXPECT_TRUE(chain_->waitFor([&] { return chain_->labeled_scans.size() == kScans; }));
  EXPECT_TRUE(chain_->waitFor([&] { return chain_->objects.size() == kScans; }));
  EXPECT_EQ(chain_->tracks.size(), kScans);
  for (const std::string stage : {"grid_slam", "moving_objects", "tracker"}) {
    EXPECT_TRUE(chain_->waitFor([&] { return chain_->timings[stage] == kScans; })) << stage;
    EXPECT_EQ(chain_->diagnostic(stage, "dropped"), 0.0) << stage;
  }
}

TEST_F(ChainTest, DiagnosticsReportHowWellTheScanFits) {
  EXPECT_TRUE(
      chain_->waitFor([&] { return chain_->diagnostic("grid_slam", "points matched") > 0.0; }));
  EXPECT_GT(chain_->diagnostic("grid_slam", "match score, 0 to 1"), 0.0);
  EXPECT_GT(chain_->diagnostic("grid_slam", "weakest direction of the match [m]"), 0.0);
}

TEST_F(ChainTest, ThePoseFollowsTheVehicle) {
  const Pose2 pose = fromMessage(chain_->poses.back()->pose.pose);
  const Pose2 truth = world_.baseInMap(endOfDrive());
  EXPECT_NEAR((pose.position() - truth.position()).norm(), 0.0, 0.3);
  EXPECT_NEAR(pose.heading(), truth.heading(), degrees(1.0));
}

TEST_F(ChainTest, TfLeadsToThePose) {
  const auto& pose = *chain_->poses.back();
  const auto through_tf = [&] {
    return planarPose(chain_->transforms.core(), "map", "base_link", pose.header.stamp);
  };
  ASSERT_TRUE(chain_->waitFor([&] {
    try {
      through_tf();
      return true;
    } catch (const InputError&) {
      return false;
    }
  }));
  EXPECT_NEAR((through_tf().position() - fromMessage(pose.pose.pose).position()).norm(), 0.0, 1e-3);
}

TEST_F(ChainTest, TheMapHasWallsAndFreeSpace) {
  ASSERT_TRUE(chain_->waitFor([&] { return chain_->maps.size() >= 3; }));
  EXPECT_LE(chain_->maps.size(), 4U) << "one a second";
  const auto& map = *chain_->maps.back();
  EXPECT_GT(std::count_if(map.data.begin(), map.data.end(), [](int cell) { return cell > 70; }),
            50);
  const auto& origin = map.info.origin.position;
  const auto column = static_cast<std::size_t>((10.0 - origin.x) / map.info.resolution);
  const auto row = static_cast<std::size_t>((-6.0 - origin.y) / map.info.resolution);
  const int on_the_road = map.data.at(row * map.info.width + column);
  EXPECT_TRUE(on_the_road >= 0 && on_the_road < 30) << on_the_road;
}

TEST_F(ChainTest, TheOtherCarIsTracked) {
  const TrackMessage* car = chain_->otherCarIn(*chain_->tracks.back());
  ASSERT_TRUE(car) << chain_->tracks.back()->tracks.size() << " tracks, none there";
  EXPECT_LT(world_.otherCar(endOfDrive()).distanceTo(fromMessage(car->pose).position()), 1.0);
  EXPECT_TRUE(car->moving);
  EXPECT_NEAR(car->velocity.x, 5.0, 2.0);
  EXPECT_NEAR(car->velocity.y, -4.0, 2.0);
  const auto& objects = chain_->objects.back()->objects;
  EXPECT_TRUE(std::any_of(objects.begin(), objects.end(), [](const ObjectMessage& object) {
    return object.dynamic_state == ObjectMessage::STATE_MOVING;
  }));
}

}  // namespace
}  // namespace datmo::chain_test
