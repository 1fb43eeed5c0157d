// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/early_tracker.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
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

/// Returns the objects of a scan that are available at once: those at positive y.
std::vector<Object> earlyOf(const std::vector<Object>& objects) {
  std::vector<Object> early;
  std::copy_if(objects.begin(), objects.end(), std::back_inserter(early),
               [](const Object& object) { return object.box.center.y() > 0.0; });
  return early;
}

TrackList process(Tracker& tracker, const TrackerInput& input) {
  return tracker.process(input.objects, input.base_in_fixed, input.visibility);
}

std::vector<std::uint32_t> idsInOrder(const TrackList& list) {
  std::vector<std::uint32_t> ids;
  for (const Track& track : list.tracks) {
    ids.push_back(track.id);
  }
  return ids;
}

void sortByPlace(TrackList& list) {
  std::sort(list.tracks.begin(), list.tracks.end(),
            [](const Track& a, const Track& b) { return a.state[0] < b.state[0]; });
}

/// Equal bit for bit, except for the ids.
void expectSameButIds(TrackList a, TrackList b) {
  ASSERT_EQ(a.tracks.size(), b.tracks.size());
  sortByPlace(a);
  sortByPlace(b);
  for (std::size_t i = 0; i < a.tracks.size(); ++i) {
    EXPECT_EQ(a.tracks[i].state, b.tracks[i].state);
    EXPECT_EQ(a.tracks[i].covariance, b.tracks[i].covariance);
    EXPECT_EQ(a.tracks[i].existence_probability, b.tracks[i].existence_probability);
    EXPECT_EQ(a.tracks[i].history.size(), b.tracks[i].history.size());
  }
}

void expectSame(const TrackList& a, const TrackList& b) {
  EXPECT_EQ(idsInOrder(a), idsInOrder(b));
  expectSameButIds(a, b);
}

/// Ids of two trackers that have the same tracks: each id of one corresponds permanently to one of
/// the other.
class SameIds {
 public:
  void expect(TrackList a, TrackList b) {
    sortByPlace(a);
    sortByPlace(b);
    for (std::size_t i = 0; i < std::min(a.tracks.size(), b.tracks.size()); ++i) {
      const std::uint32_t id = a.tracks[i].id;
      const std::uint32_t other = b.tracks[i].id;
      EXPECT_EQ(others_.emplace(id, other).first->second, other);
      EXPECT_EQ(ids_.emplace(other, id).first->second, id);
    }
  }

 private:
  std::map<std::uint32_t, std::uint32_t> others_;
  std::map<std::uint32_t, std::uint32_t> ids_;
};

/// Returns the id of the track there; 0: none.
std::uint32_t idAt(const TrackList& list, double x) {
  for (const Track& track : list.tracks) {
    if (std::abs(track.state[0] - x) < 2.0) {
      return track.id;
    }
  }
  return 0;
}

class EarlyTrackerTest : public testing::TestWithParam<TrackerAssociation> {
 protected:
  static constexpr int kSteps = 40;

  TrackerInput early(int step) const { return inputAt(step, earlyOf(scans_[index(step)])); }
  TrackerInput complete(int step) const { return inputAt(step, scans_[index(step)]); }

