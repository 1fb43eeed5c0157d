// SPDX-License-Identifier: BSD-3-Clause
// Track-level fusion of two lists of tracks in one street, with new lists in every step.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "datmo_fusion/common/random.h"
#include "datmo_fusion/fusion/track/track_fuser.h"

namespace datmo {
namespace {

constexpr double kStep = 0.1;  ///< s
constexpr int kHistory = 30;   ///< points of a track

/// All cars and the host vehicle drive at the same velocity.
const Point2 kVelocity(8.0, 0.0);  ///< m/s

/// One of the sensors with its tracker.
struct Source {
  std::string name;
  double sigma;              ///< m, standard deviation of its tracks' positions
  std::vector<Point2> cars;  ///< m, initial positions of the cars that it tracks
};

/// In 100 m x 60 m, one in each cell of a grid, so that no two coincide.
std::vector<Point2> positionsOnStreet(std::size_t count, Random& random) {
  constexpr std::size_t kRows = 10;
  const std::size_t columns = count / kRows + 1;
  const double cell = 100.0 / static_cast<double>(columns);
  std::vector<Point2> positions;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t row = i % kRows;
    const std::size_t column = i / kRows;
    positions.emplace_back((static_cast<double>(column) + random.uniform(0.2, 0.8)) * cell,
                           (static_cast<double>(row) + random.uniform(0.3, 0.7)) * 6.0 - 30.0);
  }
  return positions;
}

ViewFan viewOf(const Source& source, double seconds) {
  constexpr std::size_t kBeams = 161;
  constexpr double kRange = 80.0;
  ViewFan view;
  view.sensor = Pose2(kVelocity * seconds - Point2(5.0, 0.0), 0.0);
  view.first_bearing = degrees(-80.0);
  view.beam_spacing = degrees(1.0);
  view.sure_range = kRange;
  view.range = kRange;
  view.by_beams = source.name == "lidar";
  view.reach.assign(kBeams, kRange);
  return view;
}

Track trackAt(const Point2& position, double sigma, Stamp stamp) {
  TrackState variance;
  variance << sigma * sigma, sigma * sigma, 0.25, 0.25, 0.25, 0.25;
  Track track;
  track.state << position, kVelocity, 0.0, 0.0;
  track.covariance = variance.asDiagonal();
  track.mode_probabilities = {0.8, 0.05, 0.05, 0.05, 0.05};
  track.box = {Pose2(position, 0.0), 4.5, 1.8};
  track.heading_variance = 0.01;
  track.moving = true;
  track.class_probabilities = {0.1, 0.1, 0.1, 0.6, 0.1};
  track.existence_probability = 0.95;
  track.age = kHistory * kStep;
  track.hits = kHistory;
  for (int i = kHistory - 1; i >= 0; --i) {
    const double ago = i * kStep;
    track.history.push_back({stamp + -ago, Pose2(position - kVelocity * ago, 0.0)});
  }
  return track;
}

SourceTracks tracksOf(const Source& source, double seconds, Random& random) {
  TrackList list;
  list.stamp = Stamp::fromSeconds(seconds);
  list.views = {viewOf(source, seconds)};
  for (std::size_t i = 0; i < source.cars.size(); ++i) {
    const Point2 error(random.normal(source.sigma), random.normal(source.sigma));
    list.tracks.push_back(
        trackAt(source.cars[i] + kVelocity * seconds + error, source.sigma, list.stamp));
    list.tracks.back().id = static_cast<std::uint32_t>(i + 1);
    list.tracks.back().sensors = {source.name};
  }
  return {source.name, std::make_shared<const TrackList>(std::move(list))};
}

/// Arguments: tracks of each source, and `pairs`, the number of cars that both track.
void trackFusion(benchmark::State& state, TrackCombinationMethod method) {
  const auto count = static_cast<std::size_t>(state.range(0));
  const auto pairs = static_cast<std::size_t>(state.range(1));
  Random random(1);
  const std::vector<Point2> positions = positionsOnStreet(2 * count - pairs, random);
  const auto own = positions.begin() + static_cast<std::ptrdiff_t>(count);
  std::vector<Source> sources = {{"lidar", 0.1, {positions.begin(), own}}, {"stereo", 0.2, {}}};
  sources[1].cars.assign(own - static_cast<std::ptrdiff_t>(pairs), positions.end());
  TrackFuserOptions options;
  options.combination.method = method;
  TrackFuser fuser(options);
  double seconds = kHistory * kStep;
  std::size_t fused = 0;
  for (auto _ : state) {
    state.PauseTiming();
    seconds += kStep;
    const std::vector<SourceTracks> lists = {tracksOf(sources[0], seconds, random),
                                             tracksOf(sources[1], seconds, random)};
    state.ResumeTiming();
    const TrackFusionResult result = fuser.fuse(lists[0].list->stamp, lists);
    fused = result.counts.fused;
  }
  state.counters["fused"] = static_cast<double>(fused);
}
BENCHMARK_CAPTURE(trackFusion, covariance_intersection,
                  TrackCombinationMethod::kCovarianceIntersection)
    ->ArgNames({"tracks", "pairs"})
    ->Args({10, 10})
    ->Args({50, 50})
    ->Args({50, 25})
    ->Args({200, 200})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(trackFusion, bar_shalom_campo, TrackCombinationMethod::kBarShalomCampo)
    ->ArgNames({"tracks", "pairs"})
    ->Args({50, 50})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace datmo
