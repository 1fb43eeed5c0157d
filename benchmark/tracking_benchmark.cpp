// SPDX-License-Identifier: BSD-3-Clause
// The tracker: one step with many confirmed tracks and as many false alarms, by the number of
// targets and by the kind of association.

#include <string>

#include <benchmark/benchmark.h>

#include "datmo_fusion/common/random.h"
#include "datmo_fusion/tracking/tracker.h"

namespace datmo {
namespace {

constexpr double kObjectsPeriod = 0.06;  // s
constexpr double kSpeed = 8.0;           // m/s
constexpr double kSpacing = 8.0;         // m, between the objects, along both axes
constexpr int kAbreast = 10;
constexpr double kPositionSigma = 0.2;  // m

/// Steps before the measurement, after which all objects have confirmed tracks.
constexpr int kTrackerWarmUp = 30;

/// A false alarm remains a target until it has been missed often enough, so there are more targets
/// than vehicles.
constexpr int kTargetsEach = 10;

Object vehicleAt(const Point2& position) {
  Object object;
  object.box = {Pose2(position.x(), position.y(), 0.0), 4.0, 1.8};
  object.position_covariance = kPositionSigma * kPositionSigma * Eigen::Matrix2d::Identity();
  object.dynamic_state = DynamicState::kMoving;
  object.moving_fraction = 1.0;
  object.points.assign(4, position);
  return object;
}

/// A group of vehicles that drive ahead, as detected in one step, with false alarms among them.
ObjectList crowd(int targets, int false_alarms, int step, Random& random) {
  ObjectList list;
  list.stamp = Stamp::fromSeconds(1000.0 + kObjectsPeriod * step);
  const double distance = kSpeed * kObjectsPeriod * step;
  for (int i = 0; i < targets; ++i) {
    const Point2 noise(random.normal(kPositionSigma), random.normal(kPositionSigma));
    const Point2 position(kSpacing * (i / kAbreast), kSpacing * (i % kAbreast));
    list.objects.push_back(vehicleAt(Point2(distance, 0.0) + position + noise));
  }
  const double length = kSpacing * targets / kAbreast;
  for (int i = 0; i < false_alarms; ++i) {
    const double x = random.uniform(0.0, length);
    list.objects.push_back(vehicleAt({distance + x, random.uniform(0.0, kSpacing * kAbreast)}));
  }
  return list;
}

void trackerStep(benchmark::State& state, TrackerAssociation association) {
  const auto targets = static_cast<int>(state.range(0));
  TrackerOptions options;
  options.association = association;
  // Without the shipped limits, which bound the duration of a step: that is what is measured.
  options.gating.max_targets = kTargetsEach * targets;
  options.intake.max_objects = 2 * targets;
  Tracker tracker(options);
  Random random(1);
  int step = 0;
  std::size_t tracks = 0;
  for (; step < kTrackerWarmUp; ++step) {
    const ObjectList list = crowd(targets, targets, step, random);
    tracks = tracker.process(list, Pose2()).tracks.size();
  }
  for (auto _ : state) {
    state.PauseTiming();
    const ObjectList list = crowd(targets, targets, ++step, random);
    state.ResumeTiming();
    benchmark::DoNotOptimize(tracker.process(list, Pose2()));
  }
  state.counters["tracks"] = static_cast<double>(tracks);
}

void numbersOfTargets(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("targets")->Unit(benchmark::kMicrosecond);
  for (const int targets : {10, 20, 50, 100, 200, 500}) {
    benchmark->Arg(targets);
  }
}
BENCHMARK_CAPTURE(trackerStep, gnn, TrackerAssociation::kGlobalNearestNeighbor)
    ->Apply(numbersOfTargets);
BENCHMARK_CAPTURE(trackerStep, mht, TrackerAssociation::kMultipleHypotheses)
    ->Apply(numbersOfTargets);

}  // namespace
}  // namespace datmo
