// SPDX-License-Identifier: BSD-3-Clause
// Two Kalman filters track one object with separate measurements: is the fused state as certain as
// it claims? Evaluated by the normalized estimation error squared (NEES) of many seeded runs
// (Bar-Shalom, Li, Kirubarajan 2001, 5.4.2).

#include <cmath>
#include <string>
#include <vector>

#include "fusion_tracks.h"
#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "datmo_fusion/fusion/track/track_combination.h"

namespace datmo::track_consistency_test {
namespace {

constexpr int kRuns = 400;
constexpr int kSteps = 60;
constexpr double kStep = 0.1;  ///< s

/// One of the two trackers.
struct TrackerSetting {
  double sigma;   ///< m, of its measurements along each axis
  int every = 1;  ///< step it measures
};

/// Errors of all runs in the last step.
struct Consistency {
  double nees = 0.0;          ///< mean over all runs; of an honest filter kTrackState
  double position_rms = 0.0;  ///< m
  double velocity_rms = 0.0;  ///< m/s
};

/// Chi-square of kTrackState * kRuns degrees of freedom, nearly normal: slightly more than three
/// sigma, so that one test in a thousand would fail by chance.
const double kBound = 3.3 * std::sqrt(2.0 * kTrackState / kRuns);
const double kMinNees = kTrackState - kBound;
const double kMaxNees = kTrackState + kBound;

TrackState drawn(const TrackCovariance& covariance, Random& random) {
  const TrackCovariance root = covariance.llt().matrixL();
  TrackState unit;
  for (int i = 0; i < kTrackState; ++i) {
    unit[i] = random.normal(1.0);
  }
  return root * unit;
}

/// One object and the two estimates of it.
struct Run {
  TrackState truth = TrackState::Zero();
  StateEstimate a;
  StateEstimate b;
};

class TwoTrackers {
 public:
  TwoTrackers(const TrackerSetting& a, const TrackerSetting& b, double turn_rate)
      : a_(a), b_(b), motion_(coordinatedTurn(turn_rate, TargetMotionOptions(), kStep)) {
    TrackState variance;
    variance << 1.0, 1.0, 4.0, 4.0, 0.25, 0.25;
    const TrackCovariance birth = variance.asDiagonal();
    for (Run& run : runs_) {
      run.truth << 10.0, -5.0, 8.0, 3.0, 0.0, 0.0;
      run.a = {run.truth + drawn(birth, random_), birth};
      run.b = {run.truth + drawn(birth, random_), birth};
    }
    for (int step = 1; step <= kSteps; ++step) {
      advance(step);
    }
  }

  Consistency fusedBy(TrackCombinationMethod method) const {
    TrackCombinationOptions options;
    options.method = method;
    return scored([&](const Run& run) { return fusedState(run.a, run.b, cross_, options); });
  }
  Consistency ofA() const {
    return scored([](const Run& run) { return run.a; });
  }
  Consistency ofB() const {
    return scored([](const Run& run) { return run.b; });
  }

 private:
  CovariancePair covariances() const { return {runs_[0].a.covariance, runs_[0].b.covariance}; }

  /// The covariances of linear filters, and so their cross-covariance, are the same in all runs.
  void advance(int step) {
    const CovariancePair before = covariances();
    for (Run& run : runs_) {
      run.truth = motion_.transition * run.truth + drawn(motion_.noise, random_);
      follow(a_, step, run.truth, run.a);
      follow(b_, step, run.truth, run.b);
    }
    cross_ = steppedCrossCovariance(cross_, before, covariances(), motion_,
                                    TrackCombinationOptions().max_correlation);
  }

  void follow(const TrackerSetting& tracker, int step, const TrackState& truth,
              StateEstimate& estimate) {
    estimate = predict(estimate, motion_);
    if (step % tracker.every == 0) {
      const Point2 noise(random_.normal(tracker.sigma), random_.normal(tracker.sigma));
      estimate = update(estimate, PositionMeasurement{
                                      truth.head<2>() + noise,
                                      Eigen::Matrix2d::Identity() * tracker.sigma * tracker.sigma});
    }
  }

