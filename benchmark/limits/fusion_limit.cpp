// SPDX-License-Identifier: BSD-3-Clause
// Lower bounds for fusing the tracks, or the objects, of two sources: the distances of all pairs,
// and for each pair of one object the sum of two information matrices, of six states or of a
// position; for objects also the look-up of the beam toward each.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "street.h"
#include <Eigen/Core>
#include <Eigen/LU>
#include <benchmark/benchmark.h>

#include "datmo_fusion/common/random.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {
namespace {

/// The first two states are the position.
template <int kStates>
struct BareEstimate {
  Eigen::Matrix<double, kStates, 1> mean = Eigen::Matrix<double, kStates, 1>::Zero();
  Eigen::Matrix<double, kStates, kStates> covariance =
      Eigen::Matrix<double, kStates, kStates>::Identity();
};

using BareTrack = BareEstimate<TrackState::RowsAtCompileTime>;
using BareObject = BareEstimate<2>;

std::vector<BareTrack> tracksOf(std::size_t count, double variance, Random& random) {
  std::vector<BareTrack> tracks(count);
  for (BareTrack& track : tracks) {
    track.mean << random.uniform(0.0, 100.0), random.uniform(-30.0, 30.0), 8.0, 0.0, 0.0, 0.0;
    track.covariance *= variance;
  }
  return tracks;
}

/// In the area of the objects of the benchmark objectFusion.
std::vector<BareObject> objectsOf(std::size_t count, double variance, Random& random) {
  std::vector<BareObject> objects(count);
  for (BareObject& object : objects) {
    object.mean << random.uniform(5.0, 60.0), random.uniform(-25.0, 25.0);
    object.covariance *= variance;
  }
  return objects;
}

template <int kStates>
std::size_t nearestOf(const BareEstimate<kStates>& estimate,
                      const std::vector<BareEstimate<kStates>>& others) {
  std::size_t nearest = 0;
  double min_distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < others.size(); ++i) {
    const double distance =
        (others[i].mean.template head<2>() - estimate.mean.template head<2>()).squaredNorm();
    nearest = distance < min_distance ? i : nearest;
    min_distance = std::min(min_distance, distance);
  }
  return nearest;
}

template <int kStates>
BareEstimate<kStates> fused(const BareEstimate<kStates>& one, const BareEstimate<kStates>& other) {
  const auto information = one.covariance.inverse().eval();
  const auto other_information = other.covariance.inverse().eval();
  BareEstimate<kStates> both;
  both.covariance = (information + other_information).inverse();
  both.mean = both.covariance * (information * one.mean + other_information * other.mean);
  return both;
}

void fuseTracks(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  Random random(1);
  const std::vector<BareTrack> own = tracksOf(count, 0.01, random);
  const std::vector<BareTrack> others = tracksOf(count, 0.04, random);
  for (auto _ : state) {
    for (const BareTrack& track : own) {
      benchmark::DoNotOptimize(fused(track, others[nearestOf(track, others)]));
    }
  }
}
BENCHMARK(fuseTracks)
    ->Name("limit/trackFusion/covariance_intersection")
    ->ArgNames({"tracks", "pairs"})
    ->Args({50, 50})
    ->Args({200, 200})
    ->Unit(benchmark::kMicrosecond);

/// The ranges of a scan, by direction.
class BareScan {
 public:
  explicit BareScan(const Scan& scan)
      : first_(scan.rays.front().bearing), last_(scan.rays.back().bearing) {
    for (const Ray& ray : scan.rays) {
      ranges_.push_back(ray.range);
    }
  }

  bool occludes(const Point2& position) const {
    const double along = (std::atan2(position.y(), position.x()) - first_) / (last_ - first_);
    const double last_beam = static_cast<double>(ranges_.size() - 1);
    const auto beam = static_cast<std::size_t>(std::clamp(along, 0.0, 1.0) * last_beam);
    return ranges_[beam] * ranges_[beam] < position.squaredNorm();
  }

 private:
  double first_;  // rad
  double last_;   // rad
  std::vector<double> ranges_;
};

/// Half of the objects are seen by both sources.
void fuseObjects(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  Random random(1);
  const std::vector<BareObject> own = objectsOf(count, 0.04, random);
  const std::vector<BareObject> others = objectsOf(count, 0.04, random);
  const BareScan scan(StreetDrive({static_cast<int>(state.range(1))}).next());
  for (auto _ : state) {
    for (std::size_t i = 0; i < count; ++i) {
      benchmark::DoNotOptimize(scan.occludes(others[i].mean));
      const std::size_t nearest = nearestOf(own[i], others);
      benchmark::DoNotOptimize(nearest);
      if (i < count / 2) {
        benchmark::DoNotOptimize(fused(own[i], others[nearest]));
      }
    }
  }
}
BENCHMARK(fuseObjects)
    ->Name("limit/objectFusion")
    ->ArgNames({"objects", "beams"})
    ->Args({10, 81})
    ->Args({50, 81})
    ->Args({50, 161})
    ->Args({500, 161})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace datmo
