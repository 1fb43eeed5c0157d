// SPDX-License-Identifier: BSD-3-Clause
// Conversion of the cloud of a 3D lidar with 64 rows, in a street, to a planar scan.

#include <cstring>

#include "cloud_street.h"
#include <benchmark/benchmark.h>

#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/ros/convert/lidar_cloud_conversion.h"
#include "datmo_fusion/ros/convert/point_field.h"
#include "datmo_fusion/sensor_model/cloud_to_scan.h"

namespace datmo {
namespace {

void cloudToScan(benchmark::State& state) {
  const LidarCloud cloud = cloudOfStreet();
  const CloudToScan model{CloudToScanOptions()};
  for (auto _ : state) {
    benchmark::DoNotOptimize(model.scan(cloud));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(cloud.points->size()));
}
BENCHMARK(cloudToScan)->Unit(benchmark::kMillisecond);

/// The cloud with the fields that drivers publish: x, y, z, intensity, t.
sensor_msgs::PointCloud2 messageOf(const LidarCloud& cloud) {
  sensor_msgs::PointCloud2 message;
  message.fields = floatFields({"x", "y", "z", "intensity", "time"});
  message.height = 1;
  message.width = static_cast<std::uint32_t>(cloud.points->size());
  message.point_step = static_cast<std::uint32_t>(message.fields.size() * sizeof(float));
  message.row_step = message.point_step * message.width;
  message.data.resize(message.row_step);
  std::uint8_t* data = message.data.data();
  for (std::size_t i = 0; i < cloud.points->size(); ++i, data += message.point_step) {
    const pcl::PointXYZ& point = (*cloud.points)[i];
    const float numbers[] = {point.x, point.y, point.z, 1.0F, cloud.times[i]};
    std::memcpy(data, numbers, sizeof numbers);
  }
  return message;
}

/// Including the decoding of the message.
void cloudMessageToScan(benchmark::State& state) {
  const LidarCloud cloud = cloudOfStreet();
  const sensor_msgs::PointCloud2 message = messageOf(cloud);
  const CloudToScan model{CloudToScanOptions()};
  constexpr double kMaxSweep = 0.25;  // s
  for (auto _ : state) {
    ConvertedCloud converted = toLidarCloud(message, kMaxSweep);
    converted.cloud.lidar_in_base = cloud.lidar_in_base;
    benchmark::DoNotOptimize(model.scan(converted.cloud));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(message.width));
}
BENCHMARK(cloudMessageToScan)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace datmo
