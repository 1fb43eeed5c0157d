// SPDX-License-Identifier: BSD-3-Clause
// Lower bound for using a cloud: each point is read, transformed to the vehicle's frame, and its
// height is compared with the minimum height of obstacles.

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "cloud_street.h"
#include "stereo_street.h"
#include <benchmark/benchmark.h>

namespace datmo {
namespace {

constexpr float kLayerBottom = 0.3F;  // m

/// Sums over a cloud, so that the work cannot be optimized away.
struct BareCloud {
  float along = 0.0F;  ///< m, sum
  float aside = 0.0F;  ///< m, sum
  int standing = 0;

  /// `position`: x, y, z in the sensor's frame, m. A hole (NaN) fails the comparison, without a
  /// branch.
  void add(const float* position, const Eigen::Matrix<float, 3, 4>& pose) {
    const float x = position[0];
    const float y = position[1];
    const float z = position[2];
    along += pose(0, 0) * x + pose(0, 1) * y + pose(0, 2) * z + pose(0, 3);
    aside += pose(1, 0) * x + pose(1, 1) * y + pose(1, 2) * z + pose(1, 3);
    const float up = pose(2, 0) * x + pose(2, 1) * y + pose(2, 2) * z + pose(2, 3);
    standing += up > kLayerBottom ? 1 : 0;
  }
};

Eigen::Matrix<float, 3, 4> matrixOf(const Eigen::Isometry3d& pose) {
  return pose.matrix().topRows<3>().cast<float>();
}

void readStereo(benchmark::State& state) {
  const StereoStreet street;
  const PointsView& points = street.cloud().points;
  const Eigen::Matrix<float, 3, 4> pose = matrixOf(street.cloud().camera_in_base);
  for (auto _ : state) {
    BareCloud bare;
    const std::uint8_t* data = points.data;
    for (std::size_t i = 0; i < points.count; ++i, data += points.step) {
      float position[3];
      std::memcpy(position, data, sizeof position);
      bare.add(position, pose);
    }
    benchmark::DoNotOptimize(bare);
  }
}
BENCHMARK(readStereo)->Name("limit/stereoGrid/columns")->Unit(benchmark::kMillisecond);
BENCHMARK(readStereo)->Name("limit/stereoObjects")->Unit(benchmark::kMillisecond);
BENCHMARK(readStereo)->Name("limit/stereoStages")->Unit(benchmark::kMillisecond);

void readLidar(benchmark::State& state) {
  const LidarCloud cloud = cloudOfStreet();
  const Eigen::Matrix<float, 3, 4> pose = matrixOf(cloud.lidar_in_base);
  for (auto _ : state) {
    BareCloud bare;
    for (const pcl::PointXYZ& point : *cloud.points) {
      bare.add(point.data, pose);
    }
    benchmark::DoNotOptimize(bare);
  }
}
BENCHMARK(readLidar)->Name("limit/cloudToScan")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace datmo
