// Time of one scan through each stage of the lidar chain, at the demonstrator's settings and with
// more beams, poses or objects. Input is made here: a car drives at 8 m/s along a street of parked
// cars, as boxes of 4.5 m with gaps, on both sides. No I/O, no ROS.

#include <algorithm>
#include <cmath>
#include <vector>

#include <benchmark/benchmark.h>

#include "datmo_fusion/common/random.h"
#include "datmo_fusion/detection/moving_object_detector.h"
#include "datmo_fusion/slam/grid_slam.h"
#include "datmo_fusion/tracking/tracker.h"

namespace datmo {
namespace {

constexpr double kPeriod = 0.06;   // s, of the demonstrator's scanner: 16.6 Hz
constexpr double kSpeed = 8.0;     // m/s
constexpr double kHalfFov = 80.0;  // degrees
constexpr double kStreet = 4.0;    // m, from the car to the parked ones on either side
constexpr double kFront = 12.0;    // m, from the car to the houses
constexpr double kFarthest = 50.0;

/// Whether the street's side shows a parked car at this place, and not the gap behind it.
bool isParked(double x) { return std::fmod(std::abs(x) + 1000.0, 6.0) < 4.5; }

double rangeAlong(double direction, double x) {
  const double across = std::abs(std::sin(direction));
  const double to_cars = kStreet / across;
  const double to_fronts = kFront / across;
  return isParked(x + to_cars * std::cos(direction)) ? to_cars : to_fronts;
}

Scan scanAt(int step, int beams, Random& random) {
  Scan scan;
  scan.stamp = Stamp::fromSeconds(1000.0 + kPeriod * step);
  scan.beam_spacing = degrees(2.0 * kHalfFov / (beams - 1));
  for (int beam = 0; beam < beams; ++beam) {
    Ray ray;
    ray.beam = static_cast<std::uint32_t>(beam);
    ray.bearing = degrees(-kHalfFov) + scan.beam_spacing * beam;
    const double range = rangeAlong(ray.bearing, kSpeed * kPeriod * step) + random.normal(0.05);
    ray.hit = range < kFarthest;
    ray.range = std::min(range, kFarthest);
    ray.end = ray.range * Point2(std::cos(ray.bearing), std::sin(ray.bearing));
    scan.rays.push_back(ray);
  }
  return scan;
}

/// Enough for the map to be filled and to roll.
std::vector<Scan> drive(int beams) {
  Random random(1);
  std::vector<Scan> scans;
  for (int step = 0; step < 300; ++step) {
    scans.push_back(scanAt(step, beams, random));
  }
  return scans;
}

void slamStep(benchmark::State& state) {
  GridSlamOptions options;
  options.matcher.samples = static_cast<int>(state.range(1));
  const std::vector<Scan> scans = drive(static_cast<int>(state.range(0)));
  GridSlam slam(options);
  std::size_t next = 0;
  for (auto _ : state) {
    if (next == scans.size()) {
      state.PauseTiming();
      slam.reset();
      next = 0;
      state.ResumeTiming();
    }
    slam.addOdometry({scans[next].stamp, {kSpeed, 0.0}});
    benchmark::DoNotOptimize(slam.process(scans[next]));
    ++next;
  }
}
BENCHMARK(slamStep)
    ->ArgNames({"beams", "poses"})
    ->Args({81, 300})
    ->Args({161, 300})
    ->Args({641, 300})
    ->Args({81, 1})
    ->Args({81, 1000})
    ->Unit(benchmark::kMicrosecond);

void detectionStep(benchmark::State& state) {
  GridSlam slam{GridSlamOptions{}};
  SplitScan split;
  for (const Scan& scan : drive(static_cast<int>(state.range(0)))) {
    slam.addOdometry({scan.stamp, {kSpeed, 0.0}});
    split = slam.process(scan).split;
  }
  const MovingObjectDetector detector{MovingObjectDetectorOptions{}};
  for (auto _ : state) {
    benchmark::DoNotOptimize(detector.detect(split));
  }
}
BENCHMARK(detectionStep)->ArgName("beams")->Arg(81)->Arg(641)->Unit(benchmark::kMicrosecond);

void trackerStep(benchmark::State& state) {
  Tracker tracker{TrackerOptions{}};
  Random random(2);
  int step = 0;
  ObjectList list;
  for (auto _ : state) {
    state.PauseTiming();
    list.stamp = Stamp::fromSeconds(1000.0 + kPeriod * ++step);
    list.objects.clear();
    for (int i = 0; i < state.range(0); ++i) {
      Object object;
      object.box = {
          Pose2(8.0 * i + kSpeed * kPeriod * step + random.normal(0.1), random.normal(0.1), 0.0),
          4.0, 1.8};
      object.position_covariance = 0.04 * Eigen::Matrix2d::Identity();
      object.points.resize(4);
      list.objects.push_back(object);
    }
    state.ResumeTiming();
    benchmark::DoNotOptimize(tracker.process(list, Pose2()));
  }
}
BENCHMARK(trackerStep)
    ->ArgName("objects")
    ->Arg(10)
    ->Arg(50)
    ->Arg(200)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace datmo
