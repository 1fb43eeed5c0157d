// SPDX-License-Identifier: BSD-3-Clause
// The process of all nodelets is killed: it is restarted with all of them, and they continue the
// drive with a new map.
#include <csignal>
#include <iostream>
#include <string>

#include "chain.h"
#include <gtest/gtest.h>

namespace datmo::manager_test {
namespace {

TEST(ManagerTest, AfterAKillItRestartsWithAllNodelets) {
  const World world;
  Chain chain;
  ASSERT_TRUE(chain.waitForNodelets());
  chain.mountSensors();
  ASSERT_TRUE(chain.prepareMotion(0.0));
  ASSERT_TRUE(chain.drive(0.0, 2.0));
  const pid_t killed = processOf("/perception");
  ASSERT_GT(killed, 0);

  const ros::SteadyTime start = ros::SteadyTime::now();
  ASSERT_EQ(kill(killed, SIGKILL), 0);
  ASSERT_TRUE(chain.waitFor([&] {
    const pid_t now = processOf("/perception");
    return now > 0 && now != killed;
  }));
  const std::size_t tracks = chain.tracks.size();  // all from the killed process have arrived
  double now = 2.0;
  // The clock follows wall time: nobody waits for the drive.
  EXPECT_TRUE(chain.waitFor([&] {
    now += 0.01;
    chain.sendMotion(now);
    chain.sendScan(world.scan(now));
    return chain.tracks.size() > tracks;
  }));
  EXPECT_TRUE(chain.waitFor([&] {
    return chain.diagnostic("stack", "restarts of its process") == 1.0;
  })) << "whoever reads the diagnostics learns of it";
  std::cout << "tracks came again " << (ros::SteadyTime::now() - start).toSec() << " s after\n";
}

}  // namespace
}  // namespace datmo::manager_test
