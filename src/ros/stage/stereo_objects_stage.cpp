// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/stereo_objects_stage.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <boost/make_shared.hpp>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/convert/velocity_conversion.h"
#include "datmo_fusion/ros/stage/stage_inputs.h"

namespace datmo {

void StereoObjectsStageOptions::visit(OptionVisitor& visitor) {
  StereoInputOptions::visit(visitor);
  detector.visit(visitor);
  visitor.group("velocity", [&] {
    velocity.visit(visitor);
    wait.visit(visitor);
  });
}

SharedKeys StereoObjectsStageOptions::sharedKeys() {
  return StereoInputOptions::sharedKeys().key("surfaces/min_depth", "stereo_camera/min_depth");
}

StereoObjectsStage::StereoObjectsStage(const Checked<StereoObjectsStageOptions>& options,
                                       const TransformBuffer& transforms, StageMonitor& monitor)
    : options_(*options),
      monitor_(monitor),
      runner_(monitor, options->input, "forgets the road of the last clouds", [this] { reset(); }),
      input_(*options, transforms),
      detector_(options->detector),
      wait_(options->wait, monitor) {}

void StereoObjectsStage::reset() {
  detector_.reset();
  wait_.clear();
}

void StereoObjectsStage::handleAlignment(const StereoAlignmentMessage& message) {
  runner_.serve([&] { input_.update(message); });
}

void StereoObjectsStage::handleCameraInfo(const sensor_msgs::CameraInfo& message) {
  runner_.serve([&] { input_.update(message); });
}

void StereoObjectsStage::handleVelocities(const sensor_msgs::PointCloud2& message) {
  runner_.serve([&] {
    if (message.header.frame_id != options_.frames.base) {
      throw InputError("wrong_frame", "point velocities in '" + message.header.frame_id +
                                          "': expected '" + options_.frames.base + "'");
    }
    std::vector<PointVelocity> points = pointVelocities(message);
    runner_.check("point_velocities", message.header.stamp);
    const std::size_t bad = std::size_t{message.width} * message.height - points.size();
    if (bad > 0) {
      monitor_.warned(InputError("bad_velocity",
                                 std::to_string(bad) +
                                     " points with velocity have numbers that are not finite or a "
                                     "covariance that is not positive definite: left out"));
    }
    monitor_.figure("bad points with velocity", static_cast<double>(bad_points_ += bad));
    wait_.addPoints(toStamp(message.header.stamp), std::move(points));
  });
}

ObjectArrayPtr StereoObjectsStage::handleCloud(const sensor_msgs::PointCloud2& message) {
  return runner_.serve("points2", message, [&] {
    const Stopwatch watch;
    CloudPoints points(message);
    const StereoCloud cloud = input_.cloudOf(message.header, points);
    runner_.check("points2", message.header.stamp);
    StereoObjects objects = objectsOf(cloud);
    show(objects);
    wait_.addObjects(std::move(objects.list), watch.seconds());
    std::optional<VelocityWait::Served> served = wait_.next();
    return served ? finish(std::move(*served)) : nullptr;
  });
}

ObjectArrayPtr StereoObjectsStage::next(Stamp now) {
  return runner_.serve([&] {
    std::optional<VelocityWait::Served> served = wait_.next(now);
    return served ? finish(std::move(*served)) : nullptr;
  });
}

ObjectArrayPtr StereoObjectsStage::finish(VelocityWait::Served served) {
  const Stopwatch watch;
  ObjectList& list = served.list;
  if (served.points) {
    measure(*served.points, list.objects);
  }
  auto array = boost::make_shared<ObjectArray>(toMessage(list, options_.frames.base));
  // Waiting time is not processing time.
  monitor_.processed({list.stamp, served.seconds + watch.seconds()});
  return array;
}

StereoObjects StereoObjectsStage::objectsOf(const StereoCloud& cloud) {
  try {
    return detector_.detect(cloud);
  } catch (const std::invalid_argument& error) {
    throw InputError("bad_camera", error.what());
  }
}

void StereoObjectsStage::measure(const std::vector<PointVelocity>& points,
                                 std::vector<Object>& objects) {
  measureVelocities(points, options_.velocity, objects);
  const auto measured = std::count_if(objects.begin(), objects.end(), [](const Object& object) {
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
  published_ = ports.out<ObjectArray>("objects/stereo");
  ports.optionalIn<sensor_msgs::PointCloud2>(
      "point_velocities", [this](const auto& points, Stamp /*now*/) { handleVelocities(*points); });
  connectAlignment(ports, *this);
  connectStereo(ports, *this, published_);
}

bool StereoObjectsStage::publishNext(Stamp now) {
  const ObjectArrayPtr objects = next(now);
  published_.publish(objects);
  return objects != nullptr;
}

}  // namespace datmo
