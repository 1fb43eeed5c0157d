// SPDX-License-Identifier: BSD-3-Clause
// Conversion of a stereo cloud in a street, as published by stereo_image_proc, to a grid and to
// objects.

#include "stereo_street.h"
#include <benchmark/benchmark.h>

#include "datmo_fusion/detection/stereo_object_detector.h"
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

}  // namespace
}  // namespace datmo
