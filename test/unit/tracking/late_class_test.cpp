// SPDX-License-Identifier: BSD-3-Clause
// Classes that a camera reports late, of two road users that pass each other closely: each counts
// for the track of its object, not for the one that is there when it arrives.
#include <cmath>
#include <optional>
#include <vector>

#include "tracking_scene.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/tracking/early_tracker.h"

namespace datmo::late_class_test {
namespace {

constexpr double kPeriod = 0.1;  // s
constexpr int kSteps = 30;
constexpr int kLag = 4;               // scans until the classes of a scan arrive
constexpr int kPassing = 10;          // scan at which they are beside each other
constexpr double kSpeed = 4.0;        // m/s; within the lag, each moves on by 1.6 m
constexpr double kDistance = 1.5;     // m, between their lines
constexpr double kProbability = 0.8;  // of the reported class

double cyclistAt(int step) { return kSpeed * kPeriod * (step - kPassing); }
double carAt(int step) { return -cyclistAt(step); }

TrackerInput inputAt(int step, bool with_classes) {
  std::vector<Object> objects = {objectAt(cyclistAt(step), 0.0), objectAt(carAt(step), kDistance)};
  if (with_classes) {
    objects[0].class_probabilities = reportedClass(ObjectClass::kCyclist, kProbability);
    objects[1].class_probabilities = reportedClass(ObjectClass::kVehicle, kProbability);
  }
  return {{Stamp::fromSeconds(100.0 + kPeriod * step), objects, {}},
          Pose2(),
          Visibility(VisibilityOptions())};
}

/// Returns the class of the track there; none if there is no track.
std::optional<ObjectClass> classAt(const TrackList& list, double x, double y) {
  constexpr double kNear = 0.5;  // m
  for (const Track& track : list.tracks) {
    if (std::hypot(track.state[0] - x, track.state[1] - y) < kNear) {
      return track.objectClass();
    }
  }
  return {};
}

class LateClassTest : public testing::TestWithParam<TrackerAssociation> {};

TEST_P(LateClassTest, EachReachesTheRightOneOfTwoThatPassEachOther) {
  TrackerOptions options;
  options.require_motion = false;
  options.association = GetParam();
  EarlyTracker tracker(options);
  int judged = 0;
  for (int step = 0; step < kSteps; ++step) {
    const TrackList tracks = tracker.processEarly(inputAt(step, false));
    // From the complete list of scan 3 on, both are confirmed and their classes known.
    if (step > 3 + kLag) {
      EXPECT_EQ(classAt(tracks, cyclistAt(step), 0.0), ObjectClass::kCyclist) << step;
      EXPECT_EQ(classAt(tracks, carAt(step), kDistance), ObjectClass::kVehicle) << step;
      ++judged;
    }
    if (step >= kLag) {
      tracker.process(inputAt(step - kLag, true));
    }
  }
  EXPECT_EQ(judged, kSteps - kLag - 4);
}

INSTANTIATE_TEST_SUITE_P(Associations, LateClassTest,
                         testing::Values(TrackerAssociation::kMultipleHypotheses,
                                         TrackerAssociation::kGlobalNearestNeighbor));

}  // namespace
}  // namespace datmo::late_class_test
