// SPDX-License-Identifier: BSD-3-Clause
// The same input gives the same output, in whatever order the objects are listed.
#include <algorithm>
#include <cstdint>

#include "random_scene.h"
#include <gtest/gtest.h>

namespace datmo::determinism_test {
namespace {

RandomSceneOptions ambiguous() {
  RandomSceneOptions options;
  options.targets = 10;
  options.range = 8.0;
  options.max_clutter = 10;
  return options;
}

TrackerOptions everything() {
  TrackerOptions options;
  options.require_motion = false;
  return options;
}

void expectSame(const TrackList& a, const TrackList& b) {
  ASSERT_EQ(a.tracks.size(), b.tracks.size());
  for (std::size_t i = 0; i < a.tracks.size(); ++i) {
    EXPECT_EQ(a.tracks[i].id, b.tracks[i].id);
    EXPECT_EQ(a.tracks[i].state, b.tracks[i].state);
    EXPECT_EQ(a.tracks[i].covariance, b.tracks[i].covariance);
    EXPECT_EQ(a.tracks[i].existence_probability, b.tracks[i].existence_probability);
  }
}

TEST(Determinism, TheSameInputTwice) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    TrackingScene first(everything());
    TrackingScene second(everything());
    RandomScene scene(seed, ambiguous());
    for (int i = 0; i < 30; ++i) {
      const std::vector<Object> objects = scene.next();
      expectSame(first.scan(objects), second.scan(objects));
    }
    EXPECT_EQ(first.tracker().counts().association.cut_hypotheses,
              second.tracker().counts().association.cut_hypotheses);
    EXPECT_FALSE(first.tracks().tracks.empty());
  }
}

TEST(Determinism, InWhateverOrder) {
  std::mt19937_64 engine(7);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    TrackingScene first(everything());
    TrackingScene second(everything());
    RandomScene scene(seed, ambiguous());
    for (int i = 0; i < 30; ++i) {
      std::vector<Object> objects = scene.next();
      first.scan(objects);
      std::shuffle(objects.begin(), objects.end(), engine);
      expectSame(first.tracks(), second.scan(objects));
    }
  }
}

TEST(Determinism, AClockThatIsNeverLateChangesNothing) {
  TrackingScene first(everything());
  TrackingScene second(everything(), 0.1, [] { return 5.0; });
  RandomScene scene(3, ambiguous());
  for (int i = 0; i < 30; ++i) {
    const std::vector<Object> objects = scene.next();
    expectSame(first.scan(objects), second.scan(objects));
  }
  EXPECT_EQ(second.tracker().counts().association.best_only_steps, 0U);
}

TEST(Determinism, AClockThatIsAlwaysLateIsCountedAndTracksNonetheless) {
  double now = 0.0;
  TrackingScene scene(TrackerOptions(), 0.1, [&now] { return now += 1.0; });
  for (int i = 0; i < 30; ++i) {
    const double x = 5.0 * (scene.nextTime() - 100.0);
    scene.scan({objectAt(x + scene.noise(0.1), 0.0), objectAt(10.0 + scene.noise(0.1), 8.0)});
  }
  ASSERT_EQ(scene.tracks().tracks.size(), 1U);
  EXPECT_NEAR(scene.tracks().tracks[0].state[2], 5.0, 0.6);
  EXPECT_EQ(scene.tracker().counts().association.best_only_steps, 29U) << "but the first scan";
}

}  // namespace
}  // namespace datmo::determinism_test
