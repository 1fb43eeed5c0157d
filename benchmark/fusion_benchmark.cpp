// SPDX-License-Identifier: BSD-3-Clause
// Low-level fusion: the lidar's instantaneous grid, grids predicted to another stamp, fused grids.

#include <algorithm>

#include "street.h"
#include <benchmark/benchmark.h>

#include "datmo_fusion/fusion/grid/grid_fusion.h"
#include "datmo_fusion/fusion/grid/grid_motion.h"
#include "datmo_fusion/sensor_model/lidar_grid.h"

namespace datmo {
namespace {

void lidarGrid(benchmark::State& state) {
  StreetDrive drive({static_cast<int>(state.range(0))});
  const LidarGridModel model{LidarGridOptions()};
  for (auto _ : state) {
    benchmark::DoNotOptimize(model.grid(drive.next()));
  }
}
BENCHMARK(lidarGrid)->ArgName("beams")->Arg(81)->Arg(641)->Unit(benchmark::kMicrosecond);

/// 300 x 360 cells, occupied at the end points of a scan and free everywhere else, which is more
/// than any sensor observes. `step`: index of the scan.
SensorGrid fullGrid(int step) {
  constexpr int kBeams = 641;
  StreetDrive drive({kBeams});
  for (int i = 0; i < step; ++i) {
    drive.next();
  }
  const LidarGridOptions options;
  SensorGrid grid = LidarGridModel(options).grid(drive.next());
  std::replace(grid.cells().begin(), grid.cells().end(), kUnknownPercent,
               toPercent(options.free_probability));
  return grid;
}

void fusion(benchmark::State& state, FusionRule rule) {
  const SensorGrid lidar = fullGrid(0);
  const SensorGrid stereo = fullGrid(1);
  GridSourceOptions vision;
  vision.priority = 1;
  for (auto _ : state) {
    benchmark::DoNotOptimize(fuseGrids(rule, {{&lidar, GridSourceOptions()}, {&stereo, vision}}));
  }
}
BENCHMARK_CAPTURE(fusion, weighted_sum, FusionRule::kWeightedSum)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(fusion, priority, FusionRule::kPriority)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(fusion, maximum, FusionRule::kMaximum)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(fusion, log_odds, FusionRule::kLogOdds)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(fusion, dempster_shafer, FusionRule::kDempsterShafer)
    ->Unit(benchmark::kMicrosecond);

/// Distance (cm) that objects may have moved between the stamps.
void gridMotion(benchmark::State& state) {
  const SensorGrid grid = fullGrid(0);
  const Pose2 motion(-0.4, 0.01, -0.005);
  const double mover_distance = 0.01 * static_cast<double>(state.range(0));
  for (auto _ : state) {
    benchmark::DoNotOptimize(movedGrid(grid, Stamp(), motion, mover_distance));
  }
}
BENCHMARK(gridMotion)
    ->ArgName("mover_distance")
    ->Arg(0)
    ->Arg(60)
    ->Arg(150)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace datmo
