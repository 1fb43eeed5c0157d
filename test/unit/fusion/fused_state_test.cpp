// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <string>
#include <vector>

#include "fusion_tracks.h"
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "datmo_fusion/fusion/track/track_combination.h"

namespace datmo::fused_state_test {
namespace {

constexpr auto kIntersection = TrackCombinationMethod::kCovarianceIntersection;
constexpr auto kCampo = TrackCombinationMethod::kBarShalomCampo;
constexpr auto kInformation = TrackCombinationMethod::kInformation;
const std::vector<TrackCombinationMethod> kMethods = {kIntersection, kCampo, kInformation};

/// The weight, of 1, that covariance intersection gives to an estimate without new information.
constexpr double kMinWeight = 0.02;

TrackCombinationOptions by(TrackCombinationMethod method) {
  TrackCombinationOptions options;
  options.method = method;
  return options;
}

StateEstimate estimateAt(double position, double variance) {
  return {TrackState::Constant(position), TrackCovariance::Identity() * variance};
}

StateEstimate fusedBy(TrackCombinationMethod method, const StateEstimate& a, const StateEstimate& b,
                      const CrossCovariance& cross = CrossCovariance::Zero()) {
  return fusedState(a, b, cross, by(method));
}

bool isPositive(const TrackCovariance& covariance) {
  // Unscaled units would hide small negative values behind large variances.
  const TrackState scale = covariance.diagonal().cwiseSqrt().cwiseInverse();
  const TrackCovariance scaled = scale.asDiagonal() * covariance * scale.asDiagonal();
  return covariance == covariance.transpose() && scaled.allFinite() &&
         Eigen::LLT<TrackCovariance>(scaled).info() == Eigen::Success;
}

TEST(FusedStateTest, IndependentEstimatesAreWeightedByTheirVariances) {
  for (const TrackCombinationMethod method : {kInformation, kCampo}) {
    const StateEstimate fused = fusedBy(method, estimateAt(0.0, 1.0), estimateAt(4.0, 3.0));
    EXPECT_TRUE(fused.mean.isApproxToConstant(1.0, 1e-9)) << static_cast<int>(method);
    EXPECT_TRUE(fused.covariance.isApprox(TrackCovariance::Identity() * 0.75, 1e-9))
        << static_cast<int>(method);
  }
}

TEST(FusedStateTest, AMixtureCoversBothOfTwoThatContradictEachOther) {
  // Mean 2, variance (1 + 3) / 2 + 2^2, and all components are fully correlated.
  const StateEstimate mixture = mixtureOf({estimateAt(0.0, 1.0), estimateAt(4.0, 3.0)});
  EXPECT_TRUE(mixture.mean.isApproxToConstant(2.0, 1e-12));
  EXPECT_TRUE(mixture.covariance.isApprox(
      TrackCovariance::Identity() * 2.0 + TrackCovariance::Constant(4.0), 1e-12));
  EXPECT_TRUE(isPositive(mixture.covariance));
}

TEST(FusedStateTest, AMixtureOfThreeIsIndependentOfTheirOrder) {
  // Mean (0 + 0 + 6) / 3, variance (1 + 2 + 3) / 3 + (4 + 4 + 16) / 3.
  std::vector<StateEstimate> all = {estimateAt(0.0, 1.0), estimateAt(0.0, 2.0),
                                    estimateAt(6.0, 3.0)};
  for (int i = 0; i < 3; ++i) {
    const StateEstimate mixture = mixtureOf(all);
    EXPECT_TRUE(mixture.mean.isApproxToConstant(2.0, 1e-12));
    EXPECT_TRUE(mixture.covariance.isApprox(
        TrackCovariance::Identity() * 2.0 + TrackCovariance::Constant(8.0), 1e-12));
    std::rotate(all.begin(), all.begin() + 1, all.end());
  }
}

TEST(FusedStateTest, TheThirdOfThreeIsFusedWithTheResultOfTheOthers) {
  const std::vector<StateEstimate> all = {estimateAt(0.0, 1.0), estimateAt(6.0, 3.0),
                                          estimateAt(3.0, 2.0)};
  TrackCombinationOptions options;
  options.method = kCampo;
  const auto cross = [](std::size_t a, std::size_t b) -> CrossCovariance {
    return CrossCovariance::Identity() * (a == 0 && b == 1 ? 0.5 : b == 2 && a == 0 ? 0.2 : 0.4);
  };
  const StateEstimate fused = fusedState(all, cross, options);
  // Of the first two 1 and 11/12 (as by hand above); of the third the cross-covariance 0.3.
  const double gain = (11.0 / 12.0 - 0.3) / (11.0 / 12.0 + 2.0 - 0.6);
  EXPECT_TRUE(fused.mean.isApproxToConstant(1.0 + gain * 2.0, 1e-9));
  EXPECT_TRUE(fused.covariance.isApprox(
      TrackCovariance::Identity() * (11.0 / 12.0 - gain * (11.0 / 12.0 - 0.3)), 1e-9));
}

TEST(FusedStateTest, BarShalomCampoIsByHand) {
  // K = (1 - 0.5) / (1 + 3 - 2 * 0.5) = 1/6; P = 1 - 0.5 / 6.
  const CrossCovariance cross = CrossCovariance::Identity() * 0.5;
  const StateEstimate fused = fusedBy(kCampo, estimateAt(0.0, 1.0), estimateAt(6.0, 3.0), cross);
  EXPECT_TRUE(fused.mean.isApproxToConstant(1.0, 1e-9));
  EXPECT_TRUE(fused.covariance.isApprox(TrackCovariance::Identity() * (11.0 / 12.0), 1e-9));
}

TEST(FusedStateTest, IntersectionOfEqualCovariancesIsTheMean) {
  Random random(1);
  StateEstimate a = randomEstimate(random);
  StateEstimate b = randomEstimate(random);
  b.covariance = a.covariance;
  const StateEstimate fused = fusedBy(kIntersection, a, b);
  EXPECT_TRUE(fused.mean.isApprox(0.5 * (a.mean + b.mean), 1e-6));
  EXPECT_TRUE(fused.covariance.isApprox(a.covariance, 1e-9));
}

TEST(FusedStateTest, IntersectionUsesTheBetterPartOfEach) {
  // One knows x and its derivatives well, the other y. By symmetry the weight is one half.
  StateEstimate a = estimateAt(0.0, 1.0);
  StateEstimate b = estimateAt(1.0, 1.0);
  for (int i = 0; i < kTrackState; i += 2) {
    a.covariance(i, i) = 0.01;
    b.covariance(i + 1, i + 1) = 0.01;
  }
  const StateEstimate fused = fusedBy(kIntersection, a, b);
  for (int i = 0; i < kTrackState; ++i) {
    EXPECT_NEAR(fused.covariance(i, i), 2.0 / (1.0 / 0.01 + 1.0), 1e-9);
    EXPECT_NEAR(fused.mean[i], i % 2 == 0 ? 0.01 / 1.01 : 1.0 / 1.01, 1e-9);
  }
}

TEST(FusedStateTest, IntersectionHasTheLeastDeterminant) {
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    const StateEstimate a = randomEstimate(random);
    const StateEstimate b = randomEstimate(random);
    const TrackCovariance of_a = a.covariance.inverse();
    const TrackCovariance of_b = b.covariance.inverse();
    double best = -std::numeric_limits<double>::infinity();
    for (double weight = 0.0; weight <= 1.0; weight += 0.001) {
      const TrackCovariance information = weight * of_a + (1.0 - weight) * of_b;
      best = std::max(best, std::log(information.determinant()));
    }
    const StateEstimate fused = fusedBy(kIntersection, a, b);
    const double found = -std::log(fused.covariance.determinant());
    EXPECT_LE(found, best + 1e-3);
    EXPECT_GE(found, best - kTrackState * kMinWeight);
  }
}

TEST(FusedStateTest, IntersectionIgnoresEstimatesWithoutNewInformation) {
  const StateEstimate sure = estimateAt(0.0, 1.0);
  const StateEstimate fused = fusedBy(kIntersection, sure, estimateAt(1.0, 4.0));
  EXPECT_NEAR(fused.covariance(0, 0), 1.0, kMinWeight);
  EXPECT_NEAR(fused.mean[0], 0.0, kMinWeight);
}

TEST(FusedStateTest, TheWeightOfIntersectionDoesNotJump) {
  // From slightly more certain to slightly less certain than the other.
  double last = fusedBy(kIntersection, estimateAt(0.0, 0.99), estimateAt(1.0, 1.0)).mean[0];
  for (double variance = 0.991; variance < 1.01; variance += 0.001) {
    const double mean =
        fusedBy(kIntersection, estimateAt(0.0, variance), estimateAt(1.0, 1.0)).mean[0];
    EXPECT_GT(mean, last);
    EXPECT_LT(mean, last + 0.05);
    last = mean;
  }
}

TEST(FusedStateTest, OrderDoesNotMatter) {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const StateEstimate a = randomEstimate(random);
    const StateEstimate b = randomEstimate(random);
    CrossCovariance cross = randomCovariance(random);
    cross *= 0.3 * a.covariance.norm() / cross.norm();
    for (TrackCombinationMethod method : kMethods) {
      const StateEstimate one = fusedBy(method, a, b, cross);
      const StateEstimate other = fusedBy(method, b, a, cross.transpose());
      EXPECT_TRUE(one.mean.isApprox(other.mean, 1e-5)) << static_cast<int>(method);
      EXPECT_TRUE(one.covariance.isApprox(other.covariance, 1e-6)) << static_cast<int>(method);
    }
  }
}

