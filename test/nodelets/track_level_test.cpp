// SPDX-License-Identifier: BSD-3-Clause
// Scanner and stereo camera, each with a tracker, and their tracks fused, on a simulated drive: the
// output, what happens if one of them is silent, and options that change meanwhile. The tests run
// through one drive, in this order, with track fusion alone and with fusion on all levels.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "stereo_drive.h"
#include <gtest/gtest.h>

namespace datmo::track_level_test {
namespace {

constexpr std::uint32_t kQueue = 1000;

const std::vector<std::string> kBothSensors = {"lidar", "stereo"};

/// A number that a nodelet takes while it runs.
struct LiveNumber {
  std::string nodelet;
  std::string option;
  double changed = 0.0;
  double usual = 0.0;  ///< its default
};

/// One of each nodelet of the track level that has any; that of moving_objects leaves no car.
const std::vector<LiveNumber> kLiveNumbers = {
    {"moving_objects", "max_size", 0.5, 20.0},
    {"tracker", "published_existence", 0.6, 0.5},
    {"stereo_tracker", "published_existence", 0.6, 0.5},
    {"track_fusion", "published_existence", 0.9, 0.85},
    {"markers", "line_width", 0.2, 0.12},
};

/// The track level's output from both sensors.
class TrackLevel : public StereoChain {
 public:
  static constexpr char kFusion[] = "track_fusion";

  /// Waits until all nodelets are subscribed and report.
  bool waitForNodelets() {
    return StereoChain::waitForNodelets(
               {"stereo_objects", "tracker", "stereo_tracker", "track_fusion"}) &&
           waitFor([this] {
             return lidar_.getNumPublishers() >= 1 && stereo_.getNumPublishers() >= 1;
           });
  }

  bool isFusedAt(const ros::Time& stamp) const {
    return !tracks.empty() && tracks.back()->header.stamp == stamp;
  }

  std::vector<TrackArrayConstPtr> lidar;
  std::vector<TrackArrayConstPtr> stereo;

 private:
  ros::NodeHandle node_;
  ros::Subscriber lidar_ = node_.subscribe<TrackArray>(
      "tracks/lidar", kQueue, [this](const TrackArrayConstPtr& list) { lidar.push_back(list); });
  ros::Subscriber stereo_ = node_.subscribe<TrackArray>(
      "tracks/stereo", kQueue, [this](const TrackArrayConstPtr& list) { stereo.push_back(list); });
};

class TrackLevelTest : public StereoDriveTest<TrackLevel> {
 protected:
  /// Returns the other car in the newest fused tracks; null if it is not there.
  static const TrackMessage* otherCar() { return chain_->otherCarIn(*chain_->tracks.back()); }

  /// Returns the length (m) of the longest of the scanner's objects in a further step.
  double longestObjectInStep() {
    const ros::Time stamp = world_.scan(now_).header.stamp;
    step();
    EXPECT_TRUE(chain_->waitFor([&] { return newestObjects() == stamp; }));
    double longest = 0.0;
    for (const ObjectMessage& object : chain_->objects.back()->objects) {
      longest = std::max(longest, object.size.x);
    }
    return longest;
  }

  /// Changes a number of each nodelet while they process a step.
  void stepWhileOptionsChange(double LiveNumber::*value) {
    const auto scan = world_.scan(now_);
    send(scan);
    for (const LiveNumber& live : kLiveNumbers) {
      EXPECT_EQ(askForNumber(live.nodelet, live.option, live.*value), live.*value) << live.nodelet;
    }
    ASSERT_NO_FATAL_FAILURE(finish(scan));
  }

