// SPDX-License-Identifier: BSD-3-Clause
// Road borders: the whole processing of a scan, and the hit grid and the search by themselves.

#include <cstdint>
#include <optional>

#include "settings.h"
#include "street.h"
#include <benchmark/benchmark.h>

#include "datmo_fusion/grid/hit_grid.h"
#include "datmo_fusion/road/border_search.h"
#include "datmo_fusion/road/road_border_detector.h"

namespace datmo {
namespace {

/// Scans before the measurement, after which the grid is filled and the borders are found.
constexpr int kBorderWarmUp = 100;

/// The drive along the street, with exact poses.
class SplitDrive {
 public:
  explicit SplitDrive(const StreetOptions& street) : drive_(street) {}

  LabeledScan next() {
    const Scan& scan = drive_.next();
    first_ = first_.value_or(scan.stamp);
    LabeledScan split = labeledScan(scan, PointState::kUnknown);
    const double arc_length =
        drive_.odometry().twist.forward_speed * secondsBetween(*first_, scan.stamp);
    split.base_in_map.pose = Pose2(arc_length, 0.0, 0.0);
    split.field = scan.field;
    split.field.first_bearing = scan.rays.front().bearing;
    split.field.beams = static_cast<std::uint32_t>(scan.rays.size());
    return split;
  }

 private:
  StreetDrive drive_;
  std::optional<Stamp> first_;
};

void timeScans(benchmark::State& state, const Settings& settings, double speed) {
  SplitDrive drive({settings.beams, speed});
  RoadBorderDetector detector(settings.road_border);
  for (int i = 0; i < kBorderWarmUp; ++i) {
    detector.update(drive.next());
  }
  std::size_t borders = 0;
  for (auto _ : state) {
    borders = detector.update(drive.next()).borders.size();
  }
  state.counters["borders"] = static_cast<double>(borders);
}

void roadBorderScan(benchmark::State& state, Settings (*settings_of)()) {
  timeScans(state, settings_of(), StreetOptions{}.speed);
}
BENCHMARK_CAPTURE(roadBorderScan, demonstrator, demonstratorSettings)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(roadBorderScan, heavy, heavySettings)->Unit(benchmark::kMicrosecond);

/// Known borders are tracked, and the search for others continues.
void roadBorderStanding(benchmark::State& state) { timeScans(state, demonstratorSettings(), 0.0); }
BENCHMARK(roadBorderStanding)->Unit(benchmark::kMicrosecond);

void hitGridUpdate(benchmark::State& state) {
  const Settings settings = demonstratorSettings();
  SplitDrive drive({static_cast<int>(state.range(0))});
  HitGrid hits(settings.road_border.hit_grid);
  for (auto _ : state) {
    hits.update(drive.next());
  }
  benchmark::DoNotOptimize(hits.highest());
}
BENCHMARK(hitGridUpdate)->ArgName("beams")->Arg(81)->Arg(641)->Unit(benchmark::kMicrosecond);

/// One side from one position; `turned` 0: only windows parallel to the vehicle, as in the thesis.
void borderSearch(benchmark::State& state) {
  const Settings settings = demonstratorSettings();
  SplitDrive drive({settings.beams});
  HitGrid hits(settings.road_border.hit_grid);
  Pose2 vehicle;
  for (int i = 0; i < kBorderWarmUp; ++i) {
    const LabeledScan scan = drive.next();
    hits.update(scan);
    vehicle = scan.base_in_map.pose;
  }
  BorderSearchOptions options = settings.road_border.search;
  if (state.range(0) == 0) {
    options.heading_range = 0.0;
  }
  const BorderSearch search(options);
  for (auto _ : state) {
    benchmark::DoNotOptimize(search.search(hits, vehicle, RoadSide::kLeft));
  }
}
BENCHMARK(borderSearch)->ArgName("turned")->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace datmo
