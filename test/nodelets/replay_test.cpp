// SPDX-License-Identifier: BSD-3-Clause
// The small bag through replay.launch, faster than it was recorded: no scan is lost, and moving
// objects are tracked. The player waits if this machine is too slow for that.
#include <set>

#include "chain.h"
#include <gtest/gtest.h>
#include <std_srvs/SetBool.h>

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/MultiEchoLaserScan.h>

namespace datmo::replay_test {
namespace {

/// Scans at the start that may overtake the scanner's mount or the first odometry.
constexpr int kStartUp = 2;

int scansIn(const std::string& file) {
  const rosbag::Bag bag(file);
  return static_cast<int>(rosbag::View(bag, rosbag::TopicQuery("/echoes")).size());
}

/// Plays the bag.
class Replay : public Listener {
 public:
  bool waitForNodelets() {
    return Listener::waitForNodelets() &&
           waitFor([this] { return echoes_.getNumPublishers() >= 1; }) &&
           ros::service::waitForService(kPause, ros::Duration(120.0));
  }

  /// Waits until this many scans have led to tracks; returns false if no further one does.
  bool play(int scans) {
    for (int done = 0; done < scans; done = timings["tracker"]) {
      const auto goes_on = [&] {
        hold(sent_ - timings["tracker"] > kAhead);
        return timings["tracker"] > done;
      };
      if (!waitFor(goes_on)) {
        return false;
      }
    }
    hold(false);
    return true;
  }

 private:
  static constexpr char kPause[] = "/player/pause_playback";
  static constexpr std::uint32_t kQueue = 1000;
  static constexpr int kAhead = 5;  ///< scans, far fewer than a queue has room for

  /// Paused until it is told to play. Ends with the bag, and does not answer then.
  void hold(bool pause) {
    if (pause != is_held_) {
      is_held_ = pause;
      std_srvs::SetBool call;
      call.request.data = static_cast<std::uint8_t>(pause);
      ros::service::call(kPause, call);
    }
  }

  ros::NodeHandle node_;
  int sent_ = 0;
  bool is_held_ = true;
  ros::Subscriber echoes_ = node_.subscribe<sensor_msgs::MultiEchoLaserScan>(
      "/echoes", kQueue, [this](const sensor_msgs::MultiEchoLaserScanConstPtr&) { ++sent_; });
};

TEST(ReplayTest, EveryScanOfTheBagLeadsToTracks) {
  std::string file;
  ASSERT_TRUE(ros::param::get("~bag", file));
  const int scans = scansIn(file);
  ASSERT_GT(scans, 100);

  Replay chain;
  ASSERT_TRUE(chain.waitForNodelets());
  EXPECT_TRUE(chain.play(scans - kStartUp)) << chain.diagnosticMessage("stack");
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
