// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/tracker.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "scan_history_samples.h"
#include "tracking_scene.h"
#include <gtest/gtest.h>

namespace datmo::tracker_test {
namespace {

/// Returns the number of scans until the first track is published; -1: never.
int scansUntilConfirmed(TrackingScene& scene, double speed, int max) {
  for (int scan = 1; scan <= max; ++scan) {
    const double x = 15.0 + speed * scene.nextTime();
    if (!scene.scan({objectAt(x + scene.noise(0.1), 2.0 + scene.noise(0.1))}).tracks.empty()) {
      return scan;
    }
  }
  return -1;
}

TEST(Tracker, ConfirmsACyclistInUnknownSpaceWithinSixScansAt10Hz) {
  TrackingScene scene;
  const int scans = scansUntilConfirmed(scene, 4.4, 20);
  EXPECT_GE(scans, 3);
  EXPECT_LE(scans, 6);
  EXPECT_EQ(scene.tracks().tracks.front().id, 1U);
  EXPECT_TRUE(scene.tracks().tracks.front().moving);
}

TEST(Tracker, ConfirmsWithinTheSameTimeAtTheScannersRate) {
  std::vector<int> scans;
  for (int noise = 0; noise < 21; ++noise) {
    TrackingScene scene(TrackerOptions(), 0.06);
    for (int i = 0; i < noise; ++i) {
      scene.noise(1.0);  // a different stretch of the same noise
    }
    scans.push_back(scansUntilConfirmed(scene, 4.4, 30));
    EXPECT_GE(scans.back(), 3);
  }
  std::sort(scans.begin(), scans.end());
  EXPECT_LE(scans[10], 10) << "half of them, in 0.6 s";
  EXPECT_LE(scans[20], 15) << "all of them";
}

TEST(Tracker, EstimatesStateInTheFixedFrameFromAMovingVehicle) {
  TrackingScene scene;
  for (int i = 0; i < 40; ++i) {
    const double time = scene.nextTime() - 100.0;
    const Pose2 base(5.0 * time, 1.0, 0.2 * time);
    const Point2 truth(20.0, -10.0 + 3.0 * time);
    const Point2 seen = base.inverse() * truth;
    scene.scan({objectAt(seen.x() + scene.noise(0.1), seen.y() + scene.noise(0.1))}, base);
  }
  ASSERT_EQ(scene.tracks().tracks.size(), 1U);
  const Track& track = scene.tracks().tracks.front();
  EXPECT_NEAR(track.state[0], 20.0, 0.3);
  EXPECT_NEAR(track.state[1], -10.0 + 3.0 * 4.0, 0.3);
  EXPECT_NEAR(track.state[2], 0.0, 0.5);
  EXPECT_NEAR(track.state[3], 3.0, 0.5);
  EXPECT_NEAR(angleBetween(track.box.center.heading(), 0.5 * kPi), 0.0, 0.2);
  EXPECT_EQ(track.box.center.position(), Point2(track.state.head<2>()));
  EXPECT_NEAR(track.age, 3.9, 1e-6);
  EXPECT_EQ(track.hits, 40U);
}

TEST(Tracker, NeverPublishesStationaryObjectsThatOnlySeemToMove) {
  TrackingScene scene;
  for (int i = 0; i < 100; ++i) {
    scene.scan({objectAt(12.0 + scene.noise(0.2), 3.0 + scene.noise(0.2))});
    EXPECT_TRUE(scene.tracks().tracks.empty()) << "scan " << i;
  }
}

/// A scan of a parked car of which only the part of its side between these x (m) is visible;
/// something nearer hides the rest.
LabeledScan scanOfSide(double rear, double front, double y, double seconds) {
  std::vector<Point2> ends;
  for (int beam = -40; beam <= 40; ++beam) {
    const double bearing = beam * kPi / 90.0;
    const double x = beam > 0 ? y / std::tan(bearing) : 0.0;
    const bool visible = x >= rear && x <= front;
    ends.push_back(visible ? Point2(x, y)
                           : Point2(5.0 * std::cos(bearing), 5.0 * std::sin(bearing)));
  }
  return samples::scanOf(ends, seconds);
}

/// A parked car comes into view: first its rear, then more of its side, then only its front.
TEST(Tracker, NeverPublishesAParkedCarWhoseVisiblePartSlides) {
  for (const double speed : {2.0, 5.0, 10.0}) {
    TrackingScene scene;
    for (double passed = 0.0; passed < 7.0; passed += 0.1 * speed) {
      const double front = std::min(4.5, 0.5 + passed);
      const double rear = std::min(std::max(0.0, passed - 2.5), 4.0);
      Object object = objectAt(10.0 + 0.5 * (front + rear), 3.0 + scene.noise(0.05));
      object.box.length = front - rear;
      object.box.width = 0.2;
      object.points = {{10.0 + rear, 3.0}, {10.0 + front, 3.0}};
      scene.tracker().addScan(scanOfSide(10.0 + rear, 10.0 + front, 3.0, scene.nextTime() - 100.0));
      scene.scan({object});
      EXPECT_TRUE(scene.tracks().tracks.empty()) << speed << " m/s, after " << passed << " m";
    }
  }
}

TEST(Tracker, NeverStartsFromAStaticObjectButKeepsATrackedOne) {
  TrackingScene scene;
  for (int i = 0; i < 20; ++i) {
    scene.scan({objectAt(5.0 * scene.nextTime(), 0.0, DynamicState::kStatic)});
    EXPECT_TRUE(scene.tracks().tracks.empty());
  }
  for (int i = 0; i < 20; ++i) {
    const auto state = i < 10 ? DynamicState::kMoving : DynamicState::kStatic;
    scene.scan({objectAt(5.0 * scene.nextTime(), 0.0, state)});
  }
  ASSERT_EQ(scene.tracks().tracks.size(), 1U);
  EXPECT_EQ(scene.tracks().tracks.front().since_update, 0.0);
}

TEST(Tracker, KeepsTheIdThroughMissedScansAndCoasts) {
  TrackingScene scene;
  for (int i = 0; i < 60; ++i) {
    const double x = 6.0 * (scene.nextTime() - 100.0);
    const bool seen = i < 20 || i >= 28;
    scene.scan(seen ? std::vector<Object>{objectAt(x + scene.noise(0.2), scene.noise(0.2))}
                    : std::vector<Object>{});
    if (!seen) {
      ASSERT_EQ(scene.tracks().tracks.size(), 1U) << "scan " << i;
      EXPECT_GT(scene.tracks().tracks.front().since_update, 0.0);
      EXPECT_TRUE(scene.tracks().tracks.front().moving);
      EXPECT_NEAR(scene.tracks().tracks.front().state[0], x, 1.0);
    }
  }
  EXPECT_EQ(idsOf(scene.tracks()), std::set<std::uint32_t>{1});
}

TEST(Tracker, CoastingIsPublishedForALimitedTimeThenTheTrackDies) {
  TrackerOptions options;
  TrackingScene scene(options);
  for (int i = 0; i < 60; ++i) {
    scene.scan({objectAt(5.0 * scene.nextTime(), 0.0)});
  }
  ASSERT_EQ(scene.tracks().tracks.size(), 1U);
  double silent = 0.0;
  while (!scene.scan({}).tracks.empty()) {
    silent += 0.1;
    ASSERT_LT(silent, 10.0);
  }
  EXPECT_NEAR(silent, options.published_silence, 0.11);
}

TEST(Tracker, AYoungTrackCoastsForAShorterTime) {
  TrackerOptions options;
  TrackingScene scene(options);
  for (int i = 0; i < 12; ++i) {  // 1.1 s
    scene.scan({objectAt(10.0 + 0.5 * i, 0.0)});
  }
  ASSERT_EQ(scene.tracks().tracks.size(), 1U);
  int published = 0;
  while (!scene.scan({}).tracks.empty()) {
    ++published;
    ASSERT_LT(published, 100);
  }
  EXPECT_GE(published, 4);
  EXPECT_LE(published, 6) << "half of the time that it was followed";
}

TEST(Tracker, CrossingTargetsKeepTheirIds) {
  TrackingScene scene;
  for (int i = 0; i < 60; ++i) {
    const double time = scene.nextTime() - 100.0;
    const double a = -15.0 + 5.0 * time;
    scene.scan({objectAt(a + scene.noise(0.1), 0.0 + scene.noise(0.1)),
                objectAt(scene.noise(0.1), -14.0 + 5.0 * time + scene.noise(0.1))});
  }
  ASSERT_EQ(idsOf(scene.tracks()), (std::set<std::uint32_t>{1, 2}));
  int along_x = 0;
  for (const Track& track : scene.tracks().tracks) {
    EXPECT_NEAR(track.state.segment<2>(2).norm(), 5.0, 0.7);
    along_x += track.state[2] > 4.0 ? 1 : 0;
  }
  EXPECT_EQ(along_x, 1);
  EXPECT_EQ(scene.tracker().counts().confirmed_tracks, 2U);
}

TEST(Tracker, ClutterIsNotPublished) {
  TrackingScene scene;
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> position(-40.0, 40.0);
  for (int i = 0; i < 200; ++i) {
    std::vector<Object> objects;
    for (int k = 0; k < 5; ++k) {
      objects.push_back(objectAt(position(engine), position(engine)));
    }
    scene.scan(objects);
  }
  EXPECT_LE(scene.tracker().counts().confirmed_tracks, 2U);
}

TEST(Tracker, AnObjectThatStopsStaysAStationaryTrack) {
  TrackingScene scene;
  double x = 10.0;
  for (int i = 0; i < 100; ++i) {
    const double speed = i < 30 ? 4.0 : std::max(0.0, 4.0 - 0.2 * (i - 30));
    x += 0.1 * speed;
    scene.scan({objectAt(x + scene.noise(0.05), scene.noise(0.05))});
  }
  ASSERT_EQ(idsOf(scene.tracks()), std::set<std::uint32_t>{1});
  EXPECT_FALSE(scene.tracks().tracks.front().moving);
  EXPECT_NEAR(scene.tracks().tracks.front().box.center.heading(), 0.0, 0.2);
}

TEST(Tracker, IdsIncreaseAndAreNotReusedAfterDeathOrReset) {
  TrackingScene scene;
  std::uint32_t last = 0;
  for (int life = 0; life < 4; ++life) {
    for (int i = 0; i < 20; ++i) {
      scene.scan({objectAt(5.0 * scene.nextTime(), 0.0)});
    }
    ASSERT_EQ(scene.tracks().tracks.size(), 1U);
    EXPECT_GT(scene.tracks().tracks.front().id, last);
    last = scene.tracks().tracks.front().id;
    if (life % 2 == 0) {
      scene.wait(20.0);
    } else {
      scene.tracker().reset();
      EXPECT_EQ(scene.tracker().counts().intake.accepted, 0U);
    }
    EXPECT_TRUE(scene.scan({}).tracks.empty());
  }
}

TEST(Tracker, TheOrderOfTheObjectsDoesNotMatter) {
  TrackingScene forward;
  TrackingScene shuffled;
  std::mt19937_64 engine(5);
  for (int i = 0; i < 40; ++i) {
    const double t = forward.nextTime() - 100.0;
    std::vector<Object> objects;
    for (int k = 0; k < 6; ++k) {
      objects.push_back(objectAt(4.0 * t + forward.noise(0.1), 3.0 * k + forward.noise(0.1)));
    }
    forward.scan(objects);
    std::shuffle(objects.begin(), objects.end(), engine);
    shuffled.scan(objects);
    ASSERT_EQ(idsOf(forward.tracks()), idsOf(shuffled.tracks()));
    for (std::size_t k = 0; k < forward.tracks().tracks.size(); ++k) {
      EXPECT_EQ(forward.tracks().tracks[k].state, shuffled.tracks().tracks[k].state);
    }
  }
  EXPECT_EQ(forward.tracks().tracks.size(), 6U);
}

TEST(Tracker, TwoPartsOfOneVanBecomeOneTrack) {
  TrackingScene scene;
  for (int i = 0; i < 60; ++i) {
    const double x = 5.0 * (scene.nextTime() - 100.0);
    Object whole = objectAt(x + scene.noise(0.05), scene.noise(0.05));
    whole.box.length = 5.0;
    whole.box.width = 2.0;
    Object rear = objectAt(x - 2.0 + scene.noise(0.05), scene.noise(0.05));
    rear.box.length = 0.8;
    std::vector<Object> objects{whole};
    if (i >= 20) {
      objects.push_back(rear);
    }
    scene.scan(objects);
  }
  EXPECT_EQ(scene.tracker().counts().confirmed_tracks, 1U);
  EXPECT_GT(scene.tracker().counts().merged_tracks, 0U);
}
}  // namespace
}  // namespace datmo::tracker_test
