// SPDX-License-Identifier: BSD-3-Clause
#include "imm_moments.h"

#include <algorithm>

#include "datmo_fusion/common/wide.h"

namespace datmo {

static_assert(kTrackState == 6, "all columns are four doubles, and two");

DATMO_FUSION_WIDE
void momentsAbout(const TrackState& origin, const ModeEstimates& modes,
                  const ModeVector& probabilities, ModeMoments& moments) {
  for (int mode = 0; mode < kMotionModes; ++mode) {
    double* column = moments.data() + kMoments * mode;
    if (!(probabilities[mode] > 0.0)) {
      std::fill_n(column, kMoments, 0.0);
      continue;
    }
    const StateEstimate& estimate = modes[static_cast<std::size_t>(mode)];
    const double* mean = estimate.mean.data();
    const double* covariance = estimate.covariance.data();
    const FourDoubles first = four(mean) - four(origin.data());
    const TwoDoubles last = two(mean + 4) - two(origin.data() + 4);
    four(column) = first;
    two(column + 4) = last;
    double* second = column + kTrackState;
#pragma GCC unroll 6
    for (int j = 0; j < kTrackState; ++j) {
      const double offset = j < 4 ? first[j & 3] : last[j & 1];
      four(second + kTrackState * j) = four(covariance + kTrackState * j) + first * offset;
      two(second + kTrackState * j + 4) = two(covariance + kTrackState * j + 4) + last * offset;
    }
  }
}

DATMO_FUSION_WIDE
void mix(const ModeMoments& moments, const ModeMatrix& weights, ModeMoments& mixed) {
  static_assert(kMotionModes == 5, "all modes are written out: the sums stay in registers");
  constexpr int kFours = kMoments - 2;
  static_assert(kFours % 4 == 0, "a column is fours of doubles, and two");
  const double* __restrict of = moments.data();
  for (int to = 0; to < kMotionModes; ++to) {
    const double* weight = weights.data() + kMotionModes * to;
    double* __restrict sum = mixed.data() + kMoments * to;
    const double w0 = weight[0];
    const double w1 = weight[1];
    const double w2 = weight[2];
    const double w3 = weight[3];
    const double w4 = weight[4];
    for (int i = 0; i < kFours; i += 4) {
      four(sum + i) = four(of + i) * w0 + four(of + kMoments + i) * w1 +
                      four(of + 2 * kMoments + i) * w2 + four(of + 3 * kMoments + i) * w3 +
                      four(of + 4 * kMoments + i) * w4;
    }
    two(sum + kFours) = two(of + kFours) * w0 + two(of + kMoments + kFours) * w1 +
                        two(of + 2 * kMoments + kFours) * w2 +
                        two(of + 3 * kMoments + kFours) * w3 + two(of + 4 * kMoments + kFours) * w4;
  }
}

DATMO_FUSION_WIDE
void estimateOf(const TrackState& origin, const ModeMoments& moments, int mode,
                StateEstimate& estimate) {
  const double* offset = moments.data() + kMoments * mode;
  const double* second = offset + kTrackState;
  double* covariance = estimate.covariance.data();
  const FourDoubles first = four(offset);
  const TwoDoubles last = two(offset + 4);
  four(estimate.mean.data()) = four(origin.data()) + first;
  two(estimate.mean.data() + 4) = two(origin.data() + 4) + last;
#pragma GCC unroll 6
  for (int j = 0; j < kTrackState; ++j) {
    const int at = kTrackState * j;
    four(covariance + at) = four(second + at) - first * offset[j];
    two(covariance + at + 4) = two(second + at + 4) - last * offset[j];
  }
}

DATMO_FUSION_WIDE
void mixture(const TrackState& origin, const ModeEstimates& modes, const ModeVector& probabilities,
             StateEstimate& result) {
  int possible[kMotionModes];  // modes
  double offsets[kMotionModes][kTrackState];
  int count = 0;
  FourDoubles first = {};
  TwoDoubles last = {};
  for (int mode = 0; mode < kMotionModes; ++mode) {
    if (probabilities[mode] > 0.0) {
      const double* mean = modes[static_cast<std::size_t>(mode)].mean.data();
      double* offset = offsets[count];
      four(offset) = four(mean) - four(origin.data());
      two(offset + 4) = two(mean + 4) - two(origin.data() + 4);
      first += four(offset) * probabilities[mode];
      last += two(offset + 4) * probabilities[mode];
      possible[count++] = mode;
    }
  }
  double mean[kTrackState];  // about the origin
  four(mean) = first;
  two(mean + 4) = last;
  double* covariance = result.covariance.data();
#pragma GCC unroll 6
  for (int j = 0; j < kTrackState; ++j) {
    const int at = kTrackState * j;
    FourDoubles upper = {};
    TwoDoubles lower = {};
    for (int i = 0; i < count; ++i) {
      const double* column = modes[static_cast<std::size_t>(possible[i])].covariance.data() + at;
      const double* offset = offsets[i];
      const double weight = probabilities[possible[i]];
      upper += (four(column) + four(offset) * offset[j]) * weight;
      lower += (two(column + 4) + two(offset + 4) * offset[j]) * weight;
    }
    four(covariance + at) = upper - first * mean[j];
    two(covariance + at + 4) = lower - last * mean[j];
  }
  four(result.mean.data()) = four(origin.data()) + first;
  two(result.mean.data() + 4) = two(origin.data() + 4) + last;
}

}  // namespace datmo
