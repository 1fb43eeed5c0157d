// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/track/track_prediction.h"

#include <cmath>

#include "fusion_tracks.h"
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace datmo::track_prediction_test {
namespace {

const TrackPredictionOptions kOptions;

void ofClass(Track& track, ObjectClass object_class) {
  track.class_probabilities.fill(0.05);
  track.class_probabilities[static_cast<std::size_t>(object_class)] = 0.8;
}

TEST(TrackPredictionTest, NothingChangesInNoTime) {
  const Track track = carTrack(10.0, 2.0, 5.0, 1.0);
  const Track same = predicted(track, 0.0, kOptions);
  EXPECT_EQ(same.state, track.state);
  EXPECT_EQ(same.covariance, track.covariance);
  EXPECT_EQ(same.heading_variance, track.heading_variance);
}

TEST(TrackPredictionTest, GoesStraightWithoutAYawRate) {
  const Track track = carTrack(10.0, 2.0, 5.0, -1.0);
  const Track ahead = predicted(track, 0.4, kOptions);
  EXPECT_NEAR(ahead.state[0], 12.0, 1e-9);
  EXPECT_NEAR(ahead.state[1], 1.6, 1e-9);
  EXPECT_NEAR(ahead.state[2], 5.0, 1e-9);
  EXPECT_NEAR(ahead.box.center.heading(), track.box.center.heading(), 1e-9);
  // Variance of the position, of the velocity for 0.4 s, and of white acceleration (t^3 / 3).
  const double density = kOptions.motion.acceleration_density;
  EXPECT_NEAR(ahead.covariance(0, 0), 0.04 + 0.16 * 0.25 + density * 0.064 / 3.0, 1e-9);
  EXPECT_NEAR(ahead.covariance(2, 2), 0.25 + 0.4 * density, 1e-9);
}

TEST(TrackPredictionTest, TurnsAtItsYawRate) {
  // A quarter of a circle of 10 m about (0, 10).
  Track track = carTrack(0.0, 0.0, 5.0, 0.0);
  track.yaw_rate = 0.5;
  const double seconds = kQuarterTurn / track.yaw_rate;
  const Track turned = predicted(track, seconds, kOptions);
  EXPECT_NEAR(turned.state[0], 10.0, 1e-9);
  EXPECT_NEAR(turned.state[1], 10.0, 1e-9);
  EXPECT_NEAR(turned.state[3], 5.0, 1e-9);
  EXPECT_NEAR(turned.box.center.heading(), kQuarterTurn, 1e-9);
  EXPECT_NEAR((turned.box.center.position() - turned.state.head<2>()).norm(), 0.0, 1e-12);
}

TEST(TrackPredictionTest, ForthAndBackIsTheSamePositionButLessCertain) {
  Track track = carTrack(3.0, 4.0, 5.0, -2.0);
  track.yaw_rate = -0.4;
  track.state.tail<2>() << -0.8, -2.0;  // the centripetal one
  const Track before = predicted(track, -0.5, kOptions);
  const Track back = predicted(before, 0.5, kOptions);
  EXPECT_GT((before.state - track.state).norm(), 1.0);
  EXPECT_NEAR((back.state - track.state).norm(), 0.0, 1e-9);
  EXPECT_NEAR(back.box.center.heading(), track.box.center.heading(), 1e-9);
  EXPECT_NEAR(back.age, track.age, 1e-9);
  for (int i = 0; i < 4; ++i) {
    EXPECT_GT(back.covariance(i, i), track.covariance(i, i));
  }
}

TEST(TrackPredictionTest, TheProcessNoiseIsThatOfTheTimeToEitherSide) {
  Track track = carTrack(0.0, 0.0, 5.0, 0.0);
  track.yaw_rate = 0.3;
  const LinearMotion ahead = motionOf(track, 0.4, kOptions);
  const LinearMotion back = motionOf(track, -0.4, kOptions);
  EXPECT_NEAR(ahead.noise(0, 0), back.noise(0, 0), 1e-12);
  EXPECT_NEAR(ahead.noise(0, 2), -back.noise(0, 2), 1e-12);
  // If it accelerates, it was farther behind: past position and velocity are negatively correlated.
  EXPECT_LT(back.noise(0, 2), 0.0);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<TrackCovariance>(back.noise).eigenvalues().minCoeff(),
            0.0);
}

TEST(TrackPredictionTest, StationaryObjectsStayAndMayStart) {
  Track track = carTrack(3.0, 4.0, 0.2, 0.1);
  track.moving = false;
  track.yaw_rate = 0.4;
  for (const double seconds : {0.5, -0.5}) {
    const Track later = predicted(track, seconds, kOptions);
    EXPECT_EQ(later.state.head<2>(), track.state.head<2>());
    EXPECT_EQ(later.box.center.heading(), track.box.center.heading());
    EXPECT_GT(later.covariance(0, 0), track.covariance(0, 0));
    EXPECT_GT(later.covariance(2, 2), track.covariance(2, 2));
  }
}

TEST(TrackPredictionTest, MovesAsItsClassDoes) {
  Track walker = carTrack(0.0, 0.0, 1.0, 0.0);
  ofClass(walker, ObjectClass::kPedestrian);
  Track car = walker;
  ofClass(car, ObjectClass::kVehicle);
  EXPECT_GT(predicted(walker, 0.5, kOptions).covariance(2, 2),
            predicted(car, 0.5, kOptions).covariance(2, 2));
}

TEST(TrackPredictionTest, TheHeadingBecomesLessCertainUpToUnknown) {
  const Track track = carTrack(0.0, 0.0, 5.0, 0.0);
  const double drift = kOptions.heading_drift;
  EXPECT_NEAR(predicted(track, 0.4, kOptions).heading_variance, 0.01 + 0.4 * drift, 1e-12);
  EXPECT_NEAR(predicted(track, -0.4, kOptions).heading_variance, 0.01 + 0.4 * drift, 1e-12);
  EXPECT_EQ(predicted(track, 1e3, kOptions).heading_variance, kUnknownHeadingVariance);
}

TEST(TrackPredictionTest, TheRestIsUnchanged) {
  Track track = carTrack(0.0, 0.0, 5.0, 0.0);
  track.since_update = 0.1;
  track.history = {{Stamp{1}, Pose2(1.0, 2.0, 0.0)}};
  const Track later = predicted(track, 0.3, kOptions);
  EXPECT_NEAR(later.since_update, 0.4, 1e-12);
  EXPECT_NEAR(later.age, 2.3, 1e-12);
  EXPECT_EQ(predicted(track, -0.3, kOptions).since_update, 0.0);
  EXPECT_EQ(later.id, track.id);
  EXPECT_EQ(later.hits, track.hits);
  EXPECT_EQ(later.history.size(), 1U);
  EXPECT_EQ(later.mode_probabilities, track.mode_probabilities);
  EXPECT_EQ(later.existence_probability, track.existence_probability);
}

TEST(TrackPredictionTest, OptionsAreChecked) {
  EXPECT_NO_THROW(checkOptions(TrackPredictionOptions()));
  TrackPredictionOptions options;
  options.cyclist.acceleration_std = 0.0;
  EXPECT_THROW(checkOptions(options), OptionError);
}

}  // namespace
}  // namespace datmo::track_prediction_test
