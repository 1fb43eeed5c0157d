#include "datmo_fusion/ros/stereo_input.h"

#include <cmath>

#include "datmo_fusion/ros/frames.h"

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

void StereoInputOptions::visit(OptionVisitor& visitor) {
  visitor.group("camera", [&] { camera.visit(visitor); });
  visitor.group("input", [&] { input.visit(visitor); });
}

StereoInput::StereoInput(const StereoInputOptions& options, const TransformBuffer& transforms)
    : options_(options), transforms_(transforms), stamps_(options.input.restart_after) {
  checkOptions(options);
}

StereoCloud StereoInput::cloudOf(const std_msgs::Header& header, CloudPoints& points) const {
  const std::string& optical_frame =
      options_.frames.camera.empty() ? header.frame_id : options_.frames.camera;
  StereoCloud cloud;
  cloud.stamp = toStamp(header.stamp);
  cloud.camera = camera();
  cloud.camera_in_base = sensorMount(transforms_.core(), options_.frames.base, optical_frame);
  if (optical_frame != header.frame_id) {
    points.transform(sensorMount(transforms_.core(), optical_frame, header.frame_id));
  }
  cloud.points = points.view();
  return cloud;
}

StereoCamera StereoInput::camera() const {
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

}  // namespace datmo
