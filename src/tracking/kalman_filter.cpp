// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/kalman_filter.h"

#include <cmath>

#include <Eigen/LU>

#include "datmo_fusion/common/wide.h"

namespace datmo {

namespace {

/// Prevents the two halves from drifting apart by rounding.
void symmetrize(TrackCovariance& covariance) {
  covariance.triangularView<Eigen::StrictlyLower>() = covariance.transpose();
}

}  // namespace

double Innovation::logLikelihood() const {
  return -0.5 * (squaredDistance() + std::log(covariance.determinant())) - std::log(2.0 * kPi);
}

StateEstimate carriedOn(const StateEstimate& estimate, double seconds) {
  StateEstimate result = estimate;
  result.mean.head<2>() += seconds * result.mean.segment<2>(2);
  result.covariance.topRows<2>() += seconds * result.covariance.middleRows<2>(2);
  result.covariance.leftCols<2>() += seconds * result.covariance.middleCols<2>(2);
  return result;
}

// With the position p and the rest r of the state x = (p, r), a motion is x' = F x + noise with
//
//     F = | I  A |    P = | Ppp  Ppr |    Q = | Qpp  Qpr |
//         | 0  B |        | Prp  Prr |        | Qrp  Qrr |
//
// so that P' = F P F^T + Q becomes, block by block and without the zeros and ones in F:
//
//     p' = p + A r                  r' = B r
//     Prr' = B Prr B^T + Qrr
//     Ppr' = M B^T + Qpr            with M = Ppr + A Prr
//     Ppp' = Ppp + A Prp + M A^T + Qpp
//
// The elements of the rest come in fours: a column of B, Prr or Qrr, a row of Ppr, M or Qpr.
DATMO_FUSION_WIDE
void predict(const StateEstimate& estimate, const LinearMotion& motion, StateEstimate& result) {
  static_assert(kTrackState == 6, "position, and four others");
  const auto& a = motion.transition;  // its upper right is A
  const double* b[4];                 // columns of B
  const double* rest[4];              // columns of Prr
  FourDoubles b_rest[4];              // columns of B Prr
#pragma GCC unroll 4
  for (int j = 0; j < 4; ++j) {
    b[j] = motion.transition.data() + kTrackState * (2 + j) + 2;
    rest[j] = estimate.covariance.data() + kTrackState * (2 + j) + 2;
  }
#pragma GCC unroll 4
  for (int j = 0; j < 4; ++j) {
    b_rest[j] = four(b[0]) * rest[j][0] + four(b[1]) * rest[j][1] + four(b[2]) * rest[j][2] +
                four(b[3]) * rest[j][3];
  }
  TrackCovariance& covariance = result.covariance;
#pragma GCC unroll 4
  for (int j = 0; j < 4; ++j) {  // Prr' = (B Prr) B^T + Qrr
    double* column = covariance.data() + kTrackState * (2 + j) + 2;
    const double* noise = motion.noise.data() + kTrackState * (2 + j) + 2;
    four(column) = b_rest[0] * b[0][j] + b_rest[1] * b[1][j] + b_rest[2] * b[2][j] +
                   b_rest[3] * b[3][j] + four(noise);
  }
  const double* r = estimate.mean.data() + 2;
  four(result.mean.data() + 2) =  // r' = B r
      four(b[0]) * r[0] + four(b[1]) * r[1] + four(b[2]) * r[2] + four(b[3]) * r[3];

  FourDoubles cross[2];  // rows of Ppr
  FourDoubles m[2];      // rows of M
#pragma GCC unroll 2
  for (int i = 0; i < 2; ++i) {
    const auto before = estimate.covariance.row(i).tail<4>();
    const auto noise = motion.noise.row(i).tail<4>();
    cross[i] = FourDoubles{before[0], before[1], before[2], before[3]};
    m[i] = cross[i] + (four(rest[0]) * a(i, 2) + four(rest[1]) * a(i, 3) + four(rest[2]) * a(i, 4) +
                       four(rest[3]) * a(i, 5));
    const FourDoubles after = four(b[0]) * m[i][0] + four(b[1]) * m[i][1] + four(b[2]) * m[i][2] +
                              four(b[3]) * m[i][3] +
                              FourDoubles{noise[0], noise[1], noise[2], noise[3]};
#pragma GCC unroll 4
    for (int j = 0; j < 4; ++j) {  // Ppr' = M B^T + Qpr
      covariance(i, 2 + j) = after[j];
    }
    result.mean[i] =  // p' = p + A r
        estimate.mean[i] + (a(i, 2) * r[0] + a(i, 3) * r[1] + a(i, 4) * r[2] + a(i, 5) * r[3]);
#pragma GCC unroll 2
    for (int j = 0; j <= i; ++j) {  // Ppp' = Ppp + A Prp + M A^T + Qpp
      const double a_cross = cross[j][0] * a(i, 2) + cross[j][1] * a(i, 3) + cross[j][2] * a(i, 4) +
                             cross[j][3] * a(i, 5);
      const double m_a =
          a(j, 2) * m[i][0] + a(j, 3) * m[i][1] + a(j, 4) * m[i][2] + a(j, 5) * m[i][3];
      covariance(j, i) = estimate.covariance(j, i) + a_cross + m_a + motion.noise(j, i);
    }
  }
  symmetrize(covariance);
}

StateEstimate predict(const StateEstimate& estimate, const LinearMotion& motion) {
  StateEstimate result;
  predict(estimate, motion, result);
  return result;
}

StateEstimate update(const StateEstimate& predicted, const PositionMeasurement& measured) {
  if (measured.delay != 0.0) {
    const StateEstimate then = carriedOn(predicted, measured.delay);
    return carriedOn(update(then, PositionMeasurement{measured.position, measured.covariance, 0.0}),
                     -measured.delay);
  }
  const Innovation innovation = innovationOf(predicted, measured);
  const Eigen::Matrix2d weight = innovation.covariance.inverse();
  const Eigen::Matrix2d kept = measured.covariance * weight;
  const Eigen::Matrix2d position = predicted.covariance.topLeftCorner<2, 2>();
  const Eigen::Matrix<double, 2, 4> cross = predicted.covariance.topRightCorner<2, 4>();
  const Eigen::Matrix<double, 4, 2> gain = cross.transpose() * weight;

  StateEstimate result;
  result.mean.head<2>() = predicted.mean.head<2>() + position * (weight * innovation.residual);
  result.mean.tail<4>() = predicted.mean.tail<4>() + gain * innovation.residual;
  result.covariance.topLeftCorner<2, 2>() = kept * position;
  result.covariance.topRightCorner<2, 4>() = kept * cross;
  result.covariance.bottomRightCorner<4, 4>() =
      predicted.covariance.bottomRightCorner<4, 4>() - gain * cross;
  symmetrize(result.covariance);
  return result;
}

StateEstimate update(const StateEstimate& predicted, const MeasuredVelocity& measured) {
  const Innovation innovation = innovationOf(predicted, measured);
  const Eigen::Matrix<double, kTrackState, 2> of_velocity = predicted.covariance.middleCols<2>(2);
  const Eigen::Matrix<double, kTrackState, 2> gain = of_velocity * innovation.covariance.inverse();
  // Joseph's form: the covariance stays positive definite, however precise the measurement.
  TrackCovariance kept = TrackCovariance::Identity();
  kept.middleCols<2>(2) -= gain;
  StateEstimate result;
  result.mean = predicted.mean + gain * innovation.residual;
  result.covariance = kept * predicted.covariance * kept.transpose() +
                      gain * measured.covariance * gain.transpose();
  symmetrize(result.covariance);
  return result;
}

}  // namespace datmo