  static std::uint32_t id_;  // of the other car's fused track
};

std::uint32_t TrackLevelTest::id_ = 0;

TEST_F(TrackLevelTest, BothSensorsLeadToFusedTracksForEachScan) {
  chain_->sendCameraInfo();
  chain_->mountSensors();
  ASSERT_NO_FATAL_FAILURE(start());
  ASSERT_NO_FATAL_FAILURE(driveOn(2.0));
  const std::size_t steps = chain_->tracks.size();
  EXPECT_TRUE(chain_->waitFor([&] {
    return chain_->lidar.size() == steps && chain_->stereo.size() == steps;
  })) << chain_->lidar.size()
      << " and " << chain_->stereo.size() << " lead to " << steps;
  EXPECT_EQ(chain_->tracks.back()->header.frame_id, "map");
  EXPECT_GE(chain_->tracks.back()->views.size(), 2U)
      << "what each of both could see; with object fusion the first tracker hears both";
  for (const std::string nodelet : {"tracker", "stereo_tracker", "track_fusion"}) {
    EXPECT_EQ(chain_->diagnostic(nodelet, "dropped"), 0.0) << nodelet;
  }
}

TEST_F(TrackLevelTest, AnObjectTrackedByBothIsOneTrack) {
  ASSERT_NO_FATAL_FAILURE(driveOn(0.5));
  const TrackMessage* by_lidar = chain_->otherCarIn(*chain_->lidar.back());
  const TrackMessage* by_stereo = chain_->otherCarIn(*chain_->stereo.back());
  ASSERT_TRUE(by_lidar);
  ASSERT_TRUE(by_stereo);
  const TrackMessage* car = otherCar();
  ASSERT_TRUE(car) << chain_->tracks.back()->tracks.size() << " tracks, none there";
  EXPECT_EQ(car->sensors, kBothSensors);
  EXPECT_TRUE(car->moving);
  ASSERT_EQ(car->sources.size(), 2U);
  EXPECT_EQ(car->sources[0].source, "lidar");
  EXPECT_EQ(car->sources[0].id, by_lidar->id);
  EXPECT_EQ(car->sources[1].source, "stereo");
  EXPECT_EQ(car->sources[1].id, by_stereo->id);
  id_ = car->id;
}

TEST_F(TrackLevelTest, WithoutStereoTheTrackKeepsItsId) {
  for (int i = 0; i < 18; ++i) {
    ASSERT_NO_FATAL_FAILURE(stepWithoutStereo());
  }
  const ros::Time last(World::kStart + now_ - kStep);
  EXPECT_TRUE(chain_->waitFor([&] { return chain_->isFusedAt(last); }))
      << "at once, since stereo is silent";
  const std::size_t steps = chain_->tracks.size();
  EXPECT_TRUE(chain_->waitFor([&] { return chain_->lidar.size() == steps; }))
      << "none is left out: " << chain_->lidar.size() << " lead to " << steps;
  const TrackMessage* car = otherCar();
  ASSERT_TRUE(car);
  EXPECT_EQ(car->id, id_);
  EXPECT_TRUE(chain_->waitFor(
      [] { return chain_->diagnostic("track_fusion", "warned: silent_source") == 1.0; }));
}

TEST_F(TrackLevelTest, ALoopedBag) {
  now_ = 0.0;
  ASSERT_NO_FATAL_FAILURE(start());
  ASSERT_NO_FATAL_FAILURE(driveOn(2.0));
  EXPECT_TRUE(chain_->waitFor(
      [] { return chain_->diagnostic("track_fusion", "warned: clock_restart") == 1.0; }));
  const TrackMessage* car = otherCar();
  ASSERT_TRUE(car);
  EXPECT_GT(car->id, id_) << "no id is used again";
}

/// The thread sanitizer watches these requests, too (scripts/test).
TEST_F(TrackLevelTest, OptionsChangeWhileMessagesAreProcessed) {
  ASSERT_NO_FATAL_FAILURE(stepWhileOptionsChange(&LiveNumber::changed));
  EXPECT_LE(longestObjectInStep(), kLiveNumbers.front().changed);
  ASSERT_NO_FATAL_FAILURE(stepWhileOptionsChange(&LiveNumber::usual));
  EXPECT_GT(longestObjectInStep(), kLiveNumbers.front().changed);
  ASSERT_NO_FATAL_FAILURE(driveOn(0.5));  // the car may be missing in up to three scans
  EXPECT_TRUE(otherCar()) << "the others have kept their state";
}

}  // namespace
}  // namespace datmo::track_level_test
