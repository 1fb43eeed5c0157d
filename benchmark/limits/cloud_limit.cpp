// SPDX-License-Identifier: BSD-3-Clause
// What a cloud cannot be used without: each point is read, brought into the vehicle's frame, and
// counted in a cell of a plane.

#include "cloud_street.h"
#include "stereo_street.h"
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace datmo {
namespace {

/// A plane of so many cells; what lies outside of it comes in on the other side.
constexpr std::uint32_t kCells = 512;
constexpr float kCellsForMeter = 4.0F;
constexpr float kFarthest = 1000.0F;   // m
constexpr float kLayerBottom = 0.3F;  // m

class BarePlane {
 public:
  /// `position`: x, y, z in the sensor's frame, m.
  void count(const float* position, const Eigen::Matrix<float, 3, 4>& pose) {
    const float x = position[0];
    const float y = position[1];
    const float z = position[2];
    const float along = pose(0, 0) * x + pose(0, 1) * y + pose(0, 2) * z + pose(0, 3);
    const float aside = pose(1, 0) * x + pose(1, 1) * y + pose(1, 2) * z + pose(1, 3);
    const float up = pose(2, 0) * x + pose(2, 1) * y + pose(2, 2) * z + pose(2, 3);
    // A hole has no height above anything, and costs no branch.
    counts_[kCells * cellOf(aside) + cellOf(along)] += up > kLayerBottom ? 1 : 0;
  }

  const std::vector<std::int32_t>& counts() const { return counts_; }

 private:
  static std::uint32_t cellOf(float meters) {
    // In this order a hole is at the lower limit, without a branch.
    const float in_reach = std::min(kFarthest, std::max(-kFarthest, meters));
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(in_reach * kCellsForMeter)) %
           kCells;
  }

  std::vector<std::int32_t> counts_ = std::vector<std::int32_t>(kCells * kCells, 0);
};

Eigen::Matrix<float, 3, 4> matrixOf(const Eigen::Isometry3d& pose) {
  return pose.matrix().topRows<3>().cast<float>();
}

void readStereo(benchmark::State& state) {
  const StereoStreet street;
  const PointsView& points = street.cloud().points;
  const Eigen::Matrix<float, 3, 4> pose = matrixOf(street.cloud().camera_in_base);
  BarePlane plane;
  for (auto _ : state) {
    const std::uint8_t* data = points.data;
    for (std::size_t i = 0; i < points.count; ++i, data += points.step) {
      float position[3];
      std::memcpy(position, data, sizeof position);
      plane.count(position, pose);
    }
    benchmark::DoNotOptimize(plane.counts().data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(readStereo)->Name("limit/stereoGrid/columns")->Unit(benchmark::kMillisecond);
BENCHMARK(readStereo)->Name("limit/stereoObjects")->Unit(benchmark::kMillisecond);

void readLidar(benchmark::State& state) {
  const LidarCloud cloud = cloudOfStreet();
  const Eigen::Matrix<float, 3, 4> pose = matrixOf(cloud.lidar_in_base);
  BarePlane plane;
  for (auto _ : state) {
    for (const pcl::PointXYZ& point : *cloud.points) {
      plane.count(point.data, pose);
    }
    benchmark::DoNotOptimize(plane.counts().data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(readLidar)->Name("limit/cloudToScan")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace datmo
