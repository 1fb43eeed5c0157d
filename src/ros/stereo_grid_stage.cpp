#include "datmo_fusion/ros/stereo_grid_stage.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include <boost/make_shared.hpp>

#include "datmo_fusion/ros/cloud_conversion.h"
#include "datmo_fusion/ros/frames.h"
#include "datmo_fusion/ros/grid_conversion.h"

namespace datmo {

void StereoCameraOptions::visit(OptionVisitor& visitor) {
  visitor.number({"focal_length", "px", "until a camera info has come; 0: not known"}, focal_length,
                 {0.0, kMostFocalLength});
  visitor.number({"baseline", "m", "until a camera info has come; 0: not known"}, baseline,
                 {0.0, kMostBaseline});
  visitor.number({"field_of_view", "rad", "from left to right, until a camera info has come"},
                 field_of_view, {degrees(5.0), degrees(150.0)});
  visitor.number({"disparity_sigma", "px",
                  "standard deviation of a disparity; at 0.25 px two standard deviations of the "
                  "demonstrator's depth are 5 m at 36 m (thesis 3.3.3)"},
                 disparity_sigma, {0.01, 10.0});
}

void StereoGridStageOptions::visit(OptionVisitor& visitor) {
  visitor.text({"base_frame", "", "frame of the vehicle, and of the grid"}, base_frame, {});
  visitor.text({"camera_frame", "",
                "optical frame of the left camera (x to the right, y down, z ahead); empty: the "
                "clouds are in it"},
               camera_frame, {});
  visitor.text({"scanner_frame", "",
                "frame of the planar scanner, whose height is where the layer of obstacles begins "
                "(thesis 3.2.2); empty: scanner_height tells it"},
               scanner_frame, {});
  visitor.number({"scanner_height", "m",
                  "the same above the vehicle's frame, where tf does not know it (thesis 3.2.2)"},
                 scanner_height, {-1.0, 3.0});
  visitor.group("camera", [&] { camera.visit(visitor); });
  visitor.group("input", [&] { input.visit(visitor); });
  grid.visit(visitor);
}

StereoGridStage::StereoGridStage(const StereoGridStageOptions& options,
                                 const TransformBuffer& transforms, StageMonitor& monitor)
    : options_(options),
      transforms_(transforms),
      monitor_(monitor),
      model_(options.grid),
      stamps_(options.input.restart_after) {
  checkOptions(options);
}

void StereoGridStage::takeCameraInfo(const sensor_msgs::CameraInfo& message) {
  try {
    camera_ = stereoCamera(message);
  } catch (const InputError& error) {
    monitor_.dropped(error);
  }
}

nav_msgs::OccupancyGridPtr StereoGridStage::takeCloud(const sensor_msgs::PointCloud2& message) {
  try {
    const Stopwatch watch;
    const std::string& frame = message.header.frame_id;
    const std::string& optical_frame =
        options_.camera_frame.empty() ? frame : options_.camera_frame;
    CloudPoints points(message);
    StereoCloud cloud;
    cloud.stamp = toStamp(message.header.stamp);
    cloud.camera = camera();
    cloud.camera_in_base = sensorMount(transforms_.core(), options_.base_frame, optical_frame);
    if (optical_frame != frame) {
      points.transform(sensorMount(transforms_.core(), optical_frame, frame));
    }
    cloud.points = points.view();
    cloud.scanner_height = scannerHeight();
    if (stamps_.check(message.header.stamp) == Arrival::kRestart) {
      monitor_.warned(InputError("clock_restart",
                                 "the clock jumped back: forgets the road of the last clouds"));
      model_.reset();
    }
    StereoGridResult result = gridOf(cloud);
    show(result);
    auto grid = boost::make_shared<nav_msgs::OccupancyGrid>(
        toMessage(std::move(result.grid), options_.base_frame));
    monitor_.processed({cloud.stamp, watch.seconds()});
    return grid;
  } catch (const InputError& error) {
    monitor_.dropped(error);
    return nullptr;
  }
}

StereoGridResult StereoGridStage::gridOf(const StereoCloud& cloud) {
  try {
    return model_.grid(cloud);
  } catch (const std::invalid_argument& error) {
    throw InputError("bad_camera", error.what());
  }
}

StereoCamera StereoGridStage::camera() const {
  const StereoCameraOptions& known = options_.camera;
  StereoCamera camera;
  if (camera_) {
    camera = *camera_;
  } else if (known.focal_length > 0.0 && known.baseline > 0.0) {
    camera.focal_length = known.focal_length;
    camera.baseline = known.baseline;
    camera.right_tangent = std::tan(0.5 * known.field_of_view);
    camera.left_tangent = -camera.right_tangent;
  } else {
    throw InputError("missing_camera_info",
                     "no info of the right camera yet: expected it, or focal_length and baseline "
                     "of the parameter group camera");
  }
  camera.disparity_sigma = known.disparity_sigma;
  return camera;
}

double StereoGridStage::scannerHeight() {
  if (options_.scanner_frame.empty()) {
    return options_.scanner_height;
  }
  try {
    return sensorMount(transforms_.core(), options_.base_frame, options_.scanner_frame)
        .translation()
        .z();
  } catch (const InputError& error) {
    monitor_.warned(InputError(error.reason(), std::string(error.what()) +
                                                   "; takes scanner_height, " +
                                                   std::to_string(options_.scanner_height) + " m"));
    return options_.scanner_height;
  }
}

void StereoGridStage::show(const StereoGridResult& result) {
  monitor_.figure("points of the cloud", static_cast<double>(result.points));
  monitor_.figure("points in the layer of obstacles", static_cast<double>(result.in_layer));
  monitor_.figure("road seen, 0 or 1", result.road_seen ? 1.0 : 0.0);
  monitor_.figure("road's height [m]", result.road.height);
  monitor_.figure("road's slope ahead [m/m]", result.road.slope_x);
  monitor_.figure("road's slope to the left [m/m]", result.road.slope_y);
}

}  // namespace datmo
