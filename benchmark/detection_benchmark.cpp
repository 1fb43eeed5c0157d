// SPDX-License-Identifier: BSD-3-Clause
// Detection of moving objects in one scan, in the worst case: all of its points may be moving.

#include <vector>

#include "street.h"
#include <benchmark/benchmark.h>

#include "datmo_fusion/common/random.h"
#include "datmo_fusion/detection/box_fit.h"
#include "datmo_fusion/detection/moving_object_detector.h"
#include "datmo_fusion/detection/segmentation.h"

namespace datmo {
namespace {

LabeledScan scanOfMovers(benchmark::State& state) {
  StreetDrive drive({static_cast<int>(state.range(0))});
  return labeledScan(drive.next(), PointState::kMoving);
}

void segmentation(benchmark::State& state) {
  const LabeledScan scan = scanOfMovers(state);
  const SegmentationOptions options;
  for (auto _ : state) {
    benchmark::DoNotOptimize(segmentPoints(scan.points, options));
  }
}
BENCHMARK(segmentation)->ArgName("beams")->Arg(81)->Arg(641)->Unit(benchmark::kMicrosecond);

/// The two visible sides of a car.
std::vector<Point2> cornerOfCar(int points) {
  constexpr double kLength = 4.5;
  constexpr double kWidth = 1.8;
  constexpr double kNoise = 0.05;
  Random random(1);
  std::vector<Point2> corner;
  for (int i = 0; i < points; ++i) {
    const double arc_length = (kLength + kWidth) * i / points;
    const Point2 position =
        arc_length < kWidth ? Point2(0.0, kWidth - arc_length) : Point2(arc_length - kWidth, 0.0);
    corner.emplace_back(position + Point2(random.normal(kNoise), random.normal(kNoise)));
  }
  return corner;
}

void boxFit(benchmark::State& state) {
  constexpr double kRangeSigma = 0.05;
  const std::vector<Point2> points = cornerOfCar(static_cast<int>(state.range(0)));
  const Point2 scanner(-10.0, -5.0);
  for (auto _ : state) {
    benchmark::DoNotOptimize(fitBox(points, scanner, {kRangeSigma}));
  }
}
BENCHMARK(boxFit)->ArgName("points")->Arg(3)->Arg(10)->Arg(100)->Unit(benchmark::kMicrosecond);

void detection(benchmark::State& state) {
  const LabeledScan scan = scanOfMovers(state);
  const MovingObjectDetector detector{MovingObjectDetectorOptions{}};
  for (auto _ : state) {
    benchmark::DoNotOptimize(detector.detect(scan));
  }
  state.counters["objects"] = static_cast<double>(detector.detect(scan).objects.size());
}
BENCHMARK(detection)->ArgName("beams")->Arg(81)->Arg(641)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace datmo
