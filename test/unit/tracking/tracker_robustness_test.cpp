// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <limits>
#include <vector>

#include "tracking_scene.h"
#include <gtest/gtest.h>

#include "datmo_fusion/tracking/tracker.h"

namespace datmo::tracker_robustness_test {
namespace {

TEST(TrackerRobustness, AGapOfTenSecondsEndsAllTracks) {
  TrackingScene scene;
  for (int i = 0; i < 20; ++i) {
    scene.scan({objectAt(5.0 * scene.nextTime(), 0.0)});
  }
  scene.wait(10.0);
  EXPECT_TRUE(scene.scan({objectAt(5.0 * scene.nextTime(), 0.0)}).tracks.empty());
}

TEST(TrackerRobustness, TheSameTimeTwiceChangesNoStateWithoutObjects) {
  TrackingScene scene(TrackerOptions(), 0.1);
  for (int i = 0; i < 20; ++i) {
    scene.scan({objectAt(5.0 * scene.nextTime(), 0.0)});
  }
  const Track before = scene.tracks().tracks.at(0);
  const TrackList after = scene.tracker().process({scene.tracks().stamp, {}, {}}, Pose2());
  ASSERT_EQ(after.tracks.size(), 1U);
  EXPECT_TRUE(after.tracks[0].state.isApprox(before.state, 1e-9));
  EXPECT_TRUE(after.tracks[0].covariance.isApprox(before.covariance, 1e-9));
}

TEST(TrackerRobustness, RejectsInvalidObjectsAndUsesTheRest) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  std::vector<Object> broken(8, objectAt(3.0, 3.0));
  broken[0].box.center = Pose2(nan, 0.0, 0.0);
  broken[1].box.center = Pose2(0.0, -inf, 0.0);
  broken[2].box.length = nan;
  broken[3].box.width = -1.0;
  broken[4].position_covariance.setZero();
  broken[5].position_covariance << 1.0, 2.0, 2.0, 1.0;
  broken[6].position_covariance(0, 1) = nan;
  broken[7].heading_variance = inf;
  TrackingScene scene;
  for (int i = 0; i < 20; ++i) {
    std::vector<Object> objects = broken;
    objects.push_back(objectAt(5.0 * scene.nextTime(), 0.0));
    scene.scan(objects);
  }
  EXPECT_EQ(scene.tracker().counts().intake.rejected, 20U * 8U);
  EXPECT_EQ(scene.tracker().counts().intake.accepted, 20U);
  ASSERT_EQ(scene.tracks().tracks.size(), 1U);
  EXPECT_TRUE(scene.tracks().tracks[0].state.allFinite());
}

TEST(TrackerRobustness, ANonFiniteVehiclePoseRejectsTheObjectsOnly) {
  TrackingScene scene;
  scene.scan({objectAt(1.0, 1.0)}, Pose2(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0));
  EXPECT_EQ(scene.tracker().counts().intake.rejected, 1U);
}

TEST(TrackerRobustness, ANonFiniteVehiclePoseLeavesTheTracksUnchanged) {
  FieldOfView view;
  view.range = 100.0;
  const Visibility visibility(view, {}, VisibilityOptions());
  for (const TrackerAssociation association :
       {TrackerAssociation::kMultipleHypotheses, TrackerAssociation::kGlobalNearestNeighbor}) {
    TrackerOptions options;
    options.association = association;
    TrackingScene scene(options);
    for (int i = 0; i < 20; ++i) {
      scene.scan({objectAt(5.0 * (scene.nextTime() - 100.0), 0.0)}, visibility);
    }
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const TrackList list =
        scene.tracker().process({Stamp::fromSeconds(scene.nextTime()), {objectAt(1.0, 1.0)}, {}},
                                Pose2(nan, nan, nan), visibility);
    scene.wait(0.1);
    ASSERT_EQ(list.tracks.size(), 1U) << static_cast<int>(association);
    EXPECT_TRUE(list.tracks[0].state.allFinite());
    EXPECT_GT(list.tracks[0].existence_probability, 0.9);
    scene.scan({objectAt(5.0 * (scene.nextTime() - 100.0), 0.0)}, visibility);
    ASSERT_EQ(scene.tracks().tracks.size(), 1U) << static_cast<int>(association);
    EXPECT_EQ(scene.tracks().tracks[0].id, 1U);
    EXPECT_EQ(scene.tracks().tracks[0].since_update, 0.0);
  }
}

TEST(TrackerRobustness, StampsThatGoBackCorruptNoTrack) {
  TrackingScene scene;
  for (int i = 0; i < 20; ++i) {
    scene.scan({objectAt(5.0 * (scene.nextTime() - 100.0), 0.0)});
  }
  scene.wait(-0.5);
  const TrackList& back = scene.scan({});
  ASSERT_EQ(back.tracks.size(), 1U);
  EXPECT_TRUE(back.tracks[0].state.allFinite());
  EXPECT_GE(back.tracks[0].age, 1.9);
  EXPECT_FALSE(back.tracks[0].history.empty());
}

TEST(TrackerRobustness, EmptyListsFromTheStart) {
  TrackingScene scene;
  for (int i = 0; i < 10; ++i) {
    EXPECT_TRUE(scene.scan({}).tracks.empty());
  }
  EXPECT_EQ(scene.tracker().counts().intake.accepted, 0U);
}

TEST(TrackerRobustness, ResetForgetsTheCounts) {
  TrackerOptions options;
  options.gating.max_targets = 1;
  TrackingScene scene(options);
  scene.scan({objectAt(1.0, 0.0), objectAt(20.0, 0.0)});
  EXPECT_EQ(scene.tracker().counts().association.refused_births, 1U);
  scene.tracker().reset();
  scene.scan({});
  EXPECT_EQ(scene.tracker().counts().association.refused_births, 0U);
  EXPECT_EQ(scene.tracker().counts().intake.accepted, 0U);
}

TEST(TrackerRobustness, AThousandObjectsAtOnePointAreBounded) {
  TrackerOptions options;
  options.gating.max_targets = 300;  // fewer than the objects accepted
  TrackingScene scene(options);
  for (int i = 0; i < 3; ++i) {
    scene.scan(std::vector<Object>(1000, objectAt(10.0, 0.0)));
  }
  const TrackerCounts& counts = scene.tracker().counts();
  const auto taken = static_cast<std::uint64_t>(options.intake.max_objects);
  const auto followed = static_cast<std::uint64_t>(options.gating.max_targets);
  EXPECT_EQ(counts.intake.accepted, 3U * taken);
  EXPECT_EQ(counts.intake.refused, 3U * (1000U - taken));
  EXPECT_GE(counts.association.refused_births, 3U * (taken - followed));
  EXPECT_EQ(counts.confirmed_tracks, 0U);
}

TEST(TrackerRobustness, AThousandObjectsAtOnePointDoNotStallOtherTracks) {
  TrackerOptions options;
  options.require_motion = false;
  TrackingScene scene(options);
  for (int i = 0; i < 20; ++i) {
    scene.scan({objectAt(10.0 + 0.1 * i, 0.0)});
  }
  ASSERT_EQ(scene.tracks().tracks.size(), 1U);
  for (int i = 0; i < 5; ++i) {
    scene.scan(std::vector<Object>(1000, objectAt(12.0 + 0.1 * i, 0.0)));
  }
  ASSERT_FALSE(scene.tracks().tracks.empty());
  EXPECT_EQ(scene.tracks().tracks.front().id, 1U);
  EXPECT_NEAR(scene.tracks().tracks.front().state[0], 12.4, 0.5);
}

TEST(TrackerRobustness, BadOptionsAreRefused) {
  TrackerOptions options;
  options.target.filter.motion.turn_rate = -1.0;
  EXPECT_THROW(Tracker{options}, OptionError);
}

}  // namespace
}  // namespace datmo::tracker_robustness_test
