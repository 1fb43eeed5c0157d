// SPDX-License-Identifier: BSD-3-Clause
// Lower bound for a step of grid SLAM: one look-up of each beam's end point from each pose, and one
// addition to each cell that a beam passes; for the map's update alone, only the latter.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "settings.h"
#include "street.h"
#include <benchmark/benchmark.h>

#include "datmo_fusion/grid/row_major.h"

namespace datmo {
namespace {

/// Spacing of the scored poses (m, rad).
constexpr double kPoseStep = 1e-3;
constexpr double kTurnStep = 1e-5;

/// The simplest map: one number per cell.
class BareMap {
 public:
  explicit BareMap(const GridWindow& window)
      : columns_(window.columns),
        rows_(window.rows),
        origin_(window.origin()),
        cells_for_meter_(1.0 / window.cell_size),
        cells_(rowMajorSize(columns_, rows_), 0.5F) {}

  float& at(double x, double y) {
    const int column = static_cast<int>((x - origin_.x()) * cells_for_meter_);
    const int row = static_cast<int>((y - origin_.y()) * cells_for_meter_);
    return cells_[rowMajorIndex(std::clamp(column, 0, columns_ - 1), std::clamp(row, 0, rows_ - 1),
                                columns_)];
  }

  double cellSize() const { return 1.0 / cells_for_meter_; }

 private:
  int columns_;
  int rows_;
  Point2 origin_;
  double cells_for_meter_;
  std::vector<float> cells_;
};

struct Ends {
  std::vector<double> x;
  std::vector<double> y;
};

Ends endsOf(const Scan& scan) {
  Ends ends;
  for (const Ray& ray : scan.rays) {
    ends.x.push_back(ray.end.x());
    ends.y.push_back(ray.end.y());
  }
  return ends;
}

/// Returns the score of the best pose.
float scoreAll(BareMap& map, const Ends& ends, int poses) {
  float best = 0.0F;
  for (int pose = 0; pose < poses; ++pose) {
    const double offset = kPoseStep * pose;
    const double c = std::cos(kTurnStep * pose);
    const double s = std::sin(kTurnStep * pose);
    float sum = 0.0F;
    for (std::size_t i = 0; i < ends.x.size(); ++i) {
      sum += map.at(offset + c * ends.x[i] - s * ends.y[i], c * ends.y[i] + s * ends.x[i]);
    }
    best = std::max(best, sum);
  }
  return best;
}

void passAll(BareMap& map, const Ends& ends) {
  for (std::size_t i = 0; i < ends.x.size(); ++i) {
    const int cells = static_cast<int>(std::hypot(ends.x[i], ends.y[i]) / map.cellSize());
    const double x_step = ends.x[i] / cells;
    const double y_step = ends.y[i] / cells;
    for (int cell = 0; cell < cells; ++cell) {
      map.at(cell * x_step, cell * y_step) += 1e-6F;
    }
  }
}

void timeLimit(benchmark::State& state, const GridSlamOptions& options, int beams) {
  BareMap map(options.map.window.window());
  const Ends ends = endsOf(StreetDrive({beams}).next());
  for (auto _ : state) {
    benchmark::DoNotOptimize(scoreAll(map, ends, options.matcher.samples));
    passAll(map, ends);
    benchmark::ClobberMemory();
  }
}

void slamLimit(benchmark::State& state, Settings (*settings_of)()) {
  const Settings settings = settings_of();
  timeLimit(state, settings.slam, settings.beams);
}
BENCHMARK_CAPTURE(slamLimit, demonstrator, demonstratorSettings)
    ->Name("limit/slamStep/demonstrator")
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(slamLimit, heavy, heavySettings)
    ->Name("limit/slamStep/heavy")
    ->Unit(benchmark::kMicrosecond);

void mapLimit(benchmark::State& state, Settings (*settings_of)()) {
  const Settings settings = settings_of();
  BareMap map(settings.slam.map.window.window());
  const Ends ends = endsOf(StreetDrive({settings.beams}).next());
  for (auto _ : state) {
    passAll(map, ends);
    benchmark::ClobberMemory();
  }
}
BENCHMARK_CAPTURE(mapLimit, demonstrator, demonstratorSettings)
    ->Name("limit/gridUpdate/demonstrator")
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(mapLimit, heavy, heavySettings)
    ->Name("limit/gridUpdate/heavy")
    ->Unit(benchmark::kMicrosecond);

void slamLimitByBeams(benchmark::State& state) {
  timeLimit(state, {}, static_cast<int>(state.range(0)));
}
BENCHMARK(slamLimitByBeams)
    ->Name("limit/slamStepByBeams/poses_300")
    ->ArgName("beams")
    ->Arg(81)
    ->Arg(361)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace datmo
