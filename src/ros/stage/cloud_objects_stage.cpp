// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/cloud_objects_stage.h"

#include <algorithm>
#include <utility>

#include "datmo_fusion/ros/frames.h"

namespace datmo {

void CloudObjectsStageOptions::visit(OptionVisitor& visitor) {
  visitMaxSweep(visitor, max_sweep);
  visitor.group("input", [&] { input.visit(visitor); });
  detector.visit(visitor);
}

SharedKeys CloudObjectsStageOptions::sharedKeys() {
  return SharedKeys().group<OwnVehicleOptions>("vehicle/", "vehicle/own_points/");
}

CloudObjectsStage::CloudObjectsStage(const Checked<CloudObjectsStageOptions>& options,
                                     const TransformBuffer& transforms, StageMonitor& monitor)
    : ObjectSource("cloud", *options, transforms, monitor),
      options_(*options),
      detector_(options->detector) {}

ObjectList CloudObjectsStage::detect(const sensor_msgs::PointCloud2& message) {
  ConvertedCloud converted = toLidarCloud(message, options_.max_sweep);
  converted.cloud.lidar_in_base =
      sensorMount(transforms_.core(), options_.frames.base, message.header.frame_id);
  checkStamp(message);
  if (converted.unusable_times) {
    monitor_.warned(*converted.unusable_times);
  }
  const Stamp stamp = toStamp(message.header.stamp);
  CloudObjects objects = detector_.detect(converted.cloud, stamp, twistDuring(converted, stamp));
  show(objects, converted);
  return std::move(objects.list);
}

std::optional<Twist2> CloudObjectsStage::twistDuring(const ConvertedCloud& converted,
                                                     Stamp stamp) const {
  const std::vector<float>& times = converted.cloud.times;
  if (times.empty()) {
    return std::nullopt;
  }
  const auto [first, last] = std::minmax_element(times.begin(), times.end());
  const double duration = static_cast<double>(*last) - static_cast<double>(*first);
  if (duration <= 0.0) {
    return std::nullopt;
  }
  const Stamp start = stamp + static_cast<double>(*first);
  const auto motion = motion_.between(start, start + duration);
  return motion ? std::optional<Twist2>(twistOf(*motion, duration)) : std::nullopt;
}

void CloudObjectsStage::show(const CloudObjects& objects, const ConvertedCloud& converted) {
  monitor_.figure("objects", static_cast<double>(objects.list.objects.size()));
  monitor_.figure("clusters too large", static_cast<double>(objects.too_large));
  monitor_.figure("points above the ground", static_cast<double>(objects.points));
  monitor_.figure("points that are not finite", static_cast<double>(converted.holes));
  monitor_.figure("points of the vehicle itself", static_cast<double>(objects.own_points));
  monitor_.figure("ground seen, 0 or 1", objects.ground.seen ? 1.0 : 0.0);
  if (options_.detector.ground.estimate && !objects.ground.seen) {
    monitor_.warned(InputError(
        "no_ground", "no ground plane found in the cloud: assumes the ground at z = 0 of '" +
                         options_.frames.base + "'"));
  }
}

}  // namespace datmo
