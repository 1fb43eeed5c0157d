// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/split_merge.h"

#include <cmath>
#include <limits>
#include <set>

#include "tracking_scene.h"
#include <gtest/gtest.h>

namespace datmo::split_merge_test {
namespace {

/// A box along x with points on its outline.
Object segment(double x, double y, double length, double width) {
  Object object = objectAt(x, y);
  object.box.length = length;
  object.box.width = width;
  object.position_covariance = Eigen::Matrix2d::Identity() * 0.01;
  for (int i = 0; i <= 10; ++i) {
    const double along = (0.1 * i - 0.5) * length;
    object.points.emplace_back(x + along, y - 0.5 * width);
    object.points.emplace_back(x + along, y + 0.5 * width);
  }
  return object;
}

constexpr double kVanLength = 5.0;  // m
constexpr double kVanSpeed = 5.0;   // m/s

double vanAt(const TrackingScene& scene) { return kVanSpeed * (scene.nextTime() - 100.0); }

Object van(double x) { return segment(x, 0.0, kVanLength, 2.0); }

/// Its ends; the part in between is not visible.
std::vector<Object> endsOfVan(double x) {
  return {segment(x - 1.6, 0.0, 1.8, 2.0), segment(x + 1.6, 0.0, 1.8, 2.0)};
}

/// Whole for 2 s, then in two parts.
void splitVan(TrackingScene& scene, int scans_in_parts) {
  for (int i = 0; i < 20; ++i) {
    scene.scan({van(vanAt(scene))});
  }
  for (int i = 0; i < scans_in_parts; ++i) {
    scene.scan(endsOfVan(vanAt(scene)));
  }
}

TEST(SplitMerge, AVanSeenAsTwoSegmentsStaysOneTrack) {
  TrackingScene scene;
  splitVan(scene, 30);
  const double truth = vanAt(scene) - 0.1 * kVanSpeed;
  ASSERT_EQ(idsOf(scene.tracks()), std::set<std::uint32_t>{1});
  EXPECT_EQ(scene.tracker().counts().confirmed_tracks, 1U);
  const Track& track = scene.tracks().tracks.front();
  EXPECT_EQ(track.objects, (std::vector<std::size_t>{0, 1}));
  EXPECT_NEAR(track.state[0], truth, 0.3);
  EXPECT_NEAR(track.state[1], 0.0, 0.1);
  EXPECT_NEAR(track.state[2], kVanSpeed, 0.3);
  EXPECT_NEAR(track.box.length, kVanLength, 0.3);
  EXPECT_NEAR(track.box.width, 2.0, 0.3);
}

TEST(SplitMerge, WholeAgainItIsTheSameTrack) {
  TrackingScene scene;
  splitVan(scene, 5);
  for (int i = 0; i < 10; ++i) {
    scene.scan({van(vanAt(scene))});
    EXPECT_EQ(idsOf(scene.tracks()), std::set<std::uint32_t>{1});
  }
  EXPECT_EQ(scene.tracks().tracks.front().objects, std::vector<std::size_t>{0});
}

TEST(SplitMerge, WithoutSplitsAPartIsTakenForTheWhole) {
  TrackerOptions options;
  options.split_merge.split_probability = 0.0;
  TrackingScene scene(options);
  splitVan(scene, 3);
  ASSERT_FALSE(scene.tracks().tracks.empty());
  EXPECT_LT(scene.tracks().tracks.front().objects.size(), 2U);
}

TEST(SplitMerge, AUnionHasNoNewInformationOnTheHeading) {
  // The union has the heading that the target already has.
  TrackingScene scene;
  splitVan(scene, 20);
  TrackerOptions options;
  options.split_merge.split_probability = 0.0;
  ASSERT_EQ(scene.tracks().tracks.size(), 1U);
  EXPECT_NEAR(scene.tracks().tracks.front().box.center.heading(), 0.0, 0.02);
}

TEST(SplitMerge, AnUnconfirmedTargetClaimsNoParts) {
  TrackingScene scene;
  scene.scan({van(10.0)});
  scene.scan(endsOfVan(10.5));
  EXPECT_TRUE(scene.tracks().tracks.empty());
  EXPECT_EQ(scene.tracker().counts().confirmed_tracks, 0U);
}

constexpr double kApart = 1.2;  // m, between two pedestrians

Object pedestrian(double x, double y) { return segment(x, y, 0.5, 0.5); }

/// Side by side for 3 s; then seen as one; then separate again.
std::vector<Object> twoPedestrians(double x, bool as_one) {
  if (as_one) {
    Object both = segment(x, 0.5 * kApart, 0.5, kApart + 0.5);
    return {both};
  }
  return {pedestrian(x, 0.0), pedestrian(x, kApart)};
}

TEST(SplitMerge, TwoPedestriansSeenAsOneSegmentKeepTheirIds) {
  TrackingScene scene;
  const auto x = [&scene] { return 1.4 * (scene.nextTime() - 100.0); };
  for (int i = 0; i < 30; ++i) {
    scene.scan(twoPedestrians(x(), false));
  }
  ASSERT_EQ(idsOf(scene.tracks()), (std::set<std::uint32_t>{1, 2}));
  const double left_before = scene.tracks().tracks[1].state[1];
  for (int i = 0; i < 15; ++i) {
    scene.scan(twoPedestrians(x(), true));
    ASSERT_EQ(idsOf(scene.tracks()), (std::set<std::uint32_t>{1, 2})) << "scan " << i;
    for (const Track& track : scene.tracks().tracks) {
      EXPECT_EQ(track.objects, std::vector<std::size_t>{0}) << "both are the one object";
      EXPECT_EQ(track.since_update, 0.0);
    }
  }
  for (int i = 0; i < 10; ++i) {
    scene.scan(twoPedestrians(x(), false));
  }
  ASSERT_EQ(idsOf(scene.tracks()), (std::set<std::uint32_t>{1, 2}));
  EXPECT_EQ(scene.tracker().counts().confirmed_tracks, 2U);
  EXPECT_NEAR(scene.tracks().tracks[1].state[1], left_before, 0.2) << "each on its side";
}

TEST(SplitMerge, WithoutMergesOneOfThemCoasts) {
  TrackerOptions options;
  options.split_merge.merge_probability = 0.0;
  TrackingScene scene(options);
  const auto x = [&scene] { return 1.4 * (scene.nextTime() - 100.0); };
  for (int i = 0; i < 35; ++i) {
    scene.scan(twoPedestrians(x(), i >= 30));
  }
  std::size_t seen = 0;
  for (const Track& track : scene.tracks().tracks) {
    seen += track.objects.size();
  }
  EXPECT_LE(seen, 1U);
}

TEST(SplitMerge, ReadingsAreBounded) {
  TrackerOptions options;
  options.split_merge.max_interpretations = 1;
  TrackingScene scene(options);
  splitVan(scene, 3);
  ASSERT_FALSE(scene.tracks().tracks.empty());
  EXPECT_LT(scene.tracks().tracks.front().objects.size(), 2U);
}

}  // namespace
}  // namespace datmo::split_merge_test