TEST(FusedStateTest, FusionIsRotationInvariant) {
  Random random(4);
  const TrackCovariance turn = stateRotation(0.7);
  for (int i = 0; i < 100; ++i) {
    const StateEstimate a = randomEstimate(random);
    const StateEstimate b = randomEstimate(random);
    const CrossCovariance cross = 0.2 * (a.covariance + b.covariance);
    const StateEstimate turned_a{turn * a.mean, turn * a.covariance * turn.transpose()};
    const StateEstimate turned_b{turn * b.mean, turn * b.covariance * turn.transpose()};
    for (TrackCombinationMethod method : kMethods) {
      const StateEstimate fused = fusedBy(method, a, b, cross);
      const StateEstimate turned =
          fusedBy(method, turned_a, turned_b, turn * cross * turn.transpose());
      EXPECT_TRUE(turned.mean.isApprox(turn * fused.mean, 1e-5)) << static_cast<int>(method);
      EXPECT_TRUE(turned.covariance.isApprox(turn * fused.covariance * turn.transpose(), 1e-5))
          << static_cast<int>(method);
    }
  }
}

TEST(FusedStateTest, TheUnitsDoNotMatter) {
  // The velocity in km/h.
  Random random(5);
  TrackState units;
  units << 1.0, 1.0, 3.6, 3.6, 1.0, 1.0;
  const TrackCovariance change = units.asDiagonal();
  const StateEstimate a = randomEstimate(random);
  const StateEstimate b = randomEstimate(random);
  for (TrackCombinationMethod method : kMethods) {
    const StateEstimate fused = fusedBy(method, a, b);
    const StateEstimate other = fusedBy(method, {change * a.mean, change * a.covariance * change},
                                        {change * b.mean, change * b.covariance * change});
    EXPECT_TRUE(other.mean.isApprox(change * fused.mean, 1e-6)) << static_cast<int>(method);
    EXPECT_TRUE(other.covariance.isApprox(change * fused.covariance * change, 1e-6))
        << static_cast<int>(method);
  }
}

