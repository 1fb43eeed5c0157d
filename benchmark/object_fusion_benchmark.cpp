// SPDX-License-Identifier: BSD-3-Clause
// Object-level fusion of two lists of objects in one street, supported by the scan.

#include <cstddef>
#include <vector>

#include "street.h"
#include <benchmark/benchmark.h>

#include "datmo_fusion/common/random.h"
#include "datmo_fusion/fusion/object/object_fuser.h"

namespace datmo {
namespace {

/// Cars and pedestrians in the common field of view, as detected by one sensor.
std::vector<Object> observedObjects(const std::vector<Box2>& truth, double sigma, Random& random) {
  constexpr double kSideVariance = 0.01;
  std::vector<Object> objects;
  for (const Box2& box : truth) {
    Object object;
    object.box = box;
    object.box.center = Pose2(box.center.x() + random.normal(sigma),
                              box.center.y() + random.normal(sigma), box.center.heading());
    object.position_covariance = Eigen::Matrix2d::Identity() * sigma * sigma;
    object.heading_variance = kSideVariance;
    object.side_variance = {kHiddenSide, kSideVariance, kSideVariance, kHiddenSide};
    object.points.assign(10, box.center.position());
    objects.push_back(object);
  }
  return objects;
}

std::vector<Box2> roadUsers(std::size_t count, Random& random) {
  std::vector<Box2> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_car = random.chance(0.5);
    boxes.push_back(
        {Pose2(random.uniform(5.0, 60.0), random.uniform(-25.0, 25.0), random.uniform(-kPi, kPi)),
         is_car ? 4.5 : 0.6, is_car ? 1.8 : 0.6});
  }
  return boxes;
}

/// Both sensors detect half of the objects; each detects as many that the other does not.
void objectFusion(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  Random random(1);
  const std::vector<Box2> common = roadUsers(count / 2, random);
  std::vector<SourceObjects> sources(2);
  for (SourceObjects& source : sources) {
    std::vector<Box2> seen = common;
    for (const Box2& box : roadUsers(count - seen.size(), random)) {
      seen.push_back(box);
    }
    source.list.objects = observedObjects(seen, 0.2, random);
  }
  sources[0].source = "lidar";
  sources[1].source = "stereo";
  sources[1].list.views = {{"stereo", {Pose2(1.5, 0.0, 0.0), -0.6, 0.6, 36.0, 60.0}}};
  StreetDrive drive({static_cast<int>(state.range(1))});
  const LabeledScan scan = labeledScan(drive.next(), PointState::kStatic);
  const ObjectFuser fuser{ObjectFuserOptions()};
  for (auto _ : state) {
    benchmark::DoNotOptimize(fuser.fuse(sources, &scan));
  }
  state.counters["fused"] = static_cast<double>(fuser.fuse(sources, &scan).counts.fused);
}
BENCHMARK(objectFusion)
    ->ArgNames({"objects", "beams"})
    ->Args({10, 81})
    ->Args({50, 81})
    ->Args({50, 161})
    ->Args({500, 161})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace datmo
