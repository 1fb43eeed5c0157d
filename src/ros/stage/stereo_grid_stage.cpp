// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/stereo_grid_stage.h"

#include <stdexcept>
#include <utility>

#include <boost/make_shared.hpp>

#include "datmo_fusion/ros/convert/grid_conversion.h"
#include "datmo_fusion/ros/frames.h"
#include "datmo_fusion/ros/stage/stage_inputs.h"

namespace datmo {

void StereoGridStageOptions::visit(OptionVisitor& visitor) {
  StereoInputOptions::visit(visitor);
  visitor.number(
      {"scanner_height", "m",
       "height of the scanner above the vehicle's frame, if it is not on tf (thesis 3.2.2)",
       Tier::kPublic},
      scanner_height, {-1.0, 3.0});
  grid.visit(visitor);
}

SharedKeys StereoGridStageOptions::sharedKeys() {
  return StereoInputOptions::sharedKeys().key("min_depth", "stereo_camera/min_depth");
}

StereoGridStage::StereoGridStage(const Checked<StereoGridStageOptions>& options,
                                 const TransformBuffer& transforms, StageMonitor& monitor)
    : options_(*options),
      transforms_(transforms),
      monitor_(monitor),
      runner_(monitor, options->input, "forgets the road of the last clouds",
              [this] { model_.reset(); }),
      input_(*options, transforms),
      model_(options->grid) {}

void StereoGridStage::handleAlignment(const StereoAlignmentMessage& message) {
  runner_.serve([&] { input_.update(message); });
}

void StereoGridStage::handleCameraInfo(const sensor_msgs::CameraInfo& message) {
  runner_.serve([&] { input_.update(message); });
}

nav_msgs::OccupancyGridPtr StereoGridStage::handleCloud(const sensor_msgs::PointCloud2& message) {
  return runner_.serve("points2", message, [&] {
    CloudPoints points(message);
    StereoCloud cloud = input_.cloudOf(message.header, points);
    cloud.scanner_height = scannerHeight();
    runner_.check("points2", message.header.stamp);
    StereoGridResult result = gridOf(cloud);
    show(result);
    auto grid = boost::make_shared<nav_msgs::OccupancyGrid>(
        toMessage(std::move(result.grid), options_.frames.base));
    runner_.processed(cloud.stamp);
    return grid;
  });
}

StereoGridResult StereoGridStage::gridOf(const StereoCloud& cloud) {
  try {
    return model_.grid(cloud);
  } catch (const std::invalid_argument& error) {
    throw InputError("bad_camera", error.what());
  }
}

double StereoGridStage::scannerHeight() {
  if (options_.frames.scanner.empty()) {
    return options_.scanner_height;
  }
  try {
    return sensorMount(transforms_.core(), options_.frames.base, options_.frames.scanner)
        .translation()
        .z();
  } catch (const InputError& error) {
    monitor_.warned(InputError(error.reason(), std::string(error.what()) +
                                                   "; uses scanner_height, " +
                                                   std::to_string(options_.scanner_height) + " m"));
    return options_.scanner_height;
  }
}

void StereoGridStage::show(const StereoGridResult& result) {
  monitor_.figure("points of the cloud", static_cast<double>(result.points));
  monitor_.figure("points in the layer of obstacles", static_cast<double>(result.in_layer));
  showRoad(result.road_seen, result.road, monitor_);
}

void StereoGridStage::connect(StagePorts& ports) {
  const auto grid = ports.out<nav_msgs::OccupancyGrid>("grids/stereo");
  connectAlignment(ports, *this);
  connectStereo(ports, *this, grid);
}

}  // namespace datmo