  /// Each scan's objects early, and complete this many scans later.
  void expectAsIfItHadWaited(int lag) {
    EarlyTracker tracker(with(GetParam()));
    Tracker waiting(with(GetParam()));
    SameIds ids;
    std::size_t tracks = 0;
    for (int step = 0; step < kSteps; ++step) {
      tracker.processEarly(early(step));
      if (step >= lag) {
        const TrackList complete_tracks = tracker.process(complete(step - lag));
        const TrackList waiting_tracks = process(waiting, complete(step - lag));
        expectSameButIds(complete_tracks, waiting_tracks);
        ids.expect(complete_tracks, waiting_tracks);
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

TEST_P(EarlyTrackerTest, EqualsATrackerOfCompleteListsExceptForIds) {
  for (const int lag : {0, 1, 3}) {
    expectAsIfItHadWaited(lag);
  }
}

TEST_P(EarlyTrackerTest, TheNextEarlyListContinuesFromTheCompleteOnes) {
  EarlyTracker tracker(with(GetParam()));
  Tracker waiting(with(GetParam()));
  for (int step = 0; step < kSteps; ++step) {
    Tracker ahead = waiting.ahead();
    if (step > 0) {
      process(ahead, early(step - 1));
    }
    expectSame(tracker.processEarly(early(step)), process(ahead, early(step)));
    waiting.keepIds(ahead);
    if (step > 0) {
      tracker.process(complete(step - 1));
      process(waiting, complete(step - 1));
    }
  }
}

TEST_P(EarlyTrackerTest, TheQueueIsBounded) {
  EarlyTracker tracker(with(GetParam()));
  for (int step = 0; step < kSteps; ++step) {
    tracker.processEarly(early(step));
  }
  EXPECT_EQ(tracker.waiting(), 40U) << "no more than 0.8 s of a scanner at 50 Hz";
  for (int step = kSteps; step < 3 * kSteps; ++step) {
    tracker.processEarly(inputAt(step, {}));
  }
  EXPECT_LT(tracker.waiting(), 100U);
  tracker.process(inputAt(3 * kSteps, {}));
  EXPECT_EQ(tracker.waiting(), 0U);
  tracker.processEarly(inputAt(3 * kSteps + 1, {}));
  tracker.reset();
  EXPECT_EQ(tracker.waiting(), 0U);
  EXPECT_TRUE(tracker.processEarly(early(0)).tracks.empty());
}

// Both confirmed at once by the complete lists, which arrive two scans later; early only one is
// seen.
TEST_P(EarlyTrackerTest, AnEarlyPublishedTrackKeepsItsUniqueId) {
  for (const double first : {-10.0, 10.0}) {  // either may be the first of both
    const double second = -first;
    EarlyTracker tracker(with(GetParam()));
    std::uint32_t published = 0;
    for (int step = 0; step < 20; ++step) {
      const std::uint32_t now =
          idAt(tracker.processEarly(inputAt(step, {objectAt(first, 3.0)})), first);
      EXPECT_TRUE(published == 0 || now == published);
      published = now;
      if (step >= 2) {
        const TrackList both =
            tracker.process(inputAt(step - 2, {objectAt(first, 3.0), objectAt(second, 3.0)}));
        EXPECT_TRUE(both.tracks.empty() || idAt(both, first) == published);
        EXPECT_TRUE(both.tracks.empty() || idAt(both, second) != published);
      }
    }
    EXPECT_NE(published, 0U);
  }
}

TEST_P(EarlyTrackerTest, ObjectsOfEarlyListsAloneAreNotConfirmed) {
  EarlyTracker tracker(with(GetParam()));
  for (int step = 0; step < 20; ++step) {
    EXPECT_TRUE(tracker.processEarly(inputAt(step, {objectAt(5.0, 3.0)})).tracks.empty());
  }
}

TEST_P(EarlyTrackerTest, EarlyPublishedIdsAreNotReusedAfterAReset) {
  EarlyTracker tracker(with(GetParam()));
  tracker.process(inputAt(0, {objectAt(5.0, 3.0)}));
  const auto published = [&] {
    std::uint32_t id = 0;
    for (int step = 1; step < 10; ++step) {
      id = idAt(tracker.processEarly(inputAt(step, {objectAt(5.0, 3.0)})), 5.0);
    }
    return id;
  };
  const std::uint32_t before = published();
  ASSERT_NE(before, 0U);
  tracker.reset();
  tracker.process(inputAt(0, {objectAt(5.0, 3.0)}));
  EXPECT_GT(published(), before);
}

TEST(EarlyTracker, SearchesCutShortByEarlyListsAreCounted) {
  double now = 0.0;
  EarlyTracker tracker(with(TrackerAssociation::kMultipleHypotheses),
                       [&now] { return now += 1.0; });
  tracker.process(inputAt(0, {objectAt(5.0, 3.0)}));
  const std::uint64_t before = tracker.counts().association.best_only_steps;
  tracker.processEarly(inputAt(1, {objectAt(5.0, 3.0)}));
  EXPECT_EQ(tracker.counts().association.best_only_steps, before + 1);
  EXPECT_EQ(tracker.counts().intake.accepted, 2U);
  tracker.reset();
  EXPECT_EQ(tracker.counts().association.best_only_steps, 0U);
}

INSTANTIATE_TEST_SUITE_P(Associations, EarlyTrackerTest,
                         testing::Values(TrackerAssociation::kGlobalNearestNeighbor,
                                         TrackerAssociation::kMultipleHypotheses));

}  // namespace
}  // namespace datmo::early_tracker_test
