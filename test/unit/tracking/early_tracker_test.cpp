// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/early_tracker.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <vector>

#include "random_scene.h"
#include <gtest/gtest.h>

namespace datmo::early_tracker_test {
namespace {

constexpr double kPeriod = 0.1;  // s

TrackerOptions with(TrackerAssociation association) {
  TrackerOptions options;
  options.require_motion = false;
  options.association = association;
  return options;
}

TrackerInput inputAt(int step, const std::vector<Object>& objects) {
  return {{Stamp::fromSeconds(100.0 + kPeriod * step), objects, {}},
          Pose2(),
          Visibility(VisibilityOptions())};
}

/// What comes at once of a scan's objects: those of every other place.
std::vector<Object> earlyOf(const std::vector<Object>& objects) {
  std::vector<Object> early;
  std::copy_if(objects.begin(), objects.end(), std::back_inserter(early),
               [](const Object& object) { return object.box.center.y() > 0.0; });
  return early;
}

void expectSame(const TrackList& a, const TrackList& b) {
  ASSERT_EQ(a.tracks.size(), b.tracks.size());
  for (std::size_t i = 0; i < a.tracks.size(); ++i) {
    EXPECT_EQ(a.tracks[i].id, b.tracks[i].id);
    EXPECT_EQ(a.tracks[i].state, b.tracks[i].state);
    EXPECT_EQ(a.tracks[i].covariance, b.tracks[i].covariance);
    EXPECT_EQ(a.tracks[i].existence_probability, b.tracks[i].existence_probability);
    EXPECT_EQ(a.tracks[i].history.size(), b.tracks[i].history.size());
  }
}

class EarlyTrackerTest : public testing::TestWithParam<TrackerAssociation> {
 protected:
  static constexpr int kSteps = 40;

  TrackerInput early(int step) const { return inputAt(step, earlyOf(scans_[index(step)])); }
  TrackerInput complete(int step) const { return inputAt(step, scans_[index(step)]); }

  static TrackList process(Tracker& tracker, const TrackerInput& input) {
    return tracker.process(input.objects, input.base_in_fixed, input.visibility);
  }

  /// Each scan's objects early, and complete as many scans later.
  void expectAsIfItHadWaited(int lag) {
    EarlyTracker tracker(with(GetParam()));
    Tracker waiting(with(GetParam()));
    std::size_t tracks = 0;
    for (int step = 0; step < kSteps; ++step) {
      tracker.processEarly(early(step));
      if (step >= lag) {
        const TrackList complete_tracks = tracker.process(complete(step - lag));
        expectSame(complete_tracks, process(waiting, complete(step - lag)));
        tracks += complete_tracks.tracks.size();
      }
    }
    EXPECT_EQ(tracker.waiting(), static_cast<std::size_t>(lag));
    EXPECT_GT(tracks, 50U);
    EXPECT_EQ(tracker.counts().confirmed_tracks, waiting.counts().confirmed_tracks);
  }

 private:
  static std::size_t index(int step) { return static_cast<std::size_t>(step); }

  static std::vector<std::vector<Object>> made() {
    RandomScene scene(3, {});
    std::vector<std::vector<Object>> scans(kSteps);
    std::generate(scans.begin(), scans.end(), [&scene] { return scene.next(); });
    return scans;
  }

  std::vector<std::vector<Object>> scans_ = made();
};

TEST_P(EarlyTrackerTest, WithCompleteListsItIsAsIfItHadWaitedForThem) {
  for (const int lag : {0, 1, 3}) {
    expectAsIfItHadWaited(lag);
  }
}

TEST_P(EarlyTrackerTest, TheNextEarlyListGoesOnFromTheCompleteOnes) {
  EarlyTracker tracker(with(GetParam()));
  Tracker waiting(with(GetParam()));
  for (int step = 0; step < kSteps; ++step) {
    Tracker ahead = waiting;
    if (step > 0) {
      process(ahead, early(step - 1));
    }
    expectSame(tracker.processEarly(early(step)), process(ahead, early(step)));
    if (step > 0) {
      tracker.process(complete(step - 1));
      process(waiting, complete(step - 1));
    }
  }
}

TEST_P(EarlyTrackerTest, WhatWaitsIsBounded) {
  EarlyTracker tracker(with(GetParam()));
  for (int step = 0; step < kSteps; ++step) {
    tracker.processEarly(early(step));
  }
  EXPECT_LT(tracker.waiting(), 30U);
  tracker.process(complete(kSteps - 1));
  EXPECT_EQ(tracker.waiting(), 0U);
  tracker.processEarly(inputAt(kSteps, {}));
  tracker.reset();
  EXPECT_EQ(tracker.waiting(), 0U);
  EXPECT_TRUE(tracker.processEarly(early(0)).tracks.empty());
}

INSTANTIATE_TEST_SUITE_P(Associations, EarlyTrackerTest,
                         testing::Values(TrackerAssociation::kGlobalNearestNeighbor,
                                         TrackerAssociation::kMultipleHypotheses));

}  // namespace
}  // namespace datmo::early_tracker_test
