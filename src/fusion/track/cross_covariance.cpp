// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/track/cross_covariance.h"

#include "joint_axes.h"

namespace datmo {

namespace {

/// Remaining share of the prediction error, P_after P_predicted^-1, with no component larger than
/// before.
TrackCovariance keptError(const TrackCovariance& before, const TrackCovariance& after,
                          const LinearMotion& motion) {
  const JointAxes joint(after,
                        motion.transition * before * motion.transition.transpose() + motion.noise);
  const TrackState kept = joint.share.cwiseQuotient(TrackState::Ones() - joint.share).cwiseMin(1.0);
  return joint.axes * kept.asDiagonal() * joint.inverse;
}

}  // namespace

CrossCovariance evenCrossCovariance(const CovariancePair& covariances, double correlation) {
  const JointAxes joint(covariances.a, covariances.b);
  const TrackState variance = joint.share.cwiseProduct(TrackState::Ones() - joint.share);
  return joint.covariance(TrackState(correlation * variance.cwiseSqrt()));
}

CrossCovariance steppedCrossCovariance(const CrossCovariance& cross, const CovariancePair& before,
                                       const CovariancePair& after, const LinearMotion& motion,
                                       double max_correlation) {
  const TrackCovariance predicted =
      motion.transition * cross * motion.transition.transpose() + motion.noise;
  const CrossCovariance stepped = keptError(before.a, after.a, motion) * predicted *
                                  keptError(before.b, after.b, motion).transpose();
  const JointAxes joint(after.a, after.b);
  return joint.axes * joint.limitedCross(stepped, max_correlation) * joint.axes.transpose();
}

}  // namespace datmo
