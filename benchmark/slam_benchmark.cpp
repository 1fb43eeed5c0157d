// SPDX-License-Identifier: BSD-3-Clause
// Grid SLAM: scoring of one pose by the scan matcher, and the whole processing of a scan, by the
// number of beams and poses and by the size of the map.

#include "settings.h"
#include "street.h"
#include <benchmark/benchmark.h>

#include "datmo_fusion/slam/end_points.h"
#include "datmo_fusion/slam/grid_slam.h"

namespace datmo {
namespace {

/// Scans before the measurement, after which the map is filled and its memory has been touched.
constexpr int kSlamWarmUp = 100;

/// Grid SLAM in the middle of a drive.
class RunningSlam {
 public:
  RunningSlam(const GridSlamOptions& options, const StreetOptions& street)
      : slam_(options), drive_(street) {
    for (int i = 0; i < kSlamWarmUp; ++i) {
      step();
    }
  }

  SlamResult step() {
    scan_ = &drive_.next();
    slam_.addOdometry(drive_.odometry());
    return slam_.process(*scan_);
  }

  const OccupancyMap& map() const { return slam_.map(); }
  const Scan& lastScan() const { return *scan_; }

 private:
  GridSlam slam_;
  StreetDrive drive_;
  const Scan* scan_ = nullptr;
};

void timeSteps(benchmark::State& state, const GridSlamOptions& options,
               const StreetOptions& street) {
  RunningSlam slam(options, street);
  for (auto _ : state) {
    benchmark::DoNotOptimize(slam.step());
  }
}

/// Only sampling and scoring of poses; `per_pose` is the time of one.
void scorePoses(benchmark::State& state) {
  const auto poses = static_cast<int>(state.range(1));
  RunningSlam slam({}, {static_cast<int>(state.range(0))});
  const PoseWithCovariance prediction = slam.step().labeled_scan.base_in_map;
  const auto points = endPoints(slam.lastScan(), GridSlamOptions{}.max_step);
  ScanMatcherOptions options;
  options.samples = poses;
  options.refinement_steps = 0;
  const ScanMatcher matcher(options);
  Random random(1);
  for (auto _ : state) {
    benchmark::DoNotOptimize(matcher.match(slam.map(), points, {prediction}, random));
  }
  using benchmark::Counter;
  state.counters["per_pose"] =
      Counter(poses, Counter::kIsIterationInvariantRate | Counter::kInvert);
}
BENCHMARK(scorePoses)
    ->ArgNames({"beams", "poses"})
    ->Args({81, 300})
    ->Args({641, 1000})
    ->Unit(benchmark::kMicrosecond);

void slamStep(benchmark::State& state, Settings (*settings_of)()) {
  const Settings settings = settings_of();
  timeSteps(state, settings.slam, {settings.beams});
}
BENCHMARK_CAPTURE(slamStep, demonstrator, demonstratorSettings)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(slamStep, heavy, heavySettings)->Unit(benchmark::kMicrosecond);

/// Time is linear in the number of beams for each number of poses (BigO: the fit, RMS: its error),
/// and the time per beam is linear in the number of poses.
void slamStepByBeams(benchmark::State& state, int poses) {
  GridSlamOptions options;
  options.matcher.samples = poses;
  timeSteps(state, options, {static_cast<int>(state.range(0))});
  state.SetComplexityN(state.range(0));
}

void setBeams(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("beams")->Unit(benchmark::kMicrosecond)->Complexity(benchmark::oN);
  for (const int beams : {81, 181, 361, 721, 1441}) {
    benchmark->Arg(beams);
  }
}
BENCHMARK_CAPTURE(slamStepByBeams, poses_100, 100)->Apply(setBeams);
BENCHMARK_CAPTURE(slamStepByBeams, poses_300, 300)->Apply(setBeams);
BENCHMARK_CAPTURE(slamStepByBeams, poses_1000, 1000)->Apply(setBeams);

/// The size of the map matters only when the window moves, and then only by its edge.
void slamStepInWindow(benchmark::State& state) {
  GridSlamOptions options;
  options.map.window.length = static_cast<double>(state.range(0));
  options.map.window.width = options.map.window.length;
  timeSteps(state, options, {StreetOptions{}.beams, static_cast<double>(state.range(1))});
}
BENCHMARK(slamStepInWindow)
    ->ArgNames({"meters", "speed"})
    ->ArgsProduct({{50, 100, 200, 400}, {0, 8}})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace datmo
