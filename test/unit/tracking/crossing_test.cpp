// SPDX-License-Identifier: BSD-3-Clause
// The benefit of later scans: targets that cross at a small angle, missed at times, among false
// objects.
#include <cstdint>

#include "tracking_scene.h"
#include <gtest/gtest.h>

namespace datmo::crossing_test {
namespace {

constexpr double kSeconds = 4.0;  // they meet halfway
constexpr int kScans = 40;

/// One moves from the right to the left of the other, both ahead.
Point2 positionOf(int target, double seconds) {
  const double side = target == 0 ? 1.0 : -1.0;
  return {4.0 * seconds, side * (2.5 - 5.0 * seconds / kSeconds)};
}

/// Id of the track nearest to a point, within 1 m; 0: none.
std::uint32_t idAt(const TrackList& list, const Point2& position) {
  double nearest = 1.0;
  std::uint32_t id = 0;
  for (const Track& track : list.tracks) {
    const double distance = (track.state.head<2>() - position).norm();
    if (distance < nearest) {
      nearest = distance;
      id = track.id;
    }
  }
  return id;
}

/// Returns how many of the two have the same id after the crossing as before it.
int idsKept(const TrackerOptions& options, std::uint64_t seed) {
  TrackingScene scene(options);
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> noise(0.0, 0.25);
  std::uniform_real_distribution<double> luck(0.0, 1.0);
  std::uint32_t before[2] = {0, 0};
  int kept = 0;
  for (int i = 0; i < kScans; ++i) {
    const double seconds = i * kSeconds / kScans;
    std::vector<Object> objects;
    for (const int target : {0, 1}) {
      const Point2 position = positionOf(target, seconds);
      const double dx = noise(engine);
      const double dy = noise(engine);
      if (luck(engine) < 0.85) {
        objects.push_back(objectAt(position.x() + dx, position.y() + dy));
      }
      if (luck(engine) < 0.15) {
        objects.push_back(objectAt(position.x() + 8.0 * dy, position.y() + 8.0 * dx));
      }
    }
    scene.scan(objects);
    for (const int target : {0, 1}) {
      const std::uint32_t id = idAt(scene.tracks(), positionOf(target, seconds));
      if (i == 12) {
        before[target] = id;
      } else if (i == kScans - 1) {
        kept += id != 0 && id == before[target] ? 1 : 0;
      }
    }
  }
  return kept;
}

int idsKeptOver(const TrackerOptions& options, std::uint64_t seeds) {
  int kept = 0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    kept += idsKept(options, seed);
  }
  return kept;
}

TEST(Crossing, SeveralHypothesesKeepMoreIdsThanTheNearestNeighbor) {
  TrackerOptions options;
  options.require_motion = false;
  options.duplicates.reach = 0.0;  // only the association decides
  const int several = idsKeptOver(options, 100);
  options.association = TrackerAssociation::kGlobalNearestNeighbor;
  const int nearest = idsKeptOver(options, 100);
  RecordProperty("several", several);
  RecordProperty("nearest", nearest);
  EXPECT_GE(several, nearest + 5) << "of 200, nearest neighbor: " << nearest;
  EXPECT_GE(several, 180);
}

}  // namespace
}  // namespace datmo::crossing_test
