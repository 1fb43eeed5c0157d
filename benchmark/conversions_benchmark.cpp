// SPDX-License-Identifier: BSD-3-Clause
// Conversion between messages and the core's types, for each scan.

#include <cmath>

#include "settings.h"
#include "street.h"
#include <benchmark/benchmark.h>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/convert/scan_conversion.h"

namespace datmo {
namespace {

sensor_msgs::LaserScan laserScan(int beams) {
  sensor_msgs::LaserScan message;
  StreetDrive drive({beams});
  const Scan& scan = drive.next();
  message.angle_min = static_cast<float>(scan.rays.front().bearing);
  message.angle_max = static_cast<float>(scan.rays.back().bearing);
  message.angle_increment = static_cast<float>(scan.field.beam_spacing);
  message.range_min = 1.0F;
  message.range_max = 150.0F;
  for (const Ray& ray : scan.rays) {
    message.ranges.push_back(ray.hit ? static_cast<float>(ray.range) : INFINITY);
  }
  return message;
}

void scanFromMessage(benchmark::State& state) {
  const sensor_msgs::LaserScan message = laserScan(static_cast<int>(state.range(0)));
  const ScanConversionOptions options;
  for (auto _ : state) {
    benchmark::DoNotOptimize(toScan(message, {}, options));
  }
}
BENCHMARK(scanFromMessage)->ArgName("beams")->Arg(81)->Arg(641)->Unit(benchmark::kMicrosecond);

void labeledScanToMessage(benchmark::State& state) {
  StreetDrive drive({static_cast<int>(state.range(0))});
  const LabeledScan scan = labeledScan(drive.next(), PointState::kStatic);
  for (auto _ : state) {
    benchmark::DoNotOptimize(toMessage(scan, "base_link", "map"));
  }
}
BENCHMARK(labeledScanToMessage)->ArgName("beams")->Arg(81)->Arg(641)->Unit(benchmark::kMicrosecond);

void mapToMessage(benchmark::State& state, Settings (*settings_of)()) {
  const Settings settings = settings_of();
  OccupancyMap map(settings.slam.map);
  StreetDrive drive({settings.beams});
  map.update(drive.next(),
             std::vector<PointState>(static_cast<std::size_t>(settings.beams), PointState::kStatic),
             Pose2());
  for (auto _ : state) {
    benchmark::DoNotOptimize(toMessage(map, Stamp(), "map"));
  }
}
BENCHMARK_CAPTURE(mapToMessage, demonstrator, demonstratorSettings)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(mapToMessage, heavy, heavySettings)->Unit(benchmark::kMicrosecond);

void tracksToMessage(benchmark::State& state) {
  TrackList list;
  list.tracks.resize(static_cast<std::size_t>(state.range(0)));
  for (Track& track : list.tracks) {
    track.sensors = {"lidar"};
  }
  for (auto _ : state) {
    benchmark::DoNotOptimize(toMessage(list, "map"));
  }
}
BENCHMARK(tracksToMessage)->ArgName("tracks")->Arg(10)->Arg(200)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace datmo
