// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/mono_grid_stage.h"

#include <string>
#include <utility>

#include <boost/make_shared.hpp>

#include "datmo_fusion/fusion/sync/relative_motion.h"
#include "datmo_fusion/ros/convert/grid_conversion.h"
#include "datmo_fusion/ros/convert/image_conversion.h"
#include "datmo_fusion/ros/frames.h"
#include "datmo_fusion/ros/stage/stage_inputs.h"
#include "datmo_fusion/slam/motion_compensation.h"

namespace datmo {

void MonoGridStageOptions::visit(OptionVisitor& visitor) {
  visitor.number({"max_tilt", "rad", "a scan plane tilted by more than this causes a warning"},
                 max_tilt, {0.0, kQuarterTurn});
  visitor.number({"tolerance", "s", "maximum time between an image's exposure and its scan"},
                 tolerance, {0.0, 1.0});
  visitor.number({"max_wait", "s", "longest time that an image waits for its scan"}, max_wait,
                 {0.01, 2.0});
  exposure.visit(visitor);
  visitor.group("input", [&] { input.visit(visitor); });
  visitor.group("scan", [&] { scan.visit(visitor); });
  grid.visit(visitor);
}

SharedKeys MonoGridStageOptions::sharedKeys() {
  return SharedKeys()
      .group<ScanConversionOptions>("scan/", "scanner/")
      .key("max_tilt", "scanner/max_tilt")
      .key("beam_width", "scanner/beam_width");
}

MonoGridStage::MonoGridStage(const Checked<MonoGridStageOptions>& options,
                             const TransformBuffer& transforms, StageMonitor& monitor)
    : options_(*options),
      transforms_(transforms),
      monitor_(monitor),
      runner_(monitor, options->input, "forgets the road's colors", [this] { reset(); }),
      motion_(options->motion, options->frames, runner_),
      exposure_(options->exposure),
      model_(options->grid),
      wait_(options->tolerance, options->max_wait) {}

void MonoGridStage::reset() {
  motion_.reset();
  exposure_.reset();
  model_.reset();
  wait_.clear();
}

void MonoGridStage::handleCameraInfo(const sensor_msgs::CameraInfo& message) {
  runner_.serve([&] { camera_.update(message); });
}

template <typename Message>
void MonoGridStage::handleScan(const Message& message) {
  runner_.serve("scan", message, [&] {
    const std::string& frame = message.header.frame_id;
    const ScannerMount mount = scannerMount(transforms_.core(), options_.frames.base, frame);
    const ConvertedScan converted = toScan(message, mount, options_.scan);
    const double height =
        sensorMount(transforms_.core(), options_.frames.base, frame).translation().z();
    runner_.check("scan", message.header.stamp);
    warnOf(mount, converted);
    Scan scan = motion_.compensated(converted.scan);
    const Stamp stamp = scan.stamp;
    wait_.addMeasurement(stamp, {std::move(scan), height});
  });
}

template void MonoGridStage::handleScan(const sensor_msgs::LaserScan&);
template void MonoGridStage::handleScan(const sensor_msgs::MultiEchoLaserScan&);

void MonoGridStage::warnOf(const ScannerMount& mount, const ConvertedScan& converted) {
  for (const InputError& fault :
       faultsOf(mount, converted, options_.max_tilt, "the image is used without its depth")) {
    monitor_.warned(fault);
  }
}

void MonoGridStage::handleImage(const sensor_msgs::ImageConstPtr& message, Stamp now) {
  runner_.serve([&] {
    camera_.check(*message);
    exposure_.check(message);
    runner_.check("image", message->header.stamp);
    exposure_.accept(message);
    if (!wait_.addImage(message, now)) {
      monitor_.dropped(InputError("superseded_image",
                                  "a newer image arrived before the scan of this one: expected "
                                  "scans at the rate of the images; continues with the newer one"));
    }
  });
}

/// Throws InputError.
MonoGridStage::MountedScan MonoGridStage::scanOf(Stamp exposure) const {
  const MountedScan* nearest = wait_.nearest(exposure);
  if (nearest == nullptr) {
    throw InputError(
        "no_scan",
        "image without a scan within " + std::to_string(options_.tolerance) +
            " s of its exposure: expected one, since it bounds the evidence of the image");
  }
  const auto motion = [this](Stamp from, Stamp to) { return motion_.between(from, to); };
  const auto base = baseAt(nearest->scan.stamp, exposure, motion);
  if (!base) {
    throw InputError("no_motion",
                     "image whose scan has another stamp: expected odometry or poses that give the "
                     "vehicle's motion between the two");
  }
  return {scanAt(nearest->scan, exposure, *base), nearest->height};
}

nav_msgs::OccupancyGridPtr MonoGridStage::next(Stamp now) {
  return runner_.serve([&]() -> nav_msgs::OccupancyGridPtr {
    const sensor_msgs::ImageConstPtr image = wait_.next(now);
    return image ? gridOf(image) : nullptr;
  });
}

/// Throws InputError.
nav_msgs::OccupancyGridPtr MonoGridStage::gridOf(const sensor_msgs::ImageConstPtr& image) {
  const Stamp exposure = toStamp(image->header.stamp);
  const MountedScan seen = scanOf(exposure);
  const MountedCamera camera = camera_.mounted(*image, options_.frames, transforms_);
  const auto pixels = grayOrColor(image);
  MonoGridResult result = model_.grid(pixels->image, camera, seen.scan, seen.height);
  monitor_.figure("pixels of the road learned", static_cast<double>(result.learned));
  monitor_.figure("free cells", static_cast<double>(result.free));
  monitor_.figure("occupied cells", static_cast<double>(result.occupied));
  runner_.processed(exposure);
  return boost::make_shared<nav_msgs::OccupancyGrid>(
      toMessage(std::move(result.grid), options_.frames.base));
}

void MonoGridStage::connect(StagePorts& ports) {
  published_ = ports.out<nav_msgs::OccupancyGrid>("grids/mono");
  connectMotion(ports, options_.motion, *this);
  ports.optionalIn<sensor_msgs::CameraInfo>(
      "camera_info", [this](const auto& info, Stamp /*now*/) { handleCameraInfo(*info); });
  const auto handle_scan = [this](const auto& scan, Stamp /*now*/) { handleScan(*scan); };
  connectScan(ports, monitor_, handle_scan);
  ports.in<sensor_msgs::Image>("image",
                               [this](const auto& image, Stamp now) { handleImage(image, now); });
}

bool MonoGridStage::publishNext(Stamp now) {
  const nav_msgs::OccupancyGridPtr grid = next(now);
  published_.publish(grid);
  return grid != nullptr;
}

}  // namespace datmo
