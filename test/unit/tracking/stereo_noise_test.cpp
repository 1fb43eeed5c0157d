// SPDX-License-Identifier: BSD-3-Clause
// Stationary objects must not appear to move because of stereo's errors: depth is uncertain by a
// meter and more, and the error of one frame is strongly correlated with that of the last one.
#include <cmath>
#include <random>

#include "tracking_scene.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/class_belief.h"

namespace datmo::stereo_noise_test {
namespace {

constexpr double kRate = 12.0;            // Hz
constexpr double kSpeed = 8.0;            // m/s, of the vehicle
constexpr double kErrorTime = 0.5;        // s, in which an error is forgotten
constexpr double kAcross = 0.1;           // m, standard deviation across the line of sight
constexpr double kNearest = 5.0;          // m
constexpr double kEffectiveRange = 36.0;  // m

/// The error of the depth, m: constant standard deviation, correlated in time.
class DepthError {
 public:
  DepthError(double sigma, unsigned seed) : sigma_(sigma), engine_(seed) {}

  double next() {
    const double kept = std::exp(-1.0 / (kRate * kErrorTime));
    const double fresh = std::sqrt(1.0 - kept * kept) * sigma_;
    error_ = kept * error_ + fresh * normal_(engine_);
    return error_;
  }
  double across() { return kAcross * normal_(engine_); }

 private:
  double sigma_;
  double error_ = 0.0;
  std::mt19937 engine_;
  std::normal_distribution<double> normal_{0.0, 1.0};
};

/// A car that drives along x at this speed, as stereo sees it from behind, in the vehicle's frame.
Object carAhead(double depth, double sigma, DepthError& error) {
  Object object;
  object.box = {Pose2(depth + error.next(), 3.0 + error.across(), 0.0), 4.2, 1.8};
  object.position_covariance << sigma * sigma, 0.0, 0.0, kAcross * kAcross;
  object.heading_variance = 0.05;
  object.side_variance = {kHiddenSide, 0.01, 0.01, 0.01};
  object.class_probabilities = reportedClass(ObjectClass::kVehicle, 0.9);
  object.sensors = {"stereo"};
  return object;
}

/// Returns how many tracks a car leads to that drives at this speed, or is parked, while the
/// vehicle approaches.
std::uint64_t tracksOf(double speed, double sigma, unsigned seed) {
  TrackingScene scene({}, 1.0 / kRate);
  DepthError error(sigma, seed);
  double vehicle = 0.0;
  double car = kEffectiveRange;
  for (int i = 0; i < 5.0 * kRate && car - vehicle > kNearest && car - vehicle <= kEffectiveRange;
       ++i) {
    scene.scan({carAhead(car - vehicle, sigma, error)}, Pose2(vehicle, 0.0, 0.0));
    vehicle += kSpeed / kRate;
    car += speed / kRate;
  }
  return scene.tracker().counts().confirmed_tracks;
}

TEST(StereoNoise, StationaryObjectsAreNoTracks) {
  for (const double sigma : {0.3, 0.5, 1.0, 1.5}) {
    int tracks = 0;
    for (unsigned seed = 1; seed <= 40; ++seed) {
      tracks += static_cast<int>(tracksOf(0.0, sigma, seed));
    }
    EXPECT_LE(tracks, 1) << "of 40, sigma " << sigma << " m";
  }
}

TEST(StereoNoise, MovingObjectsAreTracks) {
  for (const double sigma : {0.3, 0.5, 1.0}) {
    int tracks = 0;
    for (unsigned seed = 1; seed <= 40; ++seed) {
      tracks += tracksOf(5.0, sigma, seed) > 0 ? 1 : 0;
    }
    EXPECT_GE(tracks, 38) << "of 40, sigma " << sigma << " m";
  }
}

}  // namespace
}  // namespace datmo::stereo_noise_test
