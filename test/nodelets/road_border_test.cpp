// SPDX-License-Identifier: BSD-3-Clause
// The running road_border nodelet after a scripted grid_slam: the output from scans between two
// walls, and what happens with invalid scans. The tests run through one drive, in this order.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "labeled_scan_harness.h"
#include <gtest/gtest.h>

namespace datmo::road_border_test {
namespace {

class RoadBorderHarness : public LabeledScanHarness {
 public:
  RoadBorderHarness() : LabeledScanHarness("road_border") {}

  bool waitForNodelet() {
    return LabeledScanHarness::waitForNodelet() &&
           waitFor([this] { return road_borders_.getNumPublishers() >= 1; });
  }

  std::vector<RoadBordersConstPtr> roads;

 private:
  ros::Subscriber road_borders_ = node_.subscribe<RoadBorders>(
      "road_borders", kQueue, [this](const RoadBordersConstPtr& road) { roads.push_back(road); });
};

class RoadBorderTest : public testing::Test {
 protected:
  static constexpr double kStep = RoadBorderHarness::kStep;

  static void SetUpTestSuite() {
    harness_ = new RoadBorderHarness();
    ASSERT_TRUE(harness_->waitForNodelet());
  }

  static void TearDownTestSuite() { delete harness_; }

  /// Runs one step of the drive; waits for its road.
  static void step() {
    const LabeledScan scan = samples::scanBetweenWalls(now_);
    harness_->setClock(now_);
    harness_->send(scan);
    ASSERT_TRUE(harness_->waitFor([&] {
      return !harness_->roads.empty() && harness_->roads.back()->header.stamp == toTime(scan.stamp);
    })) << now_
        << " s: " << harness_->diagnosticMessage();
    now_ += kStep;
  }

  static void driveOn(double seconds) {
    for (const double end = now_ + seconds - 0.5 * kStep; now_ < end;) {
      ASSERT_NO_FATAL_FAILURE(step());
    }
  }

  /// Sends the current scan after `spoil`; expects that it is counted under `key`, reported, and
  /// leads to no output.
  static void expectDropped(const std::string& reason,
                            const std::function<void(LabeledScanMessage&)>& spoil) {
    const std::size_t before = harness_->roads.size();
    LabeledScanMessage scan = toMessage(samples::scanBetweenWalls(now_), "base_link", "map");
    spoil(scan);
    harness_->send(scan);
    EXPECT_TRUE(harness_->waitForCount("dropped: " + reason, 1.0)) << reason;
    EXPECT_EQ(harness_->roads.size(), before) << reason;
  }

  static const RoadBorders& last() { return *harness_->roads.back(); }

  /// Returns the distance of each point of the last borders from the walls on its side, m.
  static double farthestFromWalls() {
    double farthest = 0.0;
    for (const RoadBorderMessage& border : last().borders) {
      const double wall =
          border.side == RoadBorderMessage::LEFT ? samples::kWallBeside : -samples::kWallBeside;
      for (const auto& point : border.points) {
        farthest = std::max(farthest, std::abs(point.y - wall));
      }
    }
    return farthest;
  }

  /// Returns the distance of the farthest point of the last borders from the vehicle, m.
  static double farthestAhead() {
    const double vehicle = samples::scanBetweenWalls(now_ - kStep).base_in_map.pose.position().x();
    double farthest = 0.0;
    for (const RoadBorderMessage& border : last().borders) {
      for (const auto& point : border.points) {
        farthest = std::max(farthest, point.x - vehicle);
      }
    }
    return farthest;
  }

