// SPDX-License-Identifier: BSD-3-Clause
// Risk in a street: cars in both directions, pedestrians on the sidewalks, static points on both
// sides.

#include <cmath>
#include <cstdint>
#include <ctime>
#include <vector>

#include <benchmark/benchmark.h>

#include "datmo_fusion/common/quantile.h"
#include "datmo_fusion/common/random.h"
#include "datmo_fusion/risk/risk_assessor.h"

namespace datmo {
namespace {

constexpr double kHostSpeed = 12.0;   ///< m/s
constexpr double kScanPeriod = 0.06;  ///< s
constexpr std::uint32_t kStreets = 16;

Track roadUser(std::uint32_t id, Random& random) {
  const bool walks = id % 3 == 0;
  const double side = id % 2 == 0 ? 1.0 : -1.0;
  const double speed = side * (walks ? 1.4 : 12.0);
  Track track;
  track.id = id;
  const Point2 position(random.uniform(-20.0, 80.0), side * (walks ? 7.0 : 3.0));
  track.state << position.x(), position.y(), speed, random.uniform(-0.3, 0.3), 0.0, 0.0;
  track.covariance = 0.05 * TrackCovariance::Identity();
  track.mode_probabilities = {0.6, 0.1, 0.1, 0.1, 0.1};
  track.box = {Pose2(position, speed > 0.0 ? 0.0 : kPi), walks ? 0.6 : 4.4, walks ? 0.6 : 1.8};
  track.heading_variance = 0.01;
  track.moving = true;
  const auto object_class = walks ? ObjectClass::kPedestrian : ObjectClass::kVehicle;
  track.class_probabilities[static_cast<std::size_t>(object_class)] = 1.0;
  track.existence_probability = 0.9;
  return track;
}

RiskInput street(int tracks, std::uint32_t seed) {
  Random random(seed);
  RiskInput input;
  input.stamp = Stamp::fromSeconds(100.0);
  input.host.speed = kHostSpeed;
  input.tracks.stamp = input.stamp;
  for (int i = 1; i <= tracks; ++i) {
    input.tracks.tracks.push_back(roadUser(static_cast<std::uint32_t>(i), random));
  }
  for (double x = -20.0; x < 60.0; x += 0.4) {
    input.standing.emplace_back(x, 9.0);
    input.standing.emplace_back(x, -9.0);
  }
  return input;
}

/// s of processor time, as others may use the machine meanwhile.
double processorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Argument: number of tracks. Streets in turn, as the time depends on how many road users the host
/// can reach. Counters, in s: quantiles of the single assessments, for which there are limits, 5 ms
/// and 10 ms with 30 tracks.
void assessRisks(benchmark::State& state) {
  std::vector<RiskInput> streets;
  for (std::uint32_t seed = 1; seed <= kStreets; ++seed) {
    streets.push_back(street(static_cast<int>(state.range(0)), seed));
  }
  RiskAssessor assessor{RiskOptions()};
  Stamp stamp = streets.front().stamp;
  std::vector<double> seconds;
  for (auto _ : state) {
    RiskInput& input = streets[seconds.size() % streets.size()];
    stamp = stamp + kScanPeriod;
    input.stamp = stamp;
    input.tracks.stamp = stamp;
    const double start = processorSeconds();
    benchmark::DoNotOptimize(assessor.assess(input));
    seconds.push_back(processorSeconds() - start);
  }
  state.counters["median"] = quantile(seconds, 0.5);
  state.counters["percentile_99"] = quantile(seconds, 0.99);
}
BENCHMARK(assessRisks)->Arg(5)->Arg(30)->Arg(200)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace datmo
