// SPDX-License-Identifier: BSD-3-Clause
// A track's lifetime, its existence probability, and its history.
#include <cmath>

#include "tracking_scene.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/class_belief.h"

namespace datmo::track_life_test {
namespace {

constexpr double kSpeed = 4.0;  // m/s

FieldOfView allAround() {
  FieldOfView view;
  view.range = 300.0;
  return view;
}

/// Nothing is occluded.
Visibility openView() { return {allAround(), {}, VisibilityOptions()}; }

/// A wall near the sensor occludes everything ahead.
Visibility blockedView() {
  return {allAround(), {Box2{Pose2(4.0, 0.0, 0.0), 0.5, 40.0}}, VisibilityOptions()};
}

void drive(TrackingScene& scene, int scans, double speed = kSpeed) {
  for (int i = 0; i < scans; ++i) {
    const double x = 10.0 + speed * (scene.nextTime() - 100.0);
    scene.scan({objectAt(x + scene.noise(0.05), scene.noise(0.05))}, openView());
  }
}

/// Returns the number of scans until no track is published.
int scansWithout(TrackingScene& scene, const Visibility& view) {
  int scans = 0;
  while (!scene.scan({}, view).tracks.empty() && scans < 100) {
    ++scans;
  }
  return scans;
}

TEST(TrackLife, AVisibleTrackEndsSoonerThanAHiddenOne) {
  TrackingScene open;
  TrackingScene blocked;
  drive(open, 50);
  drive(blocked, 50);
  ASSERT_EQ(open.tracks().tracks.size(), 1U);
  const int seen = scansWithout(open, openView());
  const int hidden = scansWithout(blocked, blockedView());
  EXPECT_LT(seen, hidden);
  EXPECT_GE(seen, 1) << "one miss may always happen";
  EXPECT_NEAR(0.1 * hidden, TrackerOptions().published_silence, 0.11);
}

TEST(TrackLife, ExistenceFallsWithEachMissAsBayesSays) {
  // odds' = odds (1 - P_D), as the track score is the logarithm of the odds up to the prior.
  TrackingScene scene;
  drive(scene, 50);
  double last = scene.tracks().tracks.at(0).existence_probability;
  EXPECT_GT(last, 0.99);
  const double miss = 1.0 - VisibilityOptions().unknown_probability;
  for (int i = 0; i < 10; ++i) {
    scene.scan({});
    ASSERT_EQ(scene.tracks().tracks.size(), 1U);
    const double found = scene.tracks().tracks[0].existence_probability;
    const double odds = last / (1.0 - last) * miss;
    EXPECT_NEAR(found / (odds / (1.0 + odds)), 1.0, 1e-6) << "miss " << i;
    last = found;
  }
}

TEST(TrackLife, IsPublishedWhileItProbablyExists) {
  TrackerOptions options;
  options.published_existence = 0.99;
  TrackingScene strict(options);
  TrackingScene usual;
  drive(strict, 50);
  drive(usual, 50);
  EXPECT_LT(scansWithout(strict, openView()), scansWithout(usual, openView()));
}

TEST(TrackLife, ATargetThatMayNotExistIsNotConfirmed) {
  TrackerOptions options;
  options.require_motion = false;
  options.confirmation_hits = 1;
  options.confirmation_existence = 0.9;
  TrackingScene scene(options);
  scene.scan({objectAt(10.0, 0.0)});
  EXPECT_TRUE(scene.tracks().tracks.empty());
  for (int i = 0; i < 5; ++i) {
    scene.scan({objectAt(10.0, 0.0)});
  }
  ASSERT_EQ(scene.tracks().tracks.size(), 1U);
  EXPECT_GE(scene.tracks().tracks[0].existence_probability, 0.9);
}

TEST(TrackLife, HistoryIsWhereItWasPublishedOldestFirst) {
  TrackerOptions options;
  options.history_time = 1.0;
  TrackingScene scene(options);
  std::vector<PathPoint> published;
  for (int i = 0; i < 40; ++i) {
    drive(scene, 1);
    if (scene.tracks().tracks.empty()) {
      continue;
    }
    const Track& track = scene.tracks().tracks[0];
    published.push_back({scene.tracks().stamp, track.box.center});
    ASSERT_FALSE(track.history.empty());
    ASSERT_LE(track.history.size(), published.size());
    const std::size_t skipped = published.size() - track.history.size();
    for (std::size_t k = 0; k < track.history.size(); ++k) {
      EXPECT_EQ(track.history[k].stamp, published[skipped + k].stamp);
      EXPECT_EQ(track.history[k].pose.position(), published[skipped + k].pose.position());
    }
  }
  EXPECT_EQ(scene.tracks().tracks.at(0).history.size(), 11U) << "1 s at 10 Hz, both ends";
}

TEST(TrackLife, ObjectsOfATrackAreThoseOfTheSensorsList) {
  TrackingScene scene;
  for (int i = 0; i < 20; ++i) {
    const double x = 10.0 + kSpeed * (scene.nextTime() - 100.0);
    scene.scan({objectAt(60.0, 0.0), objectAt(x, 0.0), objectAt(-60.0, 0.0)});
  }
  ASSERT_EQ(scene.tracks().tracks.size(), 1U);
  EXPECT_EQ(scene.tracks().tracks[0].objects, std::vector<std::size_t>{1});
  scene.scan({});
  ASSERT_EQ(scene.tracks().tracks.size(), 1U);
  EXPECT_TRUE(scene.tracks().tracks[0].objects.empty());
}

TEST(TrackLife, ClassProbabilitiesFollowTheReports) {
  TrackingScene scene;
  for (int i = 0; i < 20; ++i) {
    Object object = objectAt(10.0 + kSpeed * (scene.nextTime() - 100.0), 0.0);
    object.class_probabilities = reportedClass(ObjectClass::kCyclist, 0.8);
    scene.scan({object});
  }
  ASSERT_EQ(scene.tracks().tracks.size(), 1U);
  const ClassProbabilities& classes = scene.tracks().tracks[0].class_probabilities;
  EXPECT_GT(classes[static_cast<std::size_t>(ObjectClass::kCyclist)], 0.9);
  double sum = 0.0;
  for (const double probability : classes) {
    sum += probability;
  }
  EXPECT_NEAR(sum, 1.0, 1e-9);
}

}  // namespace
}  // namespace datmo::track_life_test
