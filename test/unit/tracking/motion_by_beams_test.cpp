// SPDX-License-Identifier: BSD-3-Clause
// Simulated scans through detector and tracker: how soon a moving object is a track, and that no
// stationary object is.

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "ray_cast.h"
#include <gtest/gtest.h>

#include "datmo_fusion/detection/moving_object_detector.h"
#include "datmo_fusion/tracking/tracker.h"

namespace datmo::motion_by_beams_test {
namespace {

constexpr double kPeriod = 0.06;  // s
constexpr double kRangeSigma = 0.2;
constexpr int kSeeds = 11;
constexpr int kStandingSeeds = 33;  ///< a false track lasts for many scans

/// A scanner of 81 beams, 2 degrees apart, on a vehicle that drives along x.
class BeamScene {
 public:
  BeamScene(double speed, std::uint64_t seed) : speed_(speed), random_(seed) {}

  /// Returns the tracks after a scan of these boxes (map frame), which are not in the map; all are
  /// where the odds of motion are these.
  TrackList scan(const std::vector<Box2>& boxes, double motion_log_odds = 0.0) {
    time_ += kPeriod;
    const Pose2 base_in_map(speed_ * time_, 0.0, 0.0);
    std::vector<Box2> in_base;
    for (const Box2& box : boxes) {
      in_base.push_back({base_in_map.inverse() * box.center, box.length, box.width});
    }
    LabeledScan scan = scanner_.scan(in_base, random_);
    scan.stamp = Stamp::fromSeconds(100.0 + time_);
    scan.base_in_map.pose = base_in_map;
    for (ScanPoint& point : scan.points) {
      point.state = PointState::kUnknown;
    }
    tracker_.addScan(scan);
    ObjectList objects = detector_.detect(scan);
    for (Object& object : objects.objects) {
      object.motion_log_odds = motion_log_odds;
    }
    return tracker_.process(objects, base_in_map, Visibility(scan, visibility_));
  }

  double time() const { return time_; }

 private:
  static MovingObjectDetectorOptions detectorOptions() {
    MovingObjectDetectorOptions options;
    options.range_sigma = kRangeSigma;
    return options;
  }

  double speed_;
  Random random_;
  double time_ = 0.0;
  VisibilityOptions visibility_;
  RayCaster scanner_{degrees(160.0), degrees(2.0), kRangeSigma};
  MovingObjectDetector detector_{detectorOptions()};
  Tracker tracker_{TrackerOptions{}};
};

/// Returns the median time over seeds, s, until a box of this size that starts at `start` with this
/// velocity along y is a track; the vehicle is stationary in front of a wall. After 5 s: never.
double medianDelay(double length, double width, double speed, double motion_log_odds = 0.0) {
  std::vector<double> delays;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    BeamScene scene(0.0, static_cast<std::uint64_t>(seed));
    const Box2 wall{Pose2(40.0, 0.0, 0.0), 1.0, 60.0};
    for (int i = 0; i < 20; ++i) {
      scene.scan({wall});
    }
    const double start = scene.time();
    double delay = 5.0;
    while (scene.time() - start < 5.0) {
      const double y = -10.0 + speed * (scene.time() - start);
      const Box2 mover{Pose2(15.0, y, kQuarterTurn), length, width};
      if (!scene.scan({wall, mover}, motion_log_odds).tracks.empty()) {
        delay = scene.time() - start;
        break;
      }
    }
    delays.push_back(delay);
  }
  std::sort(delays.begin(), delays.end());
  return delays[kSeeds / 2];
}

TEST(MotionByBeams, ACarIsATrackWithinHalfASecond) { EXPECT_LE(medianDelay(4.4, 1.8, 8.0), 0.5); }

TEST(MotionByBeams, ACarBeyondABorderIsATrackHardlyLater) {
  const double on_the_road = medianDelay(4.4, 1.8, 8.0);
  const double beyond = medianDelay(4.4, 1.8, 8.0, -3.0);
  EXPECT_GE(beyond, on_the_road);
  EXPECT_LE(beyond, on_the_road + 3.0 * kPeriod);
}

TEST(MotionByBeams, AWalkerIsATrackWithinTwoSeconds) { EXPECT_LE(medianDelay(0.6, 0.6, 1.4), 2.0); }

TEST(MotionByBeams, StationaryObjectsAreNoTracksForAStationaryVehicle) {
  EXPECT_EQ(medianDelay(4.4, 1.8, 0.0), 5.0);
}

/// Returns how many of the scans of a 10 s drive past stationary objects publish a moving track,
/// over all seeds.
int falseScans(const std::vector<Box2>& boxes) {
  int scans = 0;
  for (int seed = 1; seed <= kStandingSeeds; ++seed) {
    BeamScene scene(8.0, static_cast<std::uint64_t>(seed));
    while (scene.time() < 10.0) {
      const TrackList list = scene.scan(boxes);
      scans += std::any_of(list.tracks.begin(), list.tracks.end(),
                           [](const Track& track) { return track.moving; })
                   ? 1
                   : 0;
    }
  }
  return scans;
}

TEST(MotionByBeams, ARowOfParkedCarsIsRarelyTakenForTraffic) {
  std::vector<Box2> row;
  for (int i = 0; i < 16; ++i) {
    row.push_back({Pose2(10.0 + 7.0 * i, 5.0, 0.0), 4.4, 1.8});
  }
  EXPECT_LE(falseScans(row), 0.02 * kStandingSeeds * 10.0 / kPeriod);
}

TEST(MotionByBeams, HousesWithYardsAreRarelyTakenForTraffic) {
  std::vector<Box2> houses;
  for (int i = 0; i < 5; ++i) {
    houses.push_back({Pose2(10.0 + 24.0 * i, -14.0, 0.0), 18.0, 10.0});
  }
  EXPECT_LE(falseScans(houses), 0.02 * kStandingSeeds * 10.0 / kPeriod);
}

}  // namespace
}  // namespace datmo::motion_by_beams_test
