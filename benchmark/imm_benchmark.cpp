// SPDX-License-Identifier: BSD-3-Clause
// The IMM filter of one target: one scan, and each additional measurement in its gate.

#include <benchmark/benchmark.h>

#include "datmo_fusion/common/random.h"
#include "datmo_fusion/tracking/imm_filter.h"

namespace datmo {
namespace {

constexpr double kFilterPeriod = 0.1;   // s
constexpr double kSpeed = 8.0;          // m/s
constexpr double kPositionSigma = 0.2;  // m

/// Scans before the measurement, after which the velocity is known.
constexpr int kFilterWarmUp = 20;

/// A target that drives ahead, with the same noise in every run.
class FollowedTarget {
 public:
  explicit FollowedTarget(bool adaptive = false) {
    options_.transitions.adaptive = adaptive;
    filter_ = ImmFilter(StateEstimate(), priorModeProbabilities(options_),
                        TransitionPriors(options_.transitions).modelOf(ObjectClass::kUnknown));
  }

  void step() {
    filter_.predict(step_);
    benchmark::DoNotOptimize(filter_.estimate());
    filter_.update(seen(), options_.outlier_probability);
  }

  PositionMeasurement seen() {
    const double x = kSpeed * kFilterPeriod * ++scan_;
    return {Point2(x + random_.normal(kPositionSigma), random_.normal(kPositionSigma)),
            kPositionSigma * kPositionSigma * Eigen::Matrix2d::Identity()};
  }

  const ImmFilter& filter() const { return filter_; }

 private:
  ImmOptions options_;
  ImmStep step_ = immStep(options_, kFilterPeriod);
  ImmFilter filter_{StateEstimate(), priorModeProbabilities(options_)};
  Random random_{1};
  int scan_ = 0;
};

void immPredictAndUpdate(benchmark::State& state) {
  FollowedTarget target(state.range(0) != 0);
  for (auto _ : state) {
    target.step();
  }
  benchmark::DoNotOptimize(target.filter().estimate());
}
BENCHMARK(immPredictAndUpdate)->ArgName("adaptive")->Arg(0)->Arg(1);

void immLogLikelihood(benchmark::State& state) {
  FollowedTarget target;
  for (int i = 0; i < kFilterWarmUp; ++i) {
    target.step();
  }
  const PositionMeasurement seen = target.seen();
  for (auto _ : state) {
    benchmark::DoNotOptimize(target.filter().logLikelihood(seen));
  }
}
BENCHMARK(immLogLikelihood);

void immCopy(benchmark::State& state) {
  const FollowedTarget target(true);
  for (auto _ : state) {
    benchmark::DoNotOptimize(ImmFilter(target.filter()));
  }
}
BENCHMARK(immCopy);

}  // namespace
}  // namespace datmo