TEST(FusedStateTest, TheResultIsPositiveWhateverTheCrossCovarianceIs) {
  Random random(6);
  for (int i = 0; i < 300; ++i) {
    const StateEstimate a = randomEstimate(random);
    const StateEstimate b = randomEstimate(random);
    const CrossCovariance cross = randomCovariance(random) * random.uniform(-10.0, 10.0);
    for (TrackCombinationMethod method : kMethods) {
      const StateEstimate fused = fusedBy(method, a, b, cross);
      EXPECT_TRUE(isPositive(fused.covariance)) << static_cast<int>(method);
      EXPECT_TRUE(fused.mean.allFinite()) << static_cast<int>(method);
    }
  }
}

TEST(FusedStateTest, NearlySingularEstimatesAreFused) {
  // A position that is practically known, one direction that rounding has made negative, and two
  // that are the same.
  StateEstimate sure = estimateAt(1.0, 1.0);
  sure.covariance.topLeftCorner<2, 2>() *= 1e-18;
  StateEstimate rounded = estimateAt(1.0, 1.0);
  rounded.covariance(0, 2) = rounded.covariance(2, 0) = 1.0 + 1e-15;
  const StateEstimate plain = estimateAt(0.0, 1.0);
  for (TrackCombinationMethod method : kMethods) {
    for (const StateEstimate& one : {sure, rounded}) {
      for (const StateEstimate& other : {plain, one}) {
        const StateEstimate fused = fusedBy(method, one, other);
        EXPECT_TRUE(isPositive(fused.covariance)) << static_cast<int>(method);
        EXPECT_GE(fused.mean.minCoeff(), -1e-6) << static_cast<int>(method);
        EXPECT_LE(fused.mean.maxCoeff(), 1.0 + 1e-6) << static_cast<int>(method);
      }
    }
    EXPECT_NEAR(fusedBy(method, sure, plain).mean[0], 1.0, 1e-6) << static_cast<int>(method);
  }
}

TEST(FusedStateTest, TheMethodDecidesTheSecondOnesNewInformation) {
  // For equally good ones: half the variance, (1 + correlation) / 2 of it, all of it.
  Random random(7);
  const StateEstimate a = randomEstimate(random);
  const StateEstimate b{randomEstimate(random).mean, a.covariance};
  const CrossCovariance cross = evenCrossCovariance({a.covariance, b.covariance}, 0.4);
  EXPECT_TRUE(fusedBy(kInformation, a, b).covariance.isApprox(0.5 * a.covariance, 1e-9));
  EXPECT_TRUE(fusedBy(kCampo, a, b, cross).covariance.isApprox(0.7 * a.covariance, 1e-9));
  EXPECT_TRUE(fusedBy(kIntersection, a, b).covariance.isApprox(a.covariance, 1e-9));
}

TEST(FusedStateTest, OptionsAreChecked) {
  EXPECT_NO_THROW(checkOptions(TrackCombinationOptions()));
  EXPECT_THROW(readOptions<TrackCombinationOptions>({{"method", std::string("average")}}),
               OptionError);
  TrackCombinationOptions options;
  options.max_correlation = 1.0;
  EXPECT_THROW(checkOptions(options), OptionError);
}

}  // namespace
}  // namespace datmo::fused_state_test
