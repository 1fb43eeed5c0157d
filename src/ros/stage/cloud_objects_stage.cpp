// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/cloud_objects_stage.h"

#include <algorithm>

#include <boost/make_shared.hpp>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/frames.h"
#include "datmo_fusion/ros/stage/stage_inputs.h"

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
    : options_(*options),
      transforms_(transforms),
      monitor_(monitor),
      detector_(options->detector),
      runner_(monitor, options->input, "starts over", [this] { motion_.reset(); }),
      motion_(options->motion, options->frames, runner_) {}

ObjectArrayPtr CloudObjectsStage::takeCloud(const sensor_msgs::PointCloud2& message) {
  return runner_.serve("cloud", message, [&] {
    ConvertedCloud converted = toLidarCloud(message, options_.max_sweep);
    converted.cloud.lidar_in_base =
        sensorMount(transforms_.core(), options_.frames.base, message.header.frame_id);
    runner_.check("cloud", message.header.stamp);
    if (converted.unusable_times) {
      monitor_.warned(*converted.unusable_times);
    }
    const Stamp stamp = toStamp(message.header.stamp);
    const CloudObjects objects =
        detector_.detect(converted.cloud, stamp, twistDuring(converted, stamp));
    show(objects, converted);
    auto array = boost::make_shared<ObjectArray>(toMessage(objects.list, options_.frames.base));
    runner_.processed(stamp);
    return array;
  });
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
    monitor_.warned(
        InputError("no_ground", "no plane of the ground in the cloud: takes it as z = 0 of '" +
                                    options_.frames.base + "'"));
  }
}

void CloudObjectsStage::connect(StagePorts& ports) {
  const auto objects = ports.out<ObjectArray>("objects/cloud");
  connectMotion(ports, options_.motion, *this);
  ports.in<sensor_msgs::PointCloud2>("cloud", [this, objects](const auto& cloud, Stamp /*now*/) {
    objects.publish(takeCloud(*cloud));
  });
}

}  // namespace datmo
