// SPDX-License-Identifier: BSD-3-Clause
// How the tracker handles objects whose velocity a sensor measured.
#include <cmath>
#include <optional>

#include "tracking_scene.h"
#include <gtest/gtest.h>

namespace datmo::measured_velocity_test {
namespace {

constexpr double kPeriod = 0.1;      // s
constexpr double kWalking = 1.4;     // m/s
constexpr double kSpeedSigma = 0.3;  // m/s

/// As measured by a stereo camera: its position to 0.3 m.
Object seenAt(TrackingScene& scene, double x, const Eigen::Vector2d& velocity) {
  Object object = objectAt(x + scene.noise(0.3), scene.noise(0.3));
  object.position_covariance = Eigen::Matrix2d::Identity() * 0.09;
  object.sensors = {"stereo"};
  object.velocity = MeasuredVelocity{
      velocity + Eigen::Vector2d(scene.noise(kSpeedSigma), scene.noise(kSpeedSigma)),
      Eigen::Matrix2d::Identity() * kSpeedSigma * kSpeedSigma};
  return object;
}

/// Returns the time until it is a track, s.
std::optional<double> delay(bool measured, double speed, double seconds) {
  TrackingScene scene;
  for (double time = 0.0; time < seconds; time += kPeriod) {
    Object object = seenAt(scene, 15.0 + speed * time, {speed, 0.0});
    if (!measured) {
      object.velocity.reset();
    }
    if (!scene.scan({object}).tracks.empty()) {
      return time;
    }
  }
  return std::nullopt;
}

TEST(MeasuredVelocity, AWalkerIsATrackWithinHalfASecond) {
  const std::optional<double> measured = delay(true, kWalking, 5.0);
  ASSERT_TRUE(measured);
  EXPECT_LE(*measured, 0.5);
  const std::optional<double> without = delay(false, kWalking, 5.0);
  EXPECT_TRUE(!without || *without > *measured);
}

TEST(MeasuredVelocity, AnUninformativeOneHasNoEffect) {
  constexpr double kCycling = 4.0;    // m/s
  constexpr double kUnknown = 100.0;  // m/s
  TrackingScene with;
  TrackingScene without;
  for (int i = 0; without.tracks().tracks.empty() && i < 50; ++i) {
    const Eigen::Vector2d velocity(kCycling, 0.0);
    Object vague = seenAt(with, 15.0 + kPeriod * kCycling * i, velocity);
    vague.velocity->covariance = Eigen::Matrix2d::Identity() * kUnknown * kUnknown;
    Object none = seenAt(without, 15.0 + kPeriod * kCycling * i, velocity);
    none.velocity.reset();
    EXPECT_EQ(with.scan({vague}).tracks.size(), without.scan({none}).tracks.size()) << i;
  }
  EXPECT_FALSE(without.tracks().tracks.empty());
}

TEST(MeasuredVelocity, StationaryObjectsAreNoTracks) { EXPECT_FALSE(delay(true, 0.0, 10.0)); }

TEST(MeasuredVelocity, TheTrackHasItFromItsFirstScanOn) {
  TrackingScene scene;
  for (int i = 0; scene.tracks().tracks.empty() && i < 10; ++i) {
    scene.scan({seenAt(scene, 15.0 + kPeriod * kWalking * i, {kWalking, 0.0})});
  }
  ASSERT_EQ(scene.tracks().tracks.size(), 1U);
  const Track& track = scene.tracks().tracks[0];
  EXPECT_TRUE(track.moving);
  EXPECT_NEAR(track.state[2], kWalking, 3.0 * kSpeedSigma);
  EXPECT_LE(track.covariance(2, 2), kSpeedSigma * kSpeedSigma);
}

TEST(MeasuredVelocity, AnotherObjectsVelocityDoesNotMoveATrack) {
  TrackingScene scene;
  for (int i = 0; i < 20; ++i) {
    scene.scan({seenAt(scene, 15.0 + kPeriod * kWalking * i, {kWalking, 0.0})});
  }
  Object object = seenAt(scene, 15.0 + kPeriod * kWalking * 20, {-12.0, 9.0});
  ASSERT_EQ(scene.scan({object}).tracks.size(), 1U);
  EXPECT_NEAR(scene.tracks().tracks[0].state[2], kWalking, 0.5);
}

}  // namespace
}  // namespace datmo::measured_velocity_test
