// SPDX-License-Identifier: BSD-3-Clause
// The small bag through replay.launch, faster than it was recorded: no scan is lost on the way, and
// moving objects are tracked.
#include <set>

#include "chain.h"
#include <gtest/gtest.h>
#include <std_srvs/SetBool.h>

#include <rosbag/bag.h>
#include <rosbag/view.h>

namespace datmo::replay_test {
namespace {

/// Scans at the start that may overtake the scanner's mount or the first odometry.
constexpr int kStartUp = 2;

int scansIn(const std::string& file) {
  const rosbag::Bag bag(file);
  return static_cast<int>(rosbag::View(bag, rosbag::TopicQuery("/echoes")).size());
}

TEST(ReplayTest, EveryScanOfTheBagLeadsToTracks) {
  std::string file;
  ASSERT_TRUE(ros::param::get("~bag", file));
  const int scans = scansIn(file);
  ASSERT_GT(scans, 100);

  Listener chain;
  ASSERT_TRUE(chain.waitForNodelets());
  std_srvs::SetBool resume;
  resume.request.data = false;
  ASSERT_TRUE(ros::service::waitForService("/player/pause_playback", ros::Duration(120.0)));
  ASSERT_TRUE(ros::service::call("/player/pause_playback", resume));

  EXPECT_TRUE(chain.waitFor([&] { return chain.timings["tracker"] >= scans - kStartUp; }));
  EXPECT_TRUE(
      chain.waitFor([&] { return chain.diagnostic("grid_slam", "scan received") == scans; }));
  EXPECT_GE(chain.timings["grid_slam"], scans - kStartUp);
  EXPECT_TRUE(
      chain.waitFor([&] { return chain.timings["moving_objects"] == chain.timings["grid_slam"]; }));
  EXPECT_EQ(chain.diagnostic("moving_objects", "dropped"), 0.0);

  std::set<std::uint32_t> ids;
  for (const auto& list : chain.tracks) {
    for (const TrackMessage& track : list->tracks) {
      ids.insert(track.id);
    }
  }
  EXPECT_GE(ids.size(), 3U) << "the scene has nine moving objects";
}

}  // namespace
}  // namespace datmo::replay_test
