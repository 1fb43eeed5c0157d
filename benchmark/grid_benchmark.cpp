// SPDX-License-Identifier: BSD-3-Clause
// The occupancy map: update with a scan, and movement of its window.

#include "settings.h"
#include "street.h"
#include <benchmark/benchmark.h>

#include "datmo_fusion/grid/occupancy_map.h"

namespace datmo {
namespace {

void gridUpdate(benchmark::State& state, Settings (*settings_of)()) {
  const Settings settings = settings_of();
  OccupancyMap map(settings.slam.map);
  StreetDrive drive({settings.beams, 0.0});
  const std::vector<PointState> states(static_cast<std::size_t>(settings.beams),
                                       PointState::kStatic);
  for (auto _ : state) {
    map.update(drive.next(), states, Pose2());
  }
  benchmark::DoNotOptimize(map.occupancy({0, 0}));
}
BENCHMARK_CAPTURE(gridUpdate, demonstrator, demonstratorSettings)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(gridUpdate, heavy, heavySettings)->Unit(benchmark::kMicrosecond);

/// Argument: cells by which the window moves along both axes in each step.
void gridScroll(benchmark::State& state) {
  OccupancyMapOptions options;
  options.window.length = static_cast<double>(state.range(0));
  options.window.width = options.window.length;
  const double step = options.window.cell_size * static_cast<double>(state.range(1));
  OccupancyMap map(options);
  Point2 position = Point2::Zero();
  for (auto _ : state) {
    position += Point2(step, step);
    map.centerOn(position);
  }
  benchmark::DoNotOptimize(map.occupancy({0, 0}));
  state.counters["edge_cells"] = map.window().columns;
}
BENCHMARK(gridScroll)
    ->ArgNames({"meters", "cells"})
    ->ArgsProduct({{50, 100, 200, 400}, {0, 1, 2}})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace datmo
