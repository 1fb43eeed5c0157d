// SPDX-License-Identifier: BSD-3-Clause
// Three trackers of one object: the output does not depend on which is named first.
#include <algorithm>
#include <string>
#include <vector>

#include "fusion_tracks.h"
#include "track_sources.h"
#include <gtest/gtest.h>

#include "datmo_fusion/fusion/track/track_fuser.h"
#include "datmo_fusion/tracking/track_check.h"

namespace datmo::three_sources_test {
namespace {

using Names = std::vector<std::string>;  ///< of the sources, in the order of the tracks

TrackFuserOptions withThree(TrackCombinationMethod method) {
  TrackFuserOptions options;
  options.scheme = TrackScheme::kUnion;
  options.sources["radar"].class_by_speed = true;  // like the others
  options.combination.method = method;
  return options;
}

/// Three tracks of one car, each more certain about something else; they are equal except for the
/// speed of the last one.
std::vector<Track> tracksAt(double seconds, const Names& names, double last_speed) {
  std::vector<Track> tracks = {driving(-20.0, seconds, names[0], 1),
                               driving(-19.6, seconds, names[1], 1),
                               driving(-20.2, seconds, names[2], 1)};
  tracks[0].covariance.topLeftCorner<2, 2>() << 0.30, 0.02, 0.02, 0.05;
  tracks[0].box.length = 3.8;
  tracks[1].covariance.topLeftCorner<2, 2>() << 0.08, -0.03, -0.03, 0.20;
  tracks[1].yaw_rate = 0.1;
  tracks[1].heading_variance = 0.03;
  tracks[2].covariance.block<2, 2>(2, 2) *= 0.1;
  tracks[2].state[2] = last_speed;
  tracks[2].state[1] = 0.3;
  return tracks;
}

/// One for 2 s; then the speed of the last one is reported as `last_speed`. The lists arrive in the
/// order `order`.
Track afterTwoSeconds(const TrackFuserOptions& options, const Names& names,
                      const std::vector<std::size_t>& order, double last_speed) {
  TrackFuser fuser(options);
  TrackFusionResult result;
  for (int i = 0; i <= 20; ++i) {
    const double t = 0.1 * i;
    const std::vector<Track> tracks = tracksAt(t, names, i == 20 ? last_speed : 5.0);
    std::vector<SourceTracks> lists;
    for (const std::size_t source : order) {
      lists.push_back(received(names[source], t, {tracks[source]}, {allAround(80.0)}));
    }
    result = fuser.fuse(at(t), lists);
  }
  EXPECT_EQ(result.list.tracks.size(), 1U);
  EXPECT_EQ(result.list.tracks.at(0).sources.size(), 3U);
  EXPECT_TRUE(isValid(result.list.tracks.at(0)));
  return result.list.tracks.at(0);
}

void expectSame(const Track& expected, const Track& actual) {
  EXPECT_TRUE(actual.state.isApprox(expected.state, 1e-9));
  EXPECT_TRUE(actual.covariance.isApprox(expected.covariance, 1e-9));
  EXPECT_NEAR(actual.box.center.heading(), expected.box.center.heading(), 1e-9);
  EXPECT_NEAR(actual.box.length, expected.box.length, 1e-9);
  EXPECT_NEAR(actual.yaw_rate, expected.yaw_rate, 1e-9);
  EXPECT_NEAR(actual.existence_probability, expected.existence_probability, 1e-9);
}

class ThreeSourcesTest : public ::testing::TestWithParam<TrackCombinationMethod> {
 protected:
  TrackFuserOptions options_ = withThree(GetParam());
};

TEST_P(ThreeSourcesTest, FusionDoesNotDependOnTheirOrderNorTheirNames) {
  for (const double last_speed : {5.0, 0.0}) {  // it agrees with the others, and contradicts them
    const Track expected =
        afterTwoSeconds(options_, {"lidar", "radar", "stereo"}, {0, 1, 2}, last_speed);
    Names names = {"lidar", "radar", "stereo"};
    do {
      std::vector<std::size_t> order = {0, 1, 2};
      do {
        SCOPED_TRACE(names[order[0]] + " " + names[order[1]] + " " + names[order[2]]);
        expectSame(expected, afterTwoSeconds(options_, names, order, last_speed));
      } while (std::next_permutation(order.begin(), order.end()));
    } while (std::next_permutation(names.begin(), names.end()));
  }
}

TEST_P(ThreeSourcesTest, WhereOneContradictsTheOthersEachIsAsLikely) {
  const Track together = afterTwoSeconds(options_, {"lidar", "radar", "stereo"}, {0, 1, 2}, 0.0);
  EXPECT_NEAR(together.state[2], 10.0 / 3.0, 1e-6);
  // (5 - 10/3)^2 twice and (10/3)^2, over three, and the mean of 0.25, 0.25 and 0.025.
  EXPECT_NEAR(together.covariance(2, 2), 50.0 / 9.0 + 0.175, 1e-6);
}

TEST_P(ThreeSourcesTest, ThreeAreNoLessCertainThanTwo) {
  const Track three = afterTwoSeconds(options_, {"lidar", "radar", "stereo"}, {0, 1, 2}, 5.0);
  TrackFuser fuser(options_);
  Track two;
  for (int i = 0; i <= 20; ++i) {
    const double t = 0.1 * i;
    const std::vector<Track> tracks = tracksAt(t, {"lidar", "radar", "stereo"}, 5.0);
    const auto result = fuser.fuse(at(t), {received("lidar", t, {tracks[0]}, {allAround(80.0)}),
                                           received("radar", t, {tracks[1]}, {allAround(80.0)})});
    ASSERT_EQ(result.list.tracks.size(), 1U);
    two = result.list.tracks[0];
  }
  EXPECT_LT(three.covariance.determinant(), two.covariance.determinant());
}

INSTANTIATE_TEST_SUITE_P(Methods, ThreeSourcesTest,
                         ::testing::Values(TrackCombinationMethod::kCovarianceIntersection,
                                           TrackCombinationMethod::kBarShalomCampo,
                                           TrackCombinationMethod::kInformation));

}  // namespace
}  // namespace datmo::three_sources_test
