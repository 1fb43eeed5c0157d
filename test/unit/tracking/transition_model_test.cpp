// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/transition_model.h"

#include <cmath>
#include <random>

#include "sojourn_time.h"
#include <gtest/gtest.h>

namespace datmo::transition_model_test {
namespace {

using samples::sojourn;

constexpr double kPeriod = 0.1;  // s
constexpr int kStanding = static_cast<int>(MotionMode::kStanding);

/// Without forgetting, and with distant bounds.
TransitionLearningOptions plainLearning(double prior_exposure) {
  TransitionLearningOptions options;
  options.prior_exposure = prior_exposure;
  options.class_exposure = 1e5;
  options.forgetting = 1e6;
  options.min_sojourn = 0.01;
  options.max_sojourn = 1e6;
  options.min_share = 0.0;
  return options;
}

/// A row with the given sojourn time (s) and shares of jumps, all others at their defaults.
JumpCounts priorCounts(const TransitionLearningOptions& learning) {
  TransitionOptions options;
  options.learning = learning;
  JumpCounts counts = countsOfSojourns(options);
  counts.jumps.row(1) *= 2.0;
  counts.jumps(1, 2) *= 3.0;
  return counts;
}

ModeVector vector(double a, double b, double c, double d, double e) {
  ModeVector result;
  result << a, b, c, d, e;
  return result;
}

TEST(TransitionMatrix, KeepsForTheSojournAndLeavesByTheShares) {
  JumpCounts counts;
  counts.exposure.setConstant(10.0);
  counts.jumps.row(2) << 1.0, 3.0, 0.0, 1.0, 0.0;
  const ModeMatrix matrix = transitionMatrix(counts, 0.4);
  const double kept = std::exp(-0.4 * 5.0 / 10.0);
  EXPECT_NEAR(matrix(2, 2), kept, 1e-12);
  EXPECT_NEAR(matrix(2, 1), 0.6 * (1.0 - kept), 1e-12);
  EXPECT_EQ(matrix(2, 4), 0.0);
  EXPECT_EQ(matrix(0, 0), 1.0) << "a mode that nothing leaves";
}

TEST(TransitionMatrix, RowsSumToOneForAllSteps) {
  const JumpCounts counts = countsOfSojourns(TransitionOptions());
  for (const double seconds : {0.0, 1e-3, 0.1, 10.0, 1e4}) {
    const ModeMatrix matrix = transitionMatrix(counts, seconds);
    EXPECT_TRUE(matrix.rowwise().sum().isOnes(1e-12));
    EXPECT_GE(matrix.minCoeff(), 0.0);
  }
  EXPECT_TRUE(transitionMatrix(counts, 0.0).isIdentity(1e-12));
}

TEST(TransitionMatrix, AModeNotInUseIsNeverEntered) {
  TransitionOptions options;
  options.standing = false;
  const JumpCounts counts = countsOfSojourns(options);
  EXPECT_TRUE(counts.jumps.col(kStanding).isZero());
  EXPECT_TRUE(counts.jumps.row(kStanding).isZero());
  EXPECT_NEAR(sojourn(counts, 0), options.straight_sojourn, 1e-12);
  EXPECT_EQ(priorModeProbabilities(options)[kStanding], 0.0);
}

TEST(TransitionModel, AJumpThatIsSeenIsCountedOnce) {
  const TransitionLearningOptions options = plainLearning(2.0);
  const JumpCounts prior = priorCounts(options);
  TransitionModel model(prior, options);
  const ModeMatrix before = model.predict(kPeriod);
  model.update(ModeVector::Unit(1), ModeVector::Unit(2));
  // The Dirichlet distribution had a strength of 2 s / 0.1 s.
  const ModeVector expected = (20.0 * before.row(1).transpose() + ModeVector::Unit(2)) / 21.0;
  const ModeMatrix after = transitionMatrix(model.counts(), kPeriod);
  EXPECT_TRUE(after.row(1).transpose().isApprox(expected, 1e-9));
  EXPECT_NEAR(model.learned().exposure[1], kPeriod, 1e-9);
  for (const int other : {0, 2, 3, 4}) {
    EXPECT_TRUE(after.row(other).isApprox(before.row(other), 1e-12));
    EXPECT_NEAR(model.learned().exposure[other], 0.0, 1e-9);
  }
}

TEST(TransitionModel, UninformativeDataChangeNothing) {
  const TransitionLearningOptions options = plainLearning(2.0);
  TransitionModel model(priorCounts(options), options);
  model.predict(kPeriod);
  model.update(vector(0.3, 0.1, 0.2, 0.2, 0.2), ModeVector::Constant(7.0));
  EXPECT_TRUE(model.learned().jumps.isZero(1e-9));
  EXPECT_TRUE(model.learned().exposure.isZero(1e-9));
}

TEST(TransitionModel, TheMeanIsThatOfJilkovAndLi) {
  const TransitionLearningOptions options = plainLearning(2.0);
  TransitionModel model(priorCounts(options), options);
  const ModeMatrix p = model.predict(kPeriod);
  const ModeVector m = vector(0.5, 0.2, 0.1, 0.15, 0.05);
  const ModeVector likelihoods = vector(0.2, 5.0, 1.0, 0.01, 3.0);
  model.update(m, likelihoods);
  const ModeMatrix after = transitionMatrix(model.counts(), kPeriod);
  const double evidence = m.dot(p * likelihoods);
  for (int i = 0; i < kMotionModes; ++i) {
    // As in the paper: alpha_ij grows by alpha_ij g_ij / sum_l alpha_il g_il.
    const ModeVector alpha = 20.0 * p.row(i).transpose();
    const double expected_likelihood = p.row(i).dot(likelihoods);
    const ModeVector g = 1.0 + m[i] / evidence * (likelihoods.array() - expected_likelihood);
    const ModeVector expand = alpha + alpha.cwiseProduct(g) / alpha.dot(g);
    EXPECT_TRUE(after.row(i).transpose().isApprox(expand / expand.sum(), 1e-9)) << i;
  }
}

TEST(TransitionModel, OfAModeThatIsTooFastToStopAJumpIntoStandingIsAsIfItHadKeptItsMode) {
  const TransitionLearningOptions options = plainLearning(2.0);
  TransitionModel model(priorCounts(options), options);
  const ModeMatrix p = model.predict(kPeriod);
  const ModeVector m = vector(0.4, 0.2, 0.2, 0.15, 0.05);
  const ModeVector likelihoods = vector(0.2, 0.5, 1.0, 0.1, 3.0);
  const ModeVector shares = vector(0.0, 0.25, 1.0, 0.5, 1.0);
  model.update(m, likelihoods, shares);
  const ModeMatrix after = transitionMatrix(model.counts(), kPeriod);
  ModeMatrix by_row = ModeVector::Ones() * likelihoods.transpose();
  by_row.col(kStanding) << 0.2, 0.25 * 3.0 + 0.75 * 0.5, 3.0, 0.5 * 3.0 + 0.5 * 0.1, 3.0;
  const double evidence = m.dot(p.cwiseProduct(by_row).rowwise().sum());
  for (int i = 0; i < kMotionModes; ++i) {
    const ModeVector row = p.row(i).transpose();
    const ModeVector alpha = 20.0 * row;
    const ModeVector own = by_row.row(i).transpose();
    const ModeVector g = 1.0 + m[i] / evidence * (own.array() - row.dot(own));
    const ModeVector expand = alpha + alpha.cwiseProduct(g) / alpha.dot(g);
    EXPECT_TRUE(after.row(i).transpose().isApprox(expand / expand.sum(), 1e-9)) << i;
  }
}

TEST(TransitionModel, MeanAndTotalVarianceAreThoseOfTheExactPosterior) {
  const TransitionLearningOptions options = plainLearning(1.0);
  TransitionModel model(priorCounts(options), options);
  const ModeMatrix p = model.predict(kPeriod);
  const ModeVector m = vector(0.2, 0.7, 0.1, 0.0, 0.0);
  const ModeVector likelihoods = vector(0.1, 0.3, 3.0, 0.2, 1.0);
  model.update(m, likelihoods);
  const ModeMatrix after = transitionMatrix(model.counts(), kPeriod);

  // Row 1 by samples of its prior, weighted with their likelihood.
  constexpr int kSamples = 200000;
  std::mt19937_64 engine(5);
  ModeVector sum = ModeVector::Zero();
  double squares = 0.0;
  double weights = 0.0;
  for (int sample = 0; sample < kSamples; ++sample) {
    ModeVector row;
    for (int to = 0; to < kMotionModes; ++to) {
      row[to] = std::gamma_distribution<double>(10.0 * p(1, to), 1.0)(engine);
    }
    row /= row.sum();
    ModeMatrix rows = p;
    rows.row(1) = row.transpose();
    const double weight = m.dot(rows * likelihoods);
    sum += weight * row;
    squares += weight * row.squaredNorm();
    weights += weight;
  }
  const ModeVector mean = sum / weights;
  const double variance = squares / weights - mean.squaredNorm();
  EXPECT_TRUE(after.row(1).transpose().isApprox(mean, 3e-3)) << after.row(1) << "\n" << mean;
  const double strength = model.counts().exposure[1] / kPeriod;
  EXPECT_NEAR((1.0 - after.row(1).squaredNorm()) / (strength + 1.0), variance, 0.02 * variance);
}

TEST(TransitionModel, LearningDoesNotDependOnTheStepLength) {
  // Jumps between two modes that are observed without ambiguity.
  const TransitionLearningOptions options = plainLearning(5.0);
  JumpCounts truth = priorCounts(options);
  truth.jumps.row(0) << 0.0, 5.0 / 2.0, 0.0, 0.0, 0.0;
  truth.jumps.row(1) << 5.0 / 4.0, 0.0, 0.0, 0.0, 0.0;
  for (const double seconds : {0.02, 0.1, 0.3}) {
    TransitionModel model(priorCounts(options), options);
    const ModeMatrix matrix = transitionMatrix(truth, seconds);
    std::mt19937_64 engine(7);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    int mode = 0;
    for (double time = 0.0; time < 4000.0; time += seconds) {
      const int next = uniform(engine) < matrix(mode, mode) ? mode : 1 - mode;
      model.predict(seconds);
      model.update(ModeVector::Unit(mode), ModeVector::Unit(next));
      mode = next;
    }
    // Some 660 jumps from each: a standard deviation of 4 %.
    EXPECT_NEAR(sojourn(model.counts(), 0), 2.0, 0.24) << seconds;
    EXPECT_NEAR(sojourn(model.counts(), 1), 4.0, 0.48) << seconds;
    EXPECT_NEAR(model.counts().exposure.head<2>().sum(), 4010.0, 100.0) << seconds;
  }
}

TEST(TransitionModel, ForgetsInSecondsNotInSteps) {
  TransitionLearningOptions options = plainLearning(2.0);
  options.forgetting = 4.0;
  TransitionModel model(priorCounts(options), options);
  model.predict(kPeriod);
  model.update(ModeVector::Unit(1), ModeVector::Unit(2));
  const JumpCounts learned = model.learned();
  TransitionModel other = model;
  model.predict(2.0);
  for (int i = 0; i < 20; ++i) {
    other.predict(0.1);
  }
  EXPECT_TRUE(model.learned().jumps.isApprox(std::exp(-0.5) * learned.jumps, 1e-9));
  EXPECT_TRUE(other.learned().jumps.isApprox(model.learned().jumps, 1e-9));
}

TEST(TransitionModel, LearnedValuesStayWithinTheBounds) {
  TransitionLearningOptions options;
  options.forgetting = 1e6;
  options.max_sojourn = 50.0;
  TransitionModel model(countsOfSojourns(TransitionOptions()), options);
  for (int i = 0; i < 5000; ++i) {
    model.predict(kPeriod);
    model.update(ModeVector::Unit(i % 2), ModeVector::Unit(1 - i % 2));
    model.predict(kPeriod);
    model.update(ModeVector::Unit(2), ModeVector::Unit(2));
  }
  const JumpCounts counts = model.counts();
  EXPECT_NEAR(sojourn(counts, 0), options.min_sojourn, 1e-9);
  EXPECT_NEAR(sojourn(counts, 2), options.max_sojourn, 1e-9);
  for (const int to : {2, 3, 4}) {
    EXPECT_GT(counts.jumps(0, to), 0.9 * options.min_share * counts.jumps.row(0).sum());
  }
  EXPECT_TRUE(transitionMatrix(counts, kPeriod).rowwise().sum().isOnes(1e-12));
}

TEST(TransitionModel, ExtremeStepsAndLikelihoodsStayFinite) {
  const TransitionLearningOptions options;
  TransitionModel model(countsOfSojourns(TransitionOptions()), options);
  for (const double seconds : {0.0, 1e-9, 1e-3, 0.1, 10.0, 1e6, 0.1}) {
    for (const double likelihood : {0.0, 1e-300, 1e300}) {
      model.predict(seconds);
      model.update(ModeVector::Unit(1), vector(1.0, likelihood, 0.5, 0.0, 0.0));
      EXPECT_TRUE(model.counts().jumps.allFinite()) << seconds << " " << likelihood;
      EXPECT_GE(model.counts().jumps.minCoeff(), 0.0);
      EXPECT_GT(model.counts().exposure.minCoeff(), 0.0);
    }
  }
}

TEST(TransitionModel, ANewPriorKeepsTheLearnedCounts) {
  const TransitionLearningOptions options = plainLearning(2.0);
  TransitionModel model(priorCounts(options), options);
  model.predict(kPeriod);
  model.update(ModeVector::Unit(1), ModeVector::Unit(2));
  const JumpCounts learned = model.learned();
  const JumpCounts prior = countsOfSojourns(TransitionOptions());
  model.setPrior(prior);
  EXPECT_TRUE(model.learned().jumps.isApprox(learned.jumps, 1e-9));
  EXPECT_TRUE(model.counts().exposure.isApprox(prior.exposure + learned.exposure, 1e-9));
}

}  // namespace
}  // namespace datmo::transition_model_test
