// SPDX-License-Identifier: BSD-3-Clause
// Lower bound for fusing the tracks of two sources: the distances of all pairs, and for each pair
// of one object the sum of two information matrices of six states.

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>
#include <benchmark/benchmark.h>

#include "datmo_fusion/common/random.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {
namespace {

struct BareTrack {
  TrackState mean = TrackState::Zero();
  TrackCovariance covariance = TrackCovariance::Identity();
};

std::vector<BareTrack> tracksOf(std::size_t count, double variance, Random& random) {
  std::vector<BareTrack> tracks(count);
  for (BareTrack& track : tracks) {
    track.mean << random.uniform(0.0, 100.0), random.uniform(-30.0, 30.0), 8.0, 0.0, 0.0, 0.0;
    track.covariance *= variance;
  }
  return tracks;
}

std::size_t nearestOf(const BareTrack& track, const std::vector<BareTrack>& others) {
  std::size_t nearest = 0;
  double min_distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < others.size(); ++i) {
    const double distance = (others[i].mean.head<2>() - track.mean.head<2>()).squaredNorm();
    nearest = distance < min_distance ? i : nearest;
    min_distance = std::min(min_distance, distance);
  }
  return nearest;
}

BareTrack fused(const BareTrack& one, const BareTrack& other) {
  const TrackCovariance information = one.covariance.inverse();
  const TrackCovariance other_information = other.covariance.inverse();
  BareTrack both;
  both.covariance = (information + other_information).inverse();
  both.mean = both.covariance * (information * one.mean + other_information * other.mean);
  return both;
}

void fuseAll(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  Random random(1);
  const std::vector<BareTrack> own = tracksOf(count, 0.01, random);
  const std::vector<BareTrack> others = tracksOf(count, 0.04, random);
  for (auto _ : state) {
    for (const BareTrack& track : own) {
      benchmark::DoNotOptimize(fused(track, others[nearestOf(track, others)]));
    }
  }
}
BENCHMARK(fuseAll)
    ->Name("limit/trackFusion/covariance_intersection")
    ->ArgNames({"tracks", "pairs"})
    ->Args({50, 50})
    ->Args({200, 200})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace datmo
