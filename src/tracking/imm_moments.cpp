// SPDX-License-Identifier: BSD-3-Clause
#include "imm_moments.h"

#include <algorithm>

#include "datmo_fusion/common/wide.h"

namespace datmo {

DATMO_FUSION_WIDE
void momentsAbout(const TrackState& origin, const ModeEstimates& modes,
                  const ModeVector& probabilities, ModeMoments& moments) {
  for (int mode = 0; mode < kMotionModes; ++mode) {
    double* __restrict column = moments.data() + kMoments * mode;
    if (!(probabilities[mode] > 0.0)) {
      std::fill_n(column, kMoments, 0.0);
      continue;
    }
    const StateEstimate& estimate = modes[static_cast<std::size_t>(mode)];
    const double* covariance = estimate.covariance.data();
    double offset[kTrackState];
    for (int i = 0; i < kTrackState; ++i) {
      offset[i] = estimate.mean[i] - origin[i];
      column[i] = offset[i];
    }
    double* __restrict second = column + kTrackState;
    for (int j = 0; j < kTrackState; ++j) {
      for (int i = 0; i < kTrackState; ++i) {
        second[kTrackState * j + i] = covariance[kTrackState * j + i] + offset[i] * offset[j];
      }
    }
  }
}

DATMO_FUSION_WIDE
void mix(const ModeMoments& moments, const ModeMatrix& weights, ModeMoments& mixed) {
  static_assert(kMotionModes == 5, "all modes are written out: the sums stay in registers");
  const double* __restrict of = moments.data();
  for (int to = 0; to < kMotionModes; ++to) {
    const double* weight = weights.data() + kMotionModes * to;
    double* __restrict sum = mixed.data() + kMoments * to;
    const double w0 = weight[0];
    const double w1 = weight[1];
    const double w2 = weight[2];
    const double w3 = weight[3];
    const double w4 = weight[4];
    for (int i = 0; i < kMoments; ++i) {
      sum[i] = of[i] * w0 + of[kMoments + i] * w1 + of[2 * kMoments + i] * w2 +
               of[3 * kMoments + i] * w3 + of[4 * kMoments + i] * w4;
    }
  }
}

DATMO_FUSION_WIDE
void estimateOf(const TrackState& origin, const ModeMoments& moments, int mode,
                StateEstimate& estimate) {
  const double* __restrict offset = moments.data() + kMoments * mode;
  const double* __restrict second = offset + kTrackState;
  double* __restrict mean = estimate.mean.data();
  double* __restrict covariance = estimate.covariance.data();
  for (int i = 0; i < kTrackState; ++i) {
    mean[i] = origin[i] + offset[i];
  }
  for (int j = 0; j < kTrackState; ++j) {
    for (int i = 0; i < kTrackState; ++i) {
      covariance[kTrackState * j + i] = second[kTrackState * j + i] - offset[i] * offset[j];
    }
  }
}

DATMO_FUSION_WIDE
StateEstimate mixture(const TrackState& origin, const ModeEstimates& modes,
                      const ModeVector& probabilities) {
  double first[kTrackState] = {};
  double second[kTrackState * kTrackState] = {};
  for (int mode = 0; mode < kMotionModes; ++mode) {
    const double weight = probabilities[mode];
    if (!(weight > 0.0)) {
      continue;
    }
    const StateEstimate& estimate = modes[static_cast<std::size_t>(mode)];
    const double* covariance = estimate.covariance.data();
    double offset[kTrackState];
    for (int i = 0; i < kTrackState; ++i) {
      offset[i] = estimate.mean[i] - origin[i];
      first[i] += offset[i] * weight;
    }
    for (int j = 0; j < kTrackState; ++j) {
      for (int i = 0; i < kTrackState; ++i) {
        const int at = kTrackState * j + i;
        second[at] += (covariance[at] + offset[i] * offset[j]) * weight;
      }
    }
  }
  StateEstimate result;
  for (int i = 0; i < kTrackState; ++i) {
    result.mean[i] = origin[i] + first[i];
  }
  for (int j = 0; j < kTrackState; ++j) {
    for (int i = 0; i < kTrackState; ++i) {
      const int at = kTrackState * j + i;
      result.covariance.data()[at] = second[at] - first[i] * first[j];
    }
  }
  return result;
}

}  // namespace datmo
