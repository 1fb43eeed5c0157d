// SPDX-License-Identifier: BSD-3-Clause
// How the tracker handles objects that two sensors see, and their classes.
#include <cmath>
#include <random>

#include "tracking_scene.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/class_belief.h"

namespace datmo::fused_objects_test {
namespace {

constexpr double kWalking = 1.4;  // m/s

/// Scans after which its velocity alone, without beams, is sufficient evidence of a pedestrian.
constexpr int kConfirmedBy = 20;

/// The same if it is misclassified in between: each time as a pole, which does not move.
constexpr int kMistakenConfirmedBy = 40;

/// As reported by the fusion of lidar and stereo if both see it.
Object fusedAt(double x, double y) {
  Object object = objectAt(x, y, DynamicState::kMoving);
  object.sensors = {"lidar", "stereo"};
  object.log_odds = 2.0;
  return object;
}

/// As reported by stereo alone.
Object stereoAt(double x, double y) {
  Object object = objectAt(x, y);
  object.sensors = {"stereo"};
  object.position_covariance = Eigen::Matrix2d::Identity() * 0.09;
  return object;
}

Object classified(Object object, ObjectClass object_class, double probability) {
  object.class_probabilities = reportedClass(object_class, probability);
  return object;
}

Object walkerAt(double x, double y) {
  return classified(fusedAt(x, y), ObjectClass::kPedestrian, 0.8);
}

TEST(FusedObjects, APoleIsNeverTracked) {
  TrackingScene scene;
  for (int i = 0; i < 30; ++i) {
    const Object pole = fusedAt(10.0 + 0.3 * i, 0.0);
    EXPECT_TRUE(scene.scan({classified(pole, ObjectClass::kPole, 0.8)}).tracks.empty());
  }
}

TEST(FusedObjects, LongStationaryObjectsMustBeSeenToMove) {
  // Stereo's noise leaves it open whether it moves; that it was tracked for long does not.
  TrackingScene scene;
  for (int i = 0; i < 30; ++i) {
    Object parked = stereoAt(10.0 + scene.noise(0.8), scene.noise(0.1));
    parked.position_covariance(0, 0) = 0.64;
    scene.scan({parked});
  }
  for (int i = 0; i < 3; ++i) {
    Object echo = walkerAt(10.0 + scene.noise(0.8), 0.0);
    echo.position_covariance(0, 0) = 0.64;
    EXPECT_TRUE(scene.scan({echo}).tracks.empty());
  }
}

TEST(FusedObjects, OneEchoDoesNotMakeAStationaryObjectMove) {
  TrackingScene scene;
  for (int i = 0; i < 20; ++i) {
    scene.scan({stereoAt(10.0 + scene.noise(0.1), scene.noise(0.1))});
  }
  EXPECT_TRUE(scene.scan({walkerAt(10.0, 0.0)}).tracks.empty());
  EXPECT_EQ(scene.tracker().counts().confirmed_tracks, 0U);
}

/// A pedestrian whom stereo misclassifies in this share of the scans.
void walkMistaken(ObjectClass other, double probability, double share) {
  TrackingScene scene;
  std::mt19937_64 engine(17);
  std::bernoulli_distribution mistaken(share);
  for (int i = 0; i < 100; ++i) {
    const double x = 10.0 + 0.1 * kWalking * i;
    const ObjectClass said = mistaken(engine) ? other : ObjectClass::kPedestrian;
    const Object object = fusedAt(x + scene.noise(0.1), scene.noise(0.1));
    scene.scan({classified(object, said, probability)});
    if (i >= kMistakenConfirmedBy) {
      ASSERT_EQ(scene.tracks().tracks.size(), 1U) << nameOf(other) << " " << i;
    }
  }
  EXPECT_EQ(scene.tracks().tracks[0].id, 1U);
  EXPECT_EQ(scene.tracker().counts().confirmed_tracks, 1U);
}

TEST(FusedObjects, AClassThatFlipsDoesNotBreakTheTrack) {
  for (const ObjectClass other :
       {ObjectClass::kCyclist, ObjectClass::kVehicle, ObjectClass::kPole}) {
    walkMistaken(other, 0.6, 0.3);
    walkMistaken(other, 0.9, 0.3);
  }
}

TEST(FusedObjects, APermanentClassChangeIsAdopted) {
  TrackingScene scene;
  for (int i = 0; i < 60; ++i) {
    const ObjectClass said = i < 30 ? ObjectClass::kPedestrian : ObjectClass::kCyclist;
    scene.scan({classified(fusedAt(10.0 + 0.3 * i, 0.0), said, 0.9)});
    if (i >= kConfirmedBy) {
      ASSERT_EQ(scene.tracks().tracks.size(), 1U) << i;
    }
  }
  const Track& track = scene.tracks().tracks[0];
  EXPECT_EQ(track.id, 1U);
  EXPECT_GT(track.class_probabilities[static_cast<std::size_t>(ObjectClass::kCyclist)], 0.8);
}

TEST(FusedObjects, NeighborsOfDifferentClassesKeepTheirTracksWhereTheyPass) {
  TrackingScene scene;
  const auto walker = [&](double x) {
    const Object object = fusedAt(x + scene.noise(0.2), 0.5 + scene.noise(0.2));
    return classified(object, ObjectClass::kPedestrian, 0.8);
  };
  const auto cyclist = [&](double x) {
    const Object object = fusedAt(x + scene.noise(0.2), -0.5 + scene.noise(0.2));
    return classified(object, ObjectClass::kCyclist, 0.8);
  };
  for (int i = 0; i < 60; ++i) {
    scene.scan({walker(12.0 + 0.1 * kWalking * i), cyclist(8.0 + 0.3 * i)});
  }
  ASSERT_EQ(scene.tracks().tracks.size(), 2U);
  EXPECT_EQ(scene.tracker().counts().confirmed_tracks, 2U);
  for (const Track& track : scene.tracks().tracks) {
    const bool is_cyclist = track.state[2] > 2.0;
    const ObjectClass expected = is_cyclist ? ObjectClass::kCyclist : ObjectClass::kPedestrian;
    EXPECT_GT(track.class_probabilities[static_cast<std::size_t>(expected)], 0.8);
  }
}

}  // namespace
}  // namespace datmo::fused_objects_test
