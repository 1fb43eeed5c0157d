// SPDX-License-Identifier: BSD-3-Clause
// What stages receive in place of a message.
#include "run_bag/graph_runner.h"

#include "run_bag_drive.h"
#include <boost/make_shared.hpp>
#include <gtest/gtest.h>

namespace datmo::graph_runner_test {
namespace {

class GraphRunnerTest : public RunBag {};

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

}  // namespace
}  // namespace datmo::graph_runner_test