  template <typename EstimateOf>
  Consistency scored(const EstimateOf& estimate_of) const {
    TrackState squares = TrackState::Zero();
    Consistency result;
    for (const Run& run : runs_) {
      const StateEstimate estimate = estimate_of(run);
      const TrackState error = estimate.mean - run.truth;
      result.nees += error.dot(estimate.covariance.llt().solve(error)) / kRuns;
      squares += error.cwiseAbs2() / kRuns;
    }
    result.position_rms = std::sqrt(squares.head<2>().sum());
    result.velocity_rms = std::sqrt(squares.segment<2>(2).sum());
    return result;
  }

  TrackerSetting a_;
  TrackerSetting b_;
  LinearMotion motion_;
  Random random_{11};
  std::vector<Run> runs_ = std::vector<Run>(kRuns);
  CrossCovariance cross_ = CrossCovariance::Zero();
};

struct ConsistencyCase {
  std::string name;
  TrackerSetting a;
  TrackerSetting b;
  double turn_rate;  ///< rad/s
};

class TrackConsistencyTest : public ::testing::TestWithParam<ConsistencyCase> {
 protected:
  TrackConsistencyTest() : trackers_(GetParam().a, GetParam().b, GetParam().turn_rate) {}

  TwoTrackers trackers_;
};

TEST_P(TrackConsistencyTest, EachTrackerIsConsistent) {
  for (const Consistency& alone : {trackers_.ofA(), trackers_.ofB()}) {
    EXPECT_GT(alone.nees, kMinNees);
    EXPECT_LT(alone.nees, kMaxNees);
  }
}

TEST_P(TrackConsistencyTest, InformationFusionIsOverConfident) {
  EXPECT_GT(trackers_.fusedBy(TrackCombinationMethod::kInformation).nees, kMaxNees);
}

TEST_P(TrackConsistencyTest, CovarianceIntersectionIsNot) {
  EXPECT_LT(trackers_.fusedBy(TrackCombinationMethod::kCovarianceIntersection).nees, kMaxNees);
}

TEST_P(TrackConsistencyTest, BarShalomCampoIsConsistent) {
  const Consistency fused = trackers_.fusedBy(TrackCombinationMethod::kBarShalomCampo);
  EXPECT_GT(fused.nees, kMinNees);
  EXPECT_LT(fused.nees, kMaxNees);
}

TEST_P(TrackConsistencyTest, FusedStatesAreNoWorseThanTheBetterTracker) {
  // Random error of one of them in this many runs.
  constexpr double kChance = 1.02;
  const Consistency a = trackers_.ofA();
  const Consistency b = trackers_.ofB();
  for (const TrackCombinationMethod method :
       {TrackCombinationMethod::kCovarianceIntersection, TrackCombinationMethod::kBarShalomCampo}) {
    const Consistency fused = trackers_.fusedBy(method);
    EXPECT_LT(fused.position_rms, kChance * std::min(a.position_rms, b.position_rms))
        << static_cast<int>(method);
    EXPECT_LT(fused.velocity_rms, kChance * std::min(a.velocity_rms, b.velocity_rms))
        << static_cast<int>(method);
  }
}

INSTANTIATE_TEST_SUITE_P(Trackers, TrackConsistencyTest,
                         ::testing::Values(ConsistencyCase{"alike", {0.3}, {0.3}, 0.0},
                                           ConsistencyCase{"turning", {0.3}, {0.3}, 0.4},
                                           ConsistencyCase{"other_noise", {0.1}, {0.5}, 0.0},
                                           ConsistencyCase{"other_rate", {0.3}, {0.3, 2}, 0.0},
                                           ConsistencyCase{
                                               "other_noise_and_rate", {0.5}, {0.2, 2}, 0.4}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace datmo::track_consistency_test
