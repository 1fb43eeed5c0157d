// SPDX-License-Identifier: BSD-3-Clause
// Conversion of a stereo cloud in a street, as published by stereo_image_proc, to a grid and to
// objects.

#include <cstdint>

#include "stereo_street.h"
#include <benchmark/benchmark.h>

#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/detection/stereo_object_detector.h"
#include "datmo_fusion/ros/convert/cloud_conversion.h"
#include "datmo_fusion/ros/convert/point_field.h"
#include "datmo_fusion/sensor_model/stereo_grid.h"

namespace datmo {
namespace {

void stereoGrid(benchmark::State& state, StereoGridMethod method) {
  const StereoStreet street;
  const StereoCloud& cloud = street.cloud();
  StereoGridOptions options;
  options.method = method;
  StereoGridModel model(options);
  for (auto _ : state) {
    benchmark::DoNotOptimize(model.grid(cloud));
  }
  state.counters["points"] = static_cast<double>(cloud.points.count);
}
BENCHMARK_CAPTURE(stereoGrid, columns, StereoGridMethod::kColumns)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stereoGrid, cones, StereoGridMethod::kCones)->Unit(benchmark::kMillisecond);

void stereoObjects(benchmark::State& state) {
  const StereoStreet street;
  const StereoCloud& cloud = street.cloud();
  StereoObjectDetector detector{StereoObjectDetectorOptions()};
  std::size_t objects = 0;
  for (auto _ : state) {
    objects = detector.detect(cloud).list.objects.size();
    benchmark::DoNotOptimize(objects);
  }
  state.counters["points"] = static_cast<double>(cloud.points.count);
  state.counters["objects"] = static_cast<double>(objects);
}
BENCHMARK(stereoObjects)->Unit(benchmark::kMillisecond);

/// The message of a cloud.
sensor_msgs::PointCloud2 messageOf(const PointsView& points) {
  sensor_msgs::PointCloud2 message;
  message.fields = floatFields({"x", "y", "z"});
  message.height = 1;
  message.width = static_cast<std::uint32_t>(points.count);
  message.point_step = static_cast<std::uint32_t>(points.step);
  message.row_step = message.point_step * message.width;
  message.data.assign(points.data, points.data + points.count * points.step);
  return message;
}

/// What both stages do with one message: each decodes it, corrects a bias of the disparities as
/// measured against the scanner, and estimates the road.
void stereoStages(benchmark::State& state) {
  constexpr double kBias = 0.2;  // px
  const StereoStreet street;
  StereoCloud cloud = street.cloud();
  const sensor_msgs::PointCloud2 message = messageOf(cloud.points);
  const double shift = -kBias / cloud.camera.noise.disparity_at_meter;
  StereoGridModel model{StereoGridOptions()};
  StereoObjectDetector detector{StereoObjectDetectorOptions()};
  const auto decoded = [&](CloudPoints& points) -> const StereoCloud& {
    points.shiftInverseDepths(shift);
    cloud.points = points.view();
    return cloud;
  };
  for (auto _ : state) {
    CloudPoints for_grid(message);
    benchmark::DoNotOptimize(model.grid(decoded(for_grid)));
    CloudPoints for_objects(message);
    benchmark::DoNotOptimize(detector.detect(decoded(for_objects)));
  }
  state.counters["points"] = static_cast<double>(cloud.points.count);
}
BENCHMARK(stereoStages)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace datmo
