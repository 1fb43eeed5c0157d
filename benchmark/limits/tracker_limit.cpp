// SPDX-License-Identifier: BSD-3-Clause
// Lower bound for tracking a number of objects: for each of them and each motion mode, a prediction
// of six states and the update with a position.

#include <array>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>
#include <benchmark/benchmark.h>

#include "datmo_fusion/tracking/track.h"

namespace datmo {
namespace {

constexpr double kPeriod = 0.06;  // s
constexpr double kVariance = 0.04;

struct BareFilter {
  TrackState mean = TrackState::Zero();
  TrackCovariance covariance = TrackCovariance::Identity();
};

using BareTarget = std::array<BareFilter, kMotionModes>;

void step(BareFilter& filter, const TrackCovariance& motion, const TrackCovariance& noise,
          const Point2& seen) {
  filter.mean = (motion * filter.mean).eval();
  filter.covariance = (motion * filter.covariance * motion.transpose() + noise).eval();
  const Eigen::Matrix2d innovation =
      filter.covariance.topLeftCorner<2, 2>() + kVariance * Eigen::Matrix2d::Identity();
  const Eigen::Matrix<double, 6, 2> gain = filter.covariance.leftCols<2>() * innovation.inverse();
  filter.mean += gain * (seen - filter.mean.head<2>());
  filter.covariance -= (gain * filter.covariance.topRows<2>()).eval();
}

void followAll(benchmark::State& state) {
  std::vector<BareTarget> targets(static_cast<std::size_t>(state.range(0)));
  TrackCovariance motion = TrackCovariance::Identity();
  motion.topRightCorner<4, 4>() += kPeriod * Eigen::Matrix4d::Identity();
  const TrackCovariance noise = 0.01 * TrackCovariance::Identity();
  const Point2 seen(0.1, 0.1);
  for (auto _ : state) {
    for (BareTarget& target : targets) {
      for (BareFilter& filter : target) {
        step(filter, motion, noise, seen);
      }
    }
    benchmark::DoNotOptimize(targets.data());
    benchmark::ClobberMemory();
  }
}

void numbersOfTargets(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("targets")->Unit(benchmark::kMicrosecond);
  for (const int targets : {50, 200, 500}) {
    benchmark->Arg(targets);
  }
}
BENCHMARK(followAll)->Name("limit/trackerStep/gnn")->Apply(numbersOfTargets);
BENCHMARK(followAll)->Name("limit/trackerStep/mht")->Apply(numbersOfTargets);

}  // namespace
}  // namespace datmo
