// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/stereo_objects_stage.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <boost/make_shared.hpp>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/convert/velocity_conversion.h"
#include "datmo_fusion/ros/stage/stage_inputs.h"

namespace datmo {

void StereoObjectsStageOptions::visit(OptionVisitor& visitor) {
  StereoInputOptions::visit(visitor);
  detector.visit(visitor);
  visitor.group("velocity", [&] { velocity.visit(visitor); });
}

StereoObjectsStage::StereoObjectsStage(const StereoObjectsStageOptions& options,
                                       const TransformBuffer& transforms, StageMonitor& monitor)
    : options_(options),
      monitor_(monitor),
      runner_(monitor, options.input, "forgets the road of the last clouds",
              [this] {
                detector_.reset();
                velocities_.reset();
              }),
      input_(options, transforms),
      detector_(options.detector) {
  checkOptions(options);
}

void StereoObjectsStage::takeCameraInfo(const sensor_msgs::CameraInfo& message) {
  runner_.serve([&] { input_.take(message); });
}

void StereoObjectsStage::takeVelocities(const sensor_msgs::PointCloud2& message) {
  runner_.serve([&] {
    if (message.header.frame_id != options_.frames.base) {
      throw InputError("wrong_frame", "point velocities in '" + message.header.frame_id +
                                          "': expected '" + options_.frames.base + "'");
    }
    std::vector<PointVelocity> points = pointVelocities(message);
    runner_.check("point_velocities", message.header.stamp);
    velocities_ = {toStamp(message.header.stamp), std::move(points)};
  });
}

ObjectArrayPtr StereoObjectsStage::takeCloud(const sensor_msgs::PointCloud2& message) {
  return runner_.serve("points2", message, [&] {
    CloudPoints points(message);
    const StereoCloud cloud = input_.cloudOf(message.header, points);
    runner_.check("points2", message.header.stamp);
    StereoObjects objects = objectsOf(cloud);
    measure(objects);
    show(objects);
    auto array = boost::make_shared<ObjectArray>(toMessage(objects.list, options_.frames.base));
    runner_.processed(cloud.stamp);
    return array;
  });
}

StereoObjects StereoObjectsStage::objectsOf(const StereoCloud& cloud) {
  try {
    return detector_.detect(cloud);
  } catch (const std::invalid_argument& error) {
    throw InputError("bad_camera", error.what());
  }
}

void StereoObjectsStage::measure(StereoObjects& objects) {
  if (!velocities_ || velocities_->stamp != objects.list.stamp) {
    return;
  }
  std::vector<Object>& listed = objects.list.objects;
  measureVelocities(velocities_->points, options_.velocity, listed);
  const auto measured = std::count_if(listed.begin(), listed.end(), [](const Object& object) {
    return object.velocity.has_value();
  });
  monitor_.figure("objects with velocity", static_cast<double>(measured));
}

void StereoObjectsStage::show(const StereoObjects& objects) {
  monitor_.figure("objects", static_cast<double>(objects.list.objects.size()));
  monitor_.figure("points of the cloud", static_cast<double>(objects.points));
  showRoad(objects.road_seen, objects.road, monitor_);
}

void StereoObjectsStage::connect(StagePorts& ports) {
  const auto objects = ports.out<ObjectArray>("objects/stereo");
  ports.optionalIn<sensor_msgs::PointCloud2>(
      "point_velocities", [this](const auto& points, Stamp /*now*/) { takeVelocities(*points); });
  connectStereo(ports, *this, objects);
}

}  // namespace datmo
