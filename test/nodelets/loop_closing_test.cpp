// SPDX-License-Identifier: BSD-3-Clause
// The running loop_closing nodelet after a scripted grid_slam, whose pose drifts over two laps.
#include <string>
#include <vector>

#include "labeled_scan_harness.h"
#include "slam/drift_drive.h"
#include <datmo_fusion/SaveMap.h>
#include <gtest/gtest.h>

#include <nav_msgs/Path.h>

namespace datmo::loop_closing_test {
namespace {

constexpr double kStep = 0.2;  // s

class LoopClosingHarness : public LabeledScanHarness {
 public:
  LoopClosingHarness() : LabeledScanHarness("loop_closing") {}

  std::vector<nav_msgs::PathConstPtr> paths;
  std::vector<nav_msgs::OccupancyGridConstPtr> optimized_maps;

 private:
  ros::Subscriber path_ = node_.subscribe<nav_msgs::Path>(
      "trajectory/optimized", kQueue,
      [this](const nav_msgs::PathConstPtr& path) { paths.push_back(path); });
  ros::Subscriber map_ = node_.subscribe<nav_msgs::OccupancyGrid>(
      "map/optimized", kQueue,
      [this](const nav_msgs::OccupancyGridConstPtr& map) { optimized_maps.push_back(map); });
};

TEST(LoopClosingTest, TheDriftOfTwoLapsIsRemoved) {
  LoopClosingHarness harness;
  ASSERT_TRUE(harness.waitForNodelet());
  const std::vector<Pose2> truth = roundTheYard(2);
  Pose2 live = truth.front();
  double seconds = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i, seconds += kStep) {
    live = i == 0 ? live : live * drifting(truth[i - 1].inverse() * truth[i]);
    LabeledScan scan = labeled(Yard().scan(truth[i], 0.0), live);
    scan.stamp = Stamp::fromSeconds(samples::kStart + seconds);
    harness.setClock(seconds);
    harness.send(scan);
    ASSERT_TRUE(harness.waitFor([&] {
      return harness.diagnostic("trajectories started") >= 0.0 &&
             harness.transforms.core().canTransform("map", "global_map", toTime(scan.stamp));
    })) << i
        << ": " << harness.diagnosticMessage();
  }
  const auto is_done = [&] {
    return !harness.paths.empty() && harness.paths.back()->poses.size() == truth.size() &&
           !harness.optimized_maps.empty();
  };
  constexpr double kMaxWait = 120.0;  // s, as of a Listener
  for (const double end = seconds + kMaxWait; seconds < end && !harness.waitFor(is_done, 1.0);) {
    seconds += 1.0;
    harness.setClock(seconds);
  }
  ASSERT_TRUE(is_done());
  const Pose2 end = fromMessage(harness.paths.back()->poses.back().pose);
  EXPECT_LT((end.position() - truth.back().position()).norm(), 0.3);
  EXPECT_GT((live.position() - truth.back().position()).norm(), 1.0);
  EXPECT_TRUE(harness.waitFor([&] { return harness.diagnostic("loops closed") > 1.0; }));
  datmo_fusion::SaveMap save;
  save.request.file = "relative.map";
  ASSERT_TRUE(ros::service::call("loop_closing/save_map", save));
  EXPECT_FALSE(save.response.success);
}

}  // namespace
}  // namespace datmo::loop_closing_test
