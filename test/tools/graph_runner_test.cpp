// SPDX-License-Identifier: BSD-3-Clause
// What stages receive in place of a message, and in which order.
#include "run_bag/graph_runner.h"

#include "ros/labeled_scan_samples.h"
#include "ros/monitor_counts.h"
#include "run_bag_drive.h"
#include <boost/make_shared.hpp>
#include <gtest/gtest.h>

namespace datmo::graph_runner_test {
namespace {

/// A stage that publishes the static points of a labeled scan as a scan, on a topic that all such
/// stages share.
GraphStage staticScan(const std::string& name, bool include_unknown) {
  return {name, "static_points", {}, {{"include_unknown", include_unknown}}};
}

class GraphRunnerTest : public RunBag {
 protected:
  /// Results of a labeled scan of which every other point is in unknown space.
  struct Results {
    std::vector<std::string> topics;
    std::vector<std::vector<std::int8_t>> grids;
    std::uint64_t repeated = 0;  ///< scans that the grid's stage refused
  };

  /// Runs these stages, and one that makes grids of all their scans.
  Results resultsOf(std::vector<GraphStage> stages) const {
    stages.push_back({"lidar_grid", "lidar_grid", {{"scan", "static_scan"}}, {}});
    GraphRunner graph(SensorSet(arguments_.config), stages);
    LabeledScan scan = samples::scanBetweenWalls(0.0);
    for (std::size_t i = 0; i < scan.points.size(); i += 2) {
      scan.points[i].state = PointState::kUnknown;
    }
    const auto message =
        boost::make_shared<const LabeledScanMessage>(toMessage(scan, "base_link", "map"));
    Results results;
    for (const Publication& each : graph.handle("labeled_scan", message, scan.stamp)) {
      results.topics.push_back(each.topic);
      if (const auto grid = each.as<nav_msgs::OccupancyGrid>()) {
        results.grids.push_back(grid->data);
      }
    }
    results.repeated = samples::drops(*graph.monitors().back(), "repeated_stamp");
    return results;
  }
};

TEST_F(GraphRunnerTest, AChangeIsCalledOncePerMessageAndNullDropsIt) {
  writeConfig("mounts: {scanner: {x: 2.0}}\n");
  GraphSwitches switches;
  switches.object_fusion = true;  // several stages subscribe to the odometry
  GraphRunner graph(SensorSet(arguments_.config), switches);
  int asked = 0;
  AnyMessage given;
  graph.changeInputs([&](const Publication& /*message*/) {
    ++asked;
    return given;
  });
  const auto odometry = boost::make_shared<const nav_msgs::Odometry>(odometryAt(kStart));
  const auto receivers = [&graph] {
    int count = 0;
    for (const StageMonitor* monitor : graph.monitors()) {
      count += monitor->hasReceived("odometry") ? 1 : 0;
    }
    return count;
  };
  graph.handle("odometry", odometry, kStart);
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(receivers(), 0);
  given = odometry;
  graph.handle("odometry", odometry, kStart);
  EXPECT_EQ(asked, 2);
  EXPECT_GE(receivers(), 2);
}

/// Only a build with the address sanitizer reports it if a served message's place in the queue is
/// read after it was freed (found by scripts/fuzz stages).
TEST_F(GraphRunnerTest, MessagesThatWaitAtOneInputAreServedInTheOrderOfTheirPublication) {
  const GraphStage all = staticScan("all", true);
  const GraphStage known = staticScan("known", false);
  const auto grid_of_all = resultsOf({all}).grids;
  const auto grid_of_known = resultsOf({known}).grids;
  ASSERT_EQ(grid_of_all.size(), 1U);
  ASSERT_NE(grid_of_all, grid_of_known);

  GraphStage again = known;
  again.name = "again";
  const Results first_all = resultsOf({all, known, again});
  EXPECT_EQ(first_all.grids, grid_of_all) << "the others repeat its stamp";
  EXPECT_EQ(first_all.repeated, 2U);
  const std::vector<std::string> scan{"/tf_static", "static_points", "static_scan"};
  std::vector<std::string> expected;
  for (int i = 0; i < 3; ++i) {
    expected.insert(expected.end(), scan.begin(), scan.end());
  }
  expected.emplace_back("grids/lidar");
  EXPECT_EQ(first_all.topics, expected) << "all scans wait before the first is served";
  EXPECT_EQ(resultsOf({known, again, all}).grids, grid_of_known);
}

}  // namespace
}  // namespace datmo::graph_runner_test
