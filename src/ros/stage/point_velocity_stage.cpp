// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/point_velocity_stage.h"

#include <exception>
#include <string>
#include <utility>

#include <sensor_msgs/image_encodings.h>

#include "datmo_fusion/ros/convert/stereo_image_conversion.h"
#include "datmo_fusion/ros/convert/velocity_conversion.h"
#include "datmo_fusion/ros/frames.h"
#include "datmo_fusion/ros/stage/stage_inputs.h"

namespace datmo {

namespace {

/// m/s; usual maximum speed of a vehicle without odometry.
constexpr double kUnknownSpeed = 20.0;

/// rad/s, the same for its turn rate.
constexpr double kUnknownTurn = 0.5;

StereoRig rigOf(const image_geometry::StereoCameraModel& model,
                const PointVelocityStageOptions& options) {
  const image_geometry::PinholeCameraModel& left = model.left();
  return {{left.fx(), left.fy(), left.cx(), left.cy()},
          model.baseline(),
          options.flow_sigma,
          options.disparity_sigma};
}

}  // namespace

void PointVelocityStageOptions::visit(OptionVisitor& visitor) {
  visitor.group("input", [&] { input.visit(visitor); });
  visitor.group("features", [&] { features.visit(visitor); });
  visitor.group("camera_motion", [&] { camera_motion.visit(visitor); });
  visitor.toggle({"rectified", "",
                  "the images are rectified already; false: rectify them by their calibration"},
                 rectified);
  sync.visit(visitor);
  constexpr Bounds kPixels{0.01, 5.0};
  visitor.number(
      {"flow_sigma", "px",
       "standard deviation of a feature's motion from image to image, per axis; measured on "
       "KITTI's images: the median residual of stationary features is 0.10 px"},
      flow_sigma, kPixels);
  visitor.number({"disparity_sigma", "px", "the same of a feature's disparity: 0.09 px"},
                 disparity_sigma, kPixels);
  visitor.number({"turn_sigma", "rad/s",
                  "standard deviation of the camera's rotation about each axis beyond the "
                  "vehicle's odometry: pitch and roll of its body"},
                 turn_sigma, {1e-4, 1.0});
  visitor.number({"speed_sigma", "m/s", "the same of its velocity along each axis"}, speed_sigma,
                 {1e-3, 10.0});
  visitor.number({"max_interval", "s",
                  "maximum time between two pairs; features are not followed over a longer gap"},
                 max_interval, {0.02, 5.0});
}

SharedKeys PointVelocityStageOptions::sharedKeys() {
  return SharedKeys()
      .key("approximate_sync", "stereo_image_proc/approximate_sync")
      .key("pair_tolerance", "stereo_image_proc/pair_tolerance");
}

PointVelocityStage::PointVelocityStage(const Checked<PointVelocityStageOptions>& options,
                                       const TransformBuffer& transforms, StageMonitor& monitor)
    : options_(*options),
      transforms_(transforms),
      monitor_(monitor),
      runner_(monitor, options->input, "forgets the last images", [this] { reset(); }),
      motion_(options->motion, options->frames, runner_),
      pairs_(options->sync.pairTolerance()),
      matcher_(options->features) {}

void PointVelocityStage::reset() {
  motion_.reset();
  pairs_.clear();
  matcher_.reset();
  last_.reset();
}

void PointVelocityStage::handleOdometry(const nav_msgs::Odometry& message) {
  runner_.serve([&] { motion_.update(message); });
}

void PointVelocityStage::handlePose(const geometry_msgs::PoseWithCovarianceStamped& message) {
  runner_.serve([&] { motion_.update(message); });
}

sensor_msgs::PointCloud2Ptr PointVelocityStage::handleImage(
    StereoSide side, const sensor_msgs::ImageConstPtr& image) {
  return runner_.serve([&] {
    checkImage(*image);
    runner_.check(side == StereoSide::kLeft ? "left/image" : "right/image", image->header.stamp);
    return serve(pairs_.handleImage(side, image));
  });
}

sensor_msgs::PointCloud2Ptr PointVelocityStage::handleInfo(
    StereoSide side, const sensor_msgs::CameraInfoConstPtr& info) {
  return runner_.serve([&] {
    // Whichever message comes first detects that the clock has jumped back; it is stored only after
    // the reset, which so drops nothing of the new run.
    runner_.check(side == StereoSide::kLeft ? "left/camera_info" : "right/camera_info",
                  info->header.stamp);
    return serve(pairs_.handleInfo(side, info));
  });
}

sensor_msgs::PointCloud2Ptr PointVelocityStage::serve(const std::optional<StereoPair>& pair) {
  if (pairs_.unpaired() > std::exchange(unpaired_, pairs_.unpaired())) {
    monitor_.warned(unpairedImage());
  }
  if (!pair) {
    return nullptr;
  }
  try {
    const std::vector<PointVelocity> points = velocitiesOf(*pair);
    monitor_.figure("points with velocity", static_cast<double>(points.size()));
    runner_.processed(pair->left.stamp);
    return toMessage(points, pair->left.stamp, options_.frames.base);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {  // from OpenCV, cv_bridge and image_geometry
    throw InputError("bad_images", std::string("images that cannot be matched: ") + error.what());
  }
}

std::vector<PointVelocity> PointVelocityStage::velocitiesOf(const StereoPair& pair) {
  const image_geometry::StereoCameraModel model = stereoModel(pair);
  const auto gray = [&](const CameraFrame& frame, const auto& camera) {
    return rectifiedImage(frame.image, sensor_msgs::image_encodings::MONO8, camera,
                          options_.rectified);
  };
  const std::string& frame =
      options_.frames.camera.empty() ? pair.left.image->header.frame_id : options_.frames.camera;
  const LastPair now{pair.left.stamp, sensorMount(transforms_.core(), options_.frames.base, frame)};
  // From here on it is uncertain which images the matcher holds: unless everything succeeds, no
  // stamp is kept, because a wrong one would scale all velocities.
  const std::optional<LastPair> last = std::exchange(last_, std::nullopt);
  const std::vector<FeatureQuad> quads =
      matcher_.match(gray(pair.left, model.left()), gray(pair.right, model.right()));
  last_ = now;
  if (!last || secondsBetween(last->stamp, now.stamp) > options_.max_interval) {
    return {};
  }
  const StereoRig rig = rigOf(model, options_);
  const std::optional<CameraMotion> motion =
      cameraMotion(rig, quads, priorSince(*last, now), options_.camera_motion);
  monitor_.figure("features", static_cast<double>(quads.size()));
  monitor_.figure("camera's motion found, 0 or 1", motion ? 1.0 : 0.0);
  if (!motion) {
    return {};
  }
  return pointVelocities(rig, quads, *motion, last->stamp, {now.stamp, now.camera_in_base});
}

CameraMotion PointVelocityStage::priorSince(const LastPair& last, const LastPair& now) const {
  const std::optional<Pose2> moved = motion_.between(last.stamp, now.stamp);
  return priorMotion(
      {moved.value_or(Pose2()), secondsBetween(last.stamp, now.stamp),
       moved ? options_.turn_sigma : kUnknownTurn, moved ? options_.speed_sigma : kUnknownSpeed},
      last.camera_in_base, now.camera_in_base);
}

void PointVelocityStage::connect(StagePorts& ports) {
  connectMotion(ports, options_.motion, *this);
  connectImages(ports, *this, ports.out<sensor_msgs::PointCloud2>("point_velocities"));
}

}  // namespace datmo
