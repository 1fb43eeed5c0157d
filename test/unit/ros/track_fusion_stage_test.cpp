// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/track_fusion_stage.h"

#include <map>
#include <string>
#include <vector>

#include "track_fusion_sample.h"
#include <gtest/gtest.h>

namespace datmo::track_fusion_stage_test {
namespace {

using Members = std::map<std::string, std::uint32_t>;

const Members kBoth = {{"lidar", 11}, {"stereo", 22}};

/// The car is where it was at the list's own time.
void expectCarThere(const TrackArray& list) {
  ASSERT_EQ(list.tracks.size(), 1U) << list.header.stamp;
  EXPECT_NEAR(list.tracks[0].pose.position.x, carAt(list.header.stamp.toSec()), 0.01)
      << list.header.stamp;
  EXPECT_NEAR(list.tracks[0].pose.position.y, 0.0, 0.01);
}

TEST_F(TrackFusionStageTest, AListOfTheReferenceWaitsForNoOtherIfConfigured) {
  options_.matcher.max_wait = 0.0;
  TrackFusionStage impatient(options_, monitor_);
  const Stamp stamp = Stamp::fromSeconds(100.0);
  impatient.handleTracks("stereo", carOf("stereo", 99.95), stamp);
  impatient.handleTracks("lidar", carOf("lidar", 100.0), stamp);
  const auto fused = impatient.next(stamp);
  ASSERT_TRUE(fused);
  EXPECT_EQ(fused->header.stamp, ros::Time(100.0));
}

TEST_F(TrackFusionStageTest, ListsOfTheSameStampAreFusedAtOnce) {
  handle("lidar", 100.0);
  EXPECT_FALSE(nextAt(100.0)) << "the other one may still come";
  handle("stereo", 100.0);
  const auto fused = nextAt(100.0);
  ASSERT_TRUE(fused);
  EXPECT_EQ(fused->header.frame_id, "map");
  EXPECT_EQ(fused->header.stamp, ros::Time(100.0));
  EXPECT_FALSE(nextAt(100.0));
  EXPECT_EQ(monitor_.processedCount(), 1U);
  EXPECT_EQ(monitor_.droppedCount() + monitor_.warningCount(), 0U);
}

TEST_F(TrackFusionStageTest, AnObjectTrackedByBothIsOneTrack) {
  const auto fused =
      play(listsOf("lidar", 100.0, 101.0, 0.1), listsOf("stereo", 100.0, 101.0, 0.1));
  ASSERT_EQ(fused.size(), 10U);
  expectCarThere(*fused.back());
  EXPECT_EQ(membersOf(*fused.back()), kBoth);
  EXPECT_EQ(fused.back()->tracks[0].sensors, (std::vector<std::string>{"lidar", "stereo"}));
  EXPECT_EQ(figure("tracks of two or more sources"), 1.0);
  EXPECT_EQ(figure("tracks published"), 1.0);
}

TEST_F(TrackFusionStageTest, TracksWithoutSensorAreTheSources) {
  Track car = carTrack("", 11, 100.0);
  car.sensors.clear();
  handle("lidar", list(100.0, {car}));
  handle("stereo", list(100.0, {}));
  const auto fused = nextAt(100.0);
  ASSERT_TRUE(fused);
  ASSERT_EQ(fused->tracks.size(), 1U);
  EXPECT_EQ(fused->tracks[0].sensors, std::vector<std::string>{"lidar"});
}

TEST_F(TrackFusionStageTest, AnEmptyListIsOneToo) {
  handle("lidar", list(100.0, {}));
  handle("stereo", list(100.0, {}));
  const auto fused = nextAt(100.0);
  ASSERT_TRUE(fused);
  EXPECT_TRUE(fused->tracks.empty());
}

TEST_F(TrackFusionStageTest, ASlowerSourceIsPredicted) {
  const auto fused =
      play(listsOf("lidar", 100.0, 103.0, 0.0625), listsOf("stereo", 100.0, 103.0, 0.4));
  ASSERT_GE(fused.size(), 46U) << "one for each scan, but those that still wait";
  for (const TrackArrayPtr& one : fused) {
    expectCarThere(*one);
  }
  EXPECT_EQ(membersOf(*fused.back()), kBoth);
  EXPECT_EQ(idsOf(fused).size(), 1U);
  EXPECT_EQ(monitor_.droppedCount() + monitor_.warningCount(), 0U);
}

TEST_F(TrackFusionStageTest, OfAFasterSourceTheNearestListIsUsed) {
  const auto fused =
      play(listsOf("lidar", 100.0, 102.0, 0.2), listsOf("stereo", 100.0, 102.0, 0.05));
  EXPECT_EQ(fused.size(), 10U);
  expectCarThere(*fused.back());
  EXPECT_EQ(membersOf(*fused.back()), kBoth);
  EXPECT_GT(figure("lists of stereo not fused"), 10.0);
  EXPECT_EQ(figure("lists of lidar not fused"), 0.0);
}

class TrackFusionDelayTest : public TrackFusionStageTest {
 protected:
  /// Three seconds of both, each of which arrives this much too late (s).
  void expectBridged(double lidars_delay, double stereos_delay) {
    const auto fused = play(listsOf("lidar", 100.0, 103.0, 0.1, lidars_delay),
                            listsOf("stereo", 100.0, 103.0, 0.1, stereos_delay));
    ASSERT_GE(fused.size(), 28U);
    for (const TrackArrayPtr& one : fused) {
      expectCarThere(*one);
    }
    EXPECT_EQ(membersOf(*fused.back()), kBoth);
    EXPECT_EQ(idsOf(fused).size(), 1U);
    EXPECT_EQ(monitor_.droppedCount() + monitor_.warningCount(), 0U);
  }
};

TEST_F(TrackFusionDelayTest, StereosDelayOfHalfASecondIsBridged) { expectBridged(0.0, 0.5); }
TEST_F(TrackFusionDelayTest, TheScannersDelayOfHalfASecondIsBridged) { expectBridged(0.5, 0.0); }

TEST_F(TrackFusionStageTest, ADelayedSourceIsWaitedForNoLongerThanItMay) {
  Arrivals lists = listsOf("lidar", 100.0, 102.0, 0.05);
  lists.merge(listsOf("stereo", 100.0, 102.0, 0.05, 0.5));
  double newest = 0.0;
  for (const auto& [at, sent] : lists) {
    stage_.handleTracks(sent.source, carOf(sent.source, sent.stamp), Stamp::fromSeconds(at));
    while (const auto fused = nextAt(at)) {
      newest = fused->header.stamp.toSec();
    }
    if (at > 100.5 && at < 102.0) {
      EXPECT_GE(newest, at - options_.matcher.max_wait - 0.051);
    }
  }
}

class TrackFusionGapTest : public TrackFusionStageTest {
 protected:
  /// Ten seconds of both, in the middle of which this one is silent for three.
  std::vector<TrackArrayPtr> playWithout(const std::string& silent) {
    Arrivals lists = listsOf(silent, 100.0, 103.05, 0.1);
    lists.merge(listsOf(silent, 106.0, 110.0, 0.1));
    return play(lists, listsOf(silent == "lidar" ? "stereo" : "lidar", 100.0, 110.0, 0.1));
  }
};

TEST_F(TrackFusionGapTest, ASourceThatReturnsFindsItsFusedTrack) {
  stage_.change({{"scheme", std::string("union")}});
  const auto fused = playWithout("stereo");
  EXPECT_GE(fused.size(), 99U) << "the other one goes on";
  EXPECT_EQ(idsOf(fused).size(), 1U);
  for (const TrackArrayPtr& one : fused) {
    const double then = one->header.stamp.toSec();
    expectCarThere(*one);
    if (then > 104.5 && then < 105.9) {
      EXPECT_EQ(membersOf(*one), (Members{{"lidar", kLidarsId}})) << then;
      EXPECT_EQ(one->tracks[0].sensors, std::vector<std::string>{"lidar"}) << then;
    }
  }
  EXPECT_EQ(membersOf(*fused.back()), kBoth) << "it is back";
  EXPECT_EQ(warnings("silent_source"), 1U);
  EXPECT_EQ(monitor_.droppedCount(), 0U);
}

TEST_F(TrackFusionGapTest, WithoutTheReferenceTheOthersContinue) {
  stage_.change({{"scheme", std::string("union")}});
  const auto fused = playWithout("lidar");
  EXPECT_GE(fused.size(), 99U);
  EXPECT_EQ(idsOf(fused).size(), 1U);
  for (const TrackArrayPtr& one : fused) {
    expectCarThere(*one);
  }
  EXPECT_EQ(membersOf(*fused.back()), kBoth);
  EXPECT_EQ(warnings("silent_source"), 1U);
}

TEST_F(TrackFusionStageTest, ASourceThatIsAlwaysTooLateIsReportedOnce) {
  const auto fused =
      play(listsOf("lidar", 100.0, 104.0, 0.1), listsOf("stereo", 100.0, 104.0, 0.1, 0.75));
  EXPECT_GE(fused.size(), 38U) << "the scanner goes on";
  EXPECT_EQ(warnings("late_source"), 1U);
  EXPECT_EQ(monitor_.warningCount(), 1U);
}

TEST_F(TrackFusionStageTest, AClockJumpBackStartsOverAndIdsContinue) {
  const auto before =
      play(listsOf("lidar", 200.0, 201.0, 0.1), listsOf("stereo", 200.0, 201.0, 0.1));
  const auto after =
      play(listsOf("lidar", 100.0, 101.0, 0.1), listsOf("stereo", 100.0, 101.0, 0.1));
  EXPECT_EQ(warnings("clock_restart"), 1U) << "the other source is part of the same restart";
  EXPECT_EQ(monitor_.droppedCount(), 0U);
  ASSERT_EQ(after.size(), 10U);
  EXPECT_EQ(membersOf(*after.back()), kBoth);
  EXPECT_GT(*idsOf(after).begin(), *idsOf(before).rbegin()) << "none is used again";
}

TEST_F(TrackFusionStageTest, AClockThatJumpsAheadIsFollowed) {
  play(listsOf("lidar", 100.0, 101.0, 0.1), listsOf("stereo", 100.0, 101.0, 0.1));
  const auto after =
      play(listsOf("lidar", 500.0, 501.0, 0.1), listsOf("stereo", 500.0, 501.0, 0.1));
  ASSERT_GE(after.size(), 9U);
  EXPECT_EQ(after.back()->header.stamp, ros::Time(500.9));
  expectCarThere(*after.back());
  EXPECT_EQ(membersOf(*after.back()), kBoth);
}

TEST_F(TrackFusionStageTest, TheSchemeChangesFromTheNextSetOn) {
  handle("lidar", list(100.0, {carTrack("lidar", 1, 100.0)}));
  handle("stereo", list(100.0, {carTrack("stereo", 2, 100.0, 30.0)}));
  stage_.change({{"scheme", std::string("union")}});
  EXPECT_EQ(nextAt(100.0)->tracks.size(), 2U);
  EXPECT_THROW(stage_.change({{"scheme", std::string("by luck")}}), OptionError);
  stage_.change({{"scheme", std::string("fused_plus_fallback")}});
  handle("lidar", list(100.1, {carTrack("lidar", 1, 100.1)}));
  handle("stereo", list(100.1, {carTrack("stereo", 2, 100.1, 30.0)}));
  const auto fused = nextAt(100.1);
  ASSERT_TRUE(fused);
  ASSERT_EQ(fused->tracks.size(), 1U) << "of what stereo has alone, nothing";
  EXPECT_EQ(fused->tracks[0].sensors, std::vector<std::string>{"lidar"});
}

}  // namespace
}  // namespace datmo::track_fusion_stage_test