  static RoadBorderHarness* harness_;
  static double now_;  // s, of the drive
};

RoadBorderHarness* RoadBorderTest::harness_ = nullptr;
double RoadBorderTest::now_ = 0.0;

TEST_F(RoadBorderTest, WallsOnBothSidesAreTheBorders) {
  ASSERT_NO_FATAL_FAILURE(driveOn(2.0));
  EXPECT_EQ(harness_->roads.size(), 32U) << "one for each scan";
  EXPECT_EQ(last().header.frame_id, "map");
  EXPECT_GE(last().borders.size(), 2U);
  EXPECT_LT(farthestFromWalls(), 0.5);
  EXPECT_EQ(last().at_intersection, 0);
}

TEST_F(RoadBorderTest, DiagnosticsReportTheBorders) {
  EXPECT_TRUE(harness_->waitForCount("processed", 32.0));
  EXPECT_TRUE(harness_->waitFor(
      [] { return harness_->diagnostic("stretches of border on the left") >= 1.0; }));
  EXPECT_GE(harness_->diagnostic("stretches of border on the right"), 1.0);
  EXPECT_EQ(harness_->diagnostic("labeled_scan received"), 32.0);
  EXPECT_EQ(harness_->diagnostic("dropped"), 0.0);
  EXPECT_TRUE(harness_->waitFor([] { return harness_->timings["road_border"] == 32; }));
}

TEST_F(RoadBorderTest, InvalidScansAreCounted) {
  expectDropped("bad_pose", [](auto& scan) {
    scan.pose.pose.position.x = std::numeric_limits<double>::quiet_NaN();
  });
  expectDropped("bad_point",
                [](auto& scan) { scan.points.at(0).x = std::numeric_limits<float>::infinity(); });
  expectDropped("wrong_frame", [](auto& scan) { scan.map_frame.clear(); });
  expectDropped("zero_stamp", [](auto& scan) { scan.header.stamp = ros::Time(); });
  expectDropped("old_stamp", [](auto& scan) { scan.header.stamp -= ros::Duration(0.5); });
  ASSERT_NO_FATAL_FAILURE(driveOn(0.5));
  EXPECT_LT(farthestFromWalls(), 0.5);
}

TEST_F(RoadBorderTest, ADynamicOptionChangesTheOutputAndKeepsTheState) {
  constexpr double kAhead = 8.0;  // m
  const double before = farthestAhead();
  ASSERT_GT(before, kAhead + 5.0);
  EXPECT_EQ(askForNumber("road_border", "published/ahead", kAhead), kAhead);
  EXPECT_EQ(ros::param::param("/road_border/published/ahead", 0.0), kAhead);
  ASSERT_NO_FATAL_FAILURE(step());
  EXPECT_LE(farthestAhead(), kAhead + 1.5);
  EXPECT_EQ(askForNumber("road_border", "published/ahead", -1.0), kAhead) << "out of its range";
  EXPECT_TRUE(std::isnan(askForNumber("road_border", "max_step", 5.0))) << "not live";
  EXPECT_EQ(askForNumber("road_border", "published/ahead", 40.0), 40.0);
  ASSERT_NO_FATAL_FAILURE(step());
  EXPECT_GT(farthestAhead(), before - 2.0) << "what was followed is still there";
}

TEST_F(RoadBorderTest, SilenceIsReported) {
  now_ += 3.0;
  harness_->setClock(now_);
  EXPECT_TRUE(harness_->waitForMessage("no labeled_scan for")) << harness_->diagnosticMessage();
  ASSERT_NO_FATAL_FAILURE(driveOn(1.0));
  EXPECT_TRUE(harness_->waitForMessage("runs")) << harness_->diagnosticMessage();
}

TEST_F(RoadBorderTest, ALoopedBagStartsOver) {
  const RoadBorders& first = *harness_->roads.at(31);
  now_ = 0.0;
  ASSERT_NO_FATAL_FAILURE(driveOn(2.0));
  EXPECT_TRUE(harness_->waitForCount("warned: clock_restart", 1.0));
  EXPECT_EQ(last().header.stamp, first.header.stamp);
  EXPECT_EQ(last().borders, first.borders) << "nothing is left of the first run";
}

}  // namespace
}  // namespace datmo::road_border_test
