#include "datmo_fusion/ros/stereo_objects_stage.h"

#include <stdexcept>

#include <boost/make_shared.hpp>

#include "datmo_fusion/ros/descriptions.h"
#include "datmo_fusion/ros/message_conversion.h"
#include "datmo_fusion/ros/stage_inputs.h"

namespace datmo {

void StereoObjectsStageOptions::visit(OptionVisitor& visitor) {
  StereoInputOptions::visit(visitor);
  detector.visit(visitor);
}

StereoObjectsStage::StereoObjectsStage(const StereoObjectsStageOptions& options,
                                       const TransformBuffer& transforms, StageMonitor& monitor)
    : options_(options),
      monitor_(monitor),
      input_(options, transforms),
      detector_(options.detector) {
  checkOptions(options);
}

void StereoObjectsStage::takeCameraInfo(const sensor_msgs::CameraInfo& message) {
  try {
    input_.take(message);
  } catch (const InputError& error) {
    monitor_.dropped(error);
  }
}

ObjectArrayPtr StereoObjectsStage::takeCloud(const sensor_msgs::PointCloud2& message) {
  monitor_.describe("points2", [&] { return descriptionOf(message); });
  try {
    const Stopwatch watch;
    CloudPoints points(message);
    const StereoCloud cloud = input_.cloudOf(message.header, points);
    if (input_.check(message.header) == Arrival::kRestart) {
      monitor_.warned(InputError("clock_restart",
                                 "the clock jumped back: forgets the road of the last clouds"));
      detector_.reset();
    }
    const StereoObjects objects = objectsOf(cloud);
    show(objects);
    auto array = boost::make_shared<ObjectArray>(toMessage(objects.list, options_.frames.base));
    monitor_.processed({cloud.stamp, watch.seconds()});
    return array;
  } catch (const InputError& error) {
    monitor_.dropped(error);
    return nullptr;
  }
}

StereoObjects StereoObjectsStage::objectsOf(const StereoCloud& cloud) {
  try {
    return detector_.detect(cloud);
  } catch (const std::invalid_argument& error) {
    throw InputError("bad_camera", error.what());
  }
}

void StereoObjectsStage::show(const StereoObjects& objects) {
  monitor_.figure("objects", static_cast<double>(objects.list.objects.size()));
  monitor_.figure("points of the cloud", static_cast<double>(objects.points));
  monitor_.figure("road seen, 0 or 1", objects.road_seen ? 1.0 : 0.0);
  monitor_.figure("road's height [m]", objects.road.height);
  monitor_.figure("road's slope ahead [m/m]", objects.road.slope_x);
  monitor_.figure("road's slope to the left [m/m]", objects.road.slope_y);
}

void StereoObjectsStage::connect(StagePorts& ports) {
  const auto objects = ports.out<ObjectArray>("objects/stereo");
  connectStereo(ports, *this, objects);
}

}  // namespace datmo
