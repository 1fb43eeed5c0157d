// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/stereo_input.h"

#include <cmath>

#include "datmo_fusion/ros/convert/alignment_conversion.h"
#include "datmo_fusion/ros/frames.h"

namespace datmo {

void StereoInputOptions::visit(OptionVisitor& visitor) {
  visitor.group("camera", [&] { camera.visit(visitor); });
  visitor.group("input", [&] { input.visit(visitor); });
}

SharedKeys StereoInputOptions::cameraKeys() {
  return SharedKeys().group<StereoCameraOptions>("camera/", "stereo_camera/");
}

SharedKeys StereoInputOptions::sharedKeys() {
  return cameraKeys()
      .group<RoadPlaneOptions>("road/", "stereo_camera/road/")
      .key("effective_range", "stereo_camera/effective_range");
}

StereoInput::StereoInput(const Checked<StereoInputOptions>& options,
                         const TransformBuffer& transforms)
    : options_(*options), transforms_(transforms) {
  alignment_.covariance.setZero();
  const StereoCameraOptions& camera = options->camera;
  if (options_.camera.principle == DepthPrinciple::kActiveStereo &&
      camera.baseline < kMinBaseline) {
    throw OptionError("stereo_camera/baseline = " + std::to_string(camera.baseline) +
                      ": expected the data sheet's value in m for depth_noise: active_stereo");
  }
  if (camera.max_depth > 0.0 && camera.min_depth >= camera.max_depth) {
    throw OptionError("stereo_camera/min_depth = " + std::to_string(camera.min_depth) +
                      ": expected less than max_depth = " + std::to_string(camera.max_depth));
  }
}

void StereoInput::update(const sensor_msgs::CameraInfo& message) {
  const bool is_pair = options_.camera.principle == DepthPrinciple::kStereo;
  camera_ = is_pair ? stereoCamera(message) : depthCamera(message);
}

void StereoInput::update(const StereoAlignmentMessage& message) {
  const StereoAlignment alignment = fromMessage(message);
  if (isAligned()) {
    alignment_ = alignment;
  }
}

bool StereoInput::isRefused(Stamp stamp) const {
  // After a step of the clock it is old in the other direction.
  return !alignment_.usable &&
         std::abs(secondsBetween(alignment_.stamp, stamp)) <= options_.camera.alignment_hold;
}

StereoCloud StereoInput::cloudOf(const std_msgs::Header& header, CloudPoints& points) const {
  const std::string& optical_frame =
      options_.frames.camera.empty() ? header.frame_id : options_.frames.camera;
  if (isRefused(toStamp(header.stamp))) {
    throw InputError("camera_disagrees",
                     "a cloud that does not agree with the scanner: see stereo_alignment");
  }
  StereoCloud cloud;
  cloud.stamp = toStamp(header.stamp);
  cloud.camera = camera();
  cloud.camera_in_base = sensorMount(transforms_.core(), options_.frames.base, optical_frame);
  if (optical_frame != header.frame_id) {
    points.transform(sensorMount(transforms_.core(), optical_frame, header.frame_id));
  }
  if (alignment_[AlignmentTerm::kDisparity] != 0.0) {
    points.shiftInverseDepths(-alignment_[AlignmentTerm::kDisparity] /
                              cloud.camera.noise.disparity_at_meter);
  }
  if (options_.camera.min_depth > 0.0 || options_.camera.max_depth > 0.0) {
    points.keepDepths(options_.camera.min_depth, options_.camera.max_depth);
  }
  cloud.points = points.view();
  return cloud;
}

StereoCamera StereoInput::camera() const {
  StereoCamera camera = camera_ ? *camera_ : configuredCamera();
  if (options_.camera.principle != DepthPrinciple::kStereo) {
    const bool is_time = options_.camera.principle == DepthPrinciple::kTimeOfFlight;
    camera.baseline = is_time ? 0.0 : options_.camera.baseline;
  }
  camera.noise = depthNoise(options_.camera, camera.focal_length, camera.baseline);
  camera.disparity_offset_variance = alignment_.variance(AlignmentTerm::kDisparity);
  return camera;
}

StereoCamera StereoInput::configuredCamera() const {
  const StereoCameraOptions& known = options_.camera;
  const bool pair = options_.camera.principle == DepthPrinciple::kStereo;
  if (known.focal_length <= 0.0 || (pair && known.baseline <= 0.0)) {
    throw InputError("missing_camera_info",
                     pair ? "no info of the right camera yet: expected it, or focal_length and "
                            "baseline of the section stereo_camera"
                          : "no info of the depth camera yet: expected it, or focal_length of the "
                            "section stereo_camera");
  }
  StereoCamera camera;
  camera.focal_length = known.focal_length;
  camera.baseline = known.baseline;
  camera.right_tangent = std::tan(0.5 * known.field_of_view);
  camera.left_tangent = -camera.right_tangent;
  return camera;
}

void showRoad(bool seen, const RoadPlane& road, StageMonitor& monitor) {
  monitor.figure("road seen, 0 or 1", seen ? 1.0 : 0.0);
  monitor.figure("road's height [m]", road.height);
  monitor.figure("road's slope ahead [m/m]", road.slope_x);
  monitor.figure("road's slope to the left [m/m]", road.slope_y);
}

}  // namespace datmo
