// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "joint_axes.h"
#include <Eigen/Cholesky>

#include "datmo_fusion/fusion/track/track_combination.h"

namespace datmo {

namespace {

/// Minimum weight in covariance intersection of an estimate that is worse in every respect. A few
/// percent keep the weight smooth: with the determinant alone it would jump between two equally
/// good estimates.
constexpr double kMinWeight = 0.01;

/// Limits of the search for the weight.
constexpr int kMaxSteps = 60;
constexpr double kWeightTolerance = 1e-12;

/// Shares of the second estimate, in joint axes.
struct FusedShares {
  TrackState gain;
  TrackState variance;
};

/// Weight of the first estimate: maximizes the determinant of the information w a^-1 + (1 - w)
/// b^-1, times (w (1 - w))^least. Its logarithm is concave and steep at both ends, so that its
/// slope is 0 at one weight between them.
double intersectionWeight(const TrackState& share) {
  constexpr double kEnds = kMinWeight * kTrackState;
  double low = 0.0;
  double high = 1.0;
  double weight = 0.5;
  for (int step = 0; step < kMaxSteps; ++step) {
    const TrackState terms = (1.0 - 2.0 * share.array()) /
                             (weight * (1.0 - share.array()) + (1.0 - weight) * share.array());
    const double rest = 1.0 - weight;
    const double slope = terms.sum() + kEnds / weight - kEnds / rest;
    const double bend = -terms.squaredNorm() - kEnds / (weight * weight) - kEnds / (rest * rest);
    (slope > 0.0 ? low : high) = weight;
    const double newton = weight - slope / bend;
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    const bool found = std::abs(next - weight) < kWeightTolerance;
    weight = next;
    if (found) {
      break;
    }
  }
  return weight;
}

FusedShares intersection(const TrackState& share) {
  const double weight = intersectionWeight(share);
  const TrackState of_a = weight * (1.0 - share.array());
  const TrackState of_b = (1.0 - weight) * share.array();
  const TrackState sum = of_a + of_b;
  return {of_b.cwiseQuotient(sum), (share.array() * (1.0 - share.array()) / sum.array()).matrix()};
}

FusedShares independent(const TrackState& share) {
  return {share, (share.array() * (1.0 - share.array())).matrix()};
}

StateEstimate fusedAlong(const JointAxes& joint, const StateEstimate& a, const StateEstimate& b,
                         const FusedShares& fused) {
  const TrackState apart = joint.inverse * (b.mean - a.mean);
  return {a.mean + joint.axes * fused.gain.cwiseProduct(apart), joint.covariance(fused.variance)};
}

/// With D = E[a a'], 1 - D = E[b b'] and C = E[a b'] in joint axes, the gain is (D - C) (1 - C -
/// C')^-1. The covariance is computed as that of a weighted sum, which is positive for any gain,
/// rather than as D minus the information of b.
StateEstimate barShalomCampo(const JointAxes& joint, const StateEstimate& a, const StateEstimate& b,
                             const TrackCovariance& cross) {
  const TrackCovariance identity = TrackCovariance::Identity();
  const TrackCovariance of_a = joint.share.asDiagonal();
  const TrackCovariance difference = identity - cross - cross.transpose();
  const TrackCovariance gain = difference.llt().solve((of_a - cross).transpose()).transpose();
  const TrackCovariance rest = identity - gain;
  const TrackCovariance mixed = rest * cross * gain.transpose();
  const TrackCovariance in_axes = rest * of_a * rest.transpose() +
                                  gain * (identity - of_a) * gain.transpose() + mixed +
                                  mixed.transpose();
  return {a.mean + joint.axes * (gain * (joint.inverse * (b.mean - a.mean))),
          joint.covariance(in_axes)};
}

}  // namespace

void TrackCombinationOptions::visit(OptionVisitor& visitor) {
  visitor.choice(
      {"method", "",
       "how the states of two trackers are fused: covariance_intersection, which is consistent "
       "however their errors are correlated (Julier and Uhlmann 1997); bar_shalom_campo, with the "
       "correlation caused by their common process noise (Bar-Shalom and Campo 1986); or "
       "information, as if there were none, which is overconfident"},
      method,
      {{"covariance_intersection", TrackCombinationMethod::kCovarianceIntersection},
       {"bar_shalom_campo", TrackCombinationMethod::kBarShalomCampo},
       {"information", TrackCombinationMethod::kInformation}});
  visitor.number({"max_correlation", "1",
                  "correlation of the errors of two trackers in bar_shalom_campo; at 1 their "
                  "difference would be known exactly"},
                 max_correlation, {0.01, 0.999});
}

StateEstimate fusedState(const StateEstimate& a, const StateEstimate& b,
                         const CrossCovariance& cross, const TrackCombinationOptions& options) {
  const JointAxes joint(a.covariance, b.covariance);
  if (options.method == TrackCombinationMethod::kBarShalomCampo) {
    return barShalomCampo(joint, a, b, joint.limitedCross(cross, options.max_correlation));
  }
  const bool is_intersection = options.method == TrackCombinationMethod::kCovarianceIntersection;
  return fusedAlong(joint, a, b,
                    is_intersection ? intersection(joint.share) : independent(joint.share));
}

StateEstimate fusedState(const std::vector<StateEstimate>& estimates,
                         const CrossCovarianceOf& cross, const TrackCombinationOptions& options) {
  const bool is_correlated = options.method == TrackCombinationMethod::kBarShalomCampo;
  StateEstimate whole = estimates.front();
  for (std::size_t i = 1; i < estimates.size(); ++i) {
    CrossCovariance sum = CrossCovariance::Zero();
    for (std::size_t before = 0; is_correlated && before < i; ++before) {
      sum += cross(before, i);
    }
    whole = fusedState(whole, estimates[i], sum / static_cast<double>(i), options);
  }
  return whole;
}

StateEstimate mixtureOf(const std::vector<StateEstimate>& estimates) {
  const double share = 1.0 / static_cast<double>(estimates.size());
  StateEstimate mixture{TrackState::Zero(), TrackCovariance::Zero()};
  for (const StateEstimate& one : estimates) {
    mixture.mean += share * one.mean;
  }
  for (const StateEstimate& one : estimates) {
    const TrackState apart = one.mean - mixture.mean;
    mixture.covariance += share * (one.covariance + apart * apart.transpose());
  }
  return mixture;
}

}  // namespace datmo
