// The tracker: one step with a crowd of confirmed tracks.

#include <benchmark/benchmark.h>

#include "datmo_fusion/common/random.h"
#include "datmo_fusion/tracking/tracker.h"

namespace datmo {
namespace {

constexpr double kPeriod = 0.06;  // s
constexpr double kSpeed = 8.0;    // m/s
constexpr double kSpacing = 8.0;  // m, between the objects, along both axes
constexpr int kAbreast = 10;
constexpr double kPositionSigma = 0.2;  // m

/// Steps before the clock runs: all objects have confirmed tracks.
constexpr int kWarmUp = 30;

/// A block of vehicles that drive ahead together, as seen at one step.
ObjectList crowd(int objects, int step, Random& random) {
  ObjectList list;
  list.stamp = Stamp::fromSeconds(1000.0 + kPeriod * step);
  for (int i = 0; i < objects; ++i) {
    Object object;
    const double x = kSpacing * (i / kAbreast) + kSpeed * kPeriod * step;
    const double y = kSpacing * (i % kAbreast);
    object.box = {Pose2(x + random.normal(kPositionSigma), y + random.normal(kPositionSigma), 0.0),
                  4.0, 1.8};
    object.position_covariance = kPositionSigma * kPositionSigma * Eigen::Matrix2d::Identity();
    object.dynamic_state = DynamicState::kMoving;
    object.moving_fraction = 1.0;
    object.points.resize(4);
    list.objects.push_back(object);
  }
  return list;
}

void trackerStep(benchmark::State& state) {
  const auto objects = static_cast<int>(state.range(0));
  Tracker tracker{TrackerOptions{}};
  Random random(1);
  int step = 0;
  std::size_t tracks = 0;
  for (; step < kWarmUp; ++step) {
    tracks = tracker.process(crowd(objects, step, random), Pose2()).tracks.size();
  }
  for (auto _ : state) {
    state.PauseTiming();
    const ObjectList list = crowd(objects, ++step, random);
    state.ResumeTiming();
    benchmark::DoNotOptimize(tracker.process(list, Pose2()));
  }
  state.counters["tracks"] = static_cast<double>(tracks);
}
BENCHMARK(trackerStep)
    ->ArgName("objects")
    ->Arg(10)
    ->Arg(50)
    ->Arg(200)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace datmo
