// SPDX-License-Identifier: BSD-3-Clause
// With one hypothesis, no scan history, and neither split nor merged objects, multiple-hypothesis
// tracking is the global nearest neighbor.
#include <cstdint>

#include "random_scene.h"
#include <gtest/gtest.h>

namespace datmo::gnn_equality_test {
namespace {

TrackerOptions nearestNeighbor() {
  TrackerOptions options;
  options.association = TrackerAssociation::kGlobalNearestNeighbor;
  options.require_motion = false;  // more tracks
  return options;
}

TrackerOptions singleHypothesis() {
  TrackerOptions options = nearestNeighbor();
  options.association = TrackerAssociation::kMultipleHypotheses;
  options.hypotheses.max_hypotheses = 1;
  options.hypotheses.scan_history = 0;
  options.split_merge.split_probability = 0.0;
  options.split_merge.merge_probability = 0.0;
  return options;
}

void expectSame(const Track& a, const Track& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.state, b.state);
  EXPECT_EQ(a.covariance, b.covariance);
  EXPECT_EQ(a.mode_probabilities, b.mode_probabilities);
  EXPECT_EQ(a.box.center.heading(), b.box.center.heading());
  EXPECT_EQ(a.box.length, b.box.length);
  EXPECT_EQ(a.existence_probability, b.existence_probability);
  EXPECT_EQ(a.since_update, b.since_update);
  EXPECT_EQ(a.age, b.age);
  EXPECT_EQ(a.hits, b.hits);
  EXPECT_EQ(a.objects, b.objects);
  EXPECT_EQ(a.history.size(), b.history.size());
}

/// Returns how many tracks were compared.
std::size_t compare(const RandomSceneOptions& scene_options, std::uint64_t seed,
                    const TrackerOptions& one, const TrackerOptions& other) {
  TrackingScene first(one);
  TrackingScene second(other);
  RandomScene scene(seed, scene_options);
  std::size_t compared = 0;
  for (int scan = 0; scan < 30; ++scan) {
    const std::vector<Object> objects = scene.next();
    first.scan(objects);
    second.scan(objects);
    EXPECT_EQ(first.tracks().tracks.size(), second.tracks().tracks.size());
    if (first.tracks().tracks.size() != second.tracks().tracks.size()) {
      return compared;
    }
    for (std::size_t i = 0; i < first.tracks().tracks.size(); ++i) {
      expectSame(first.tracks().tracks[i], second.tracks().tracks[i]);
      ++compared;
    }
  }
  EXPECT_EQ(first.tracker().counts().confirmed_tracks, second.tracker().counts().confirmed_tracks);
  EXPECT_EQ(first.tracker().counts().merged_tracks, second.tracker().counts().merged_tracks);
  return compared;
}

TEST(GnnEquality, SparseScenes) {
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < 200 && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    compared += compare(RandomSceneOptions(), seed, nearestNeighbor(), singleHypothesis());
  }
  EXPECT_GT(compared, 10000U);
}

TEST(GnnEquality, CrowdedScenes) {
  RandomSceneOptions crowd;
  crowd.targets = 12;
  crowd.range = 6.0;
  crowd.max_clutter = 12;
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < 100 && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    compared += compare(crowd, seed, nearestNeighbor(), singleHypothesis());
  }
  EXPECT_GT(compared, 10000U);
}

TEST(GnnEquality, MoreHypothesesAreNotTheSame) {
  RandomSceneOptions crowd;
  crowd.range = 6.0;
  TrackerOptions several = nearestNeighbor();
  several.association = TrackerAssociation::kMultipleHypotheses;
  int different = 0;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    TrackingScene first(nearestNeighbor());
    TrackingScene second(several);
    RandomScene scene(seed, crowd);
    for (int scan = 0; scan < 30; ++scan) {
      const std::vector<Object> objects = scene.next();
      const TrackList& a = first.scan(objects);
      const TrackList& b = second.scan(objects);
      different += a.tracks.size() != b.tracks.size() ||
                           (!a.tracks.empty() && a.tracks[0].state != b.tracks[0].state)
                       ? 1
                       : 0;
    }
  }
  EXPECT_GT(different, 0);
}

}  // namespace
}  // namespace datmo::gnn_equality_test
