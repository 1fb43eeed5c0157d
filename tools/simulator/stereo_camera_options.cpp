// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/stereo_camera.h"

namespace datmo::simulator {

namespace {

void visitMount(StereoCameraOptions& o, OptionVisitor& visitor) {
  visitor.toggle({"enabled", "", "the vehicle has a stereo camera"}, o.enabled);
  visitor.number({"mount_x", "m",
                  "cameras ahead of the rear axle; behind the windscreen (thesis fig. 1.4), value "
                  "assumed"},
                 o.mount_x, {-10.0, 10.0});
  visitor.number({"mount_y", "m", "left camera left of the vehicle's middle; half of the baseline"},
                 o.mount_y, {-3.0, 3.0});
  visitor.number({"mount_height", "m", "cameras above the road; assumed"}, o.mount_height,
                 {0.05, 5.0});
  visitor.number({"mount_heading_error", "deg",
                  "rotation of the cameras to the left that is not on tf: a wrong mount"},
                 o.mount_heading_error, {-20.0, 20.0});
  visitor.number(
      {"stamp_error", "s", "delay of the stamps of clouds after their images, and of the clouds"},
      o.stamp_error, {0.0, 2.0});
  visitor.number({"baseline", "m", "from the left camera to the right one; thesis 1.3.3: 340 mm"},
                 o.baseline, {0.01, 5.0});
}

void visitImages(StereoCameraOptions& o, OptionVisitor& visitor) {
  constexpr double kMaxPixels = 4096.0;
  visitor.number({"rate", "Hz", "pairs of images; thesis 1.3.3: about 12"}, o.rate, {0.1, 100.0});
  visitor.number({"latency", "s", "from a pair's exposure, its stamp, to its points; assumed"},
                 o.latency, {0.0, 1.0});
  visitor.integer({"image_width", "px", "of the rectified and down-sampled images; assumed"},
                  o.image_width, {16.0, kMaxPixels});
  visitor.integer({"image_height", "px",
                   "of these images: cropped to the view ahead, the road from 4 m on; assumed"},
                  o.image_height, {16.0, kMaxPixels});
  visitor.number({"focal_length", "px", "of these images: 68 deg from side to side; assumed"},
                 o.focal_length, {10.0, 10000.0});
  visitor.integer(
      {"column_step", "px", "number of columns per point: fewer points make a smaller bag"},
      o.column_step, {1.0, 64.0});
  visitor.integer({"row_step", "px", "number of rows per point"}, o.row_step, {1.0, 64.0});
  visitor.number({"min_range", "m", "depth of the nearest points; assumed"}, o.min_range,
                 {0.1, 100.0});
  visitor.number({"max_range", "m", "depth of the farthest points; assumed"}, o.max_range,
                 {1.0, 1000.0});
  visitor.number(
      {"effective_range", "m",
       "objects farther away do not count as visible in the ground truth; thesis 3.3.3: 36"},
      o.effective_range, {1.0, 1000.0});
}

void visitMatching(StereoCameraOptions& o, OptionVisitor& visitor) {
  visitor.number(
      {"disparity_noise", "px", "standard deviation: two of them are 5 m at 36 m (thesis 3.3.3)"},
      o.disparity_noise, {0.0, 10.0});
  visitor.number({"disparity_bias", "px",
                  "added to all disparities, as by a calibration that has aged; 0: none"},
                 o.disparity_bias, {-5.0, 5.0});
  visitor.number({"noise_common_share", "1",
                  "share of the noise's variance that neighbors have in common, as matching by "
                  "windows or paths makes it; assumed"},
                 o.noise_common_share, {0.0, 1.0});
  visitor.integer({"noise_patch", "px", "over which noise is common; assumed"}, o.noise_patch,
                  {1.0, 512.0});
  visitor.number({"weak_texture_patch", "m", "size of a patch without texture; assumed"},
                 o.weak_texture_patch, {0.01, 100.0});
  visitor.number(
      {"weak_texture_share", "1", "share of such patches on objects: no points there; assumed"},
      o.weak_texture_share, {0.0, 1.0});
  visitor.number({"weak_road_share", "1", "share of such patches on the road; assumed"},
                 o.weak_road_share, {0.0, 1.0});
  visitor.integer(
      {"edge_width", "px",
       "within this distance of a nearer object the background's disparity may be wrong; assumed"},
      o.edge_width, {0.0, 64.0});
  visitor.number({"edge_mixing", "1", "probability that it is, and lies between the two; assumed"},
                 o.edge_mixing, {0.0, 1.0});
  visitor.number({"outlier_share", "1", "share of wrong matches, at any depth; assumed"},
                 o.outlier_share, {0.0, 1.0});
  visitor.integer({"outlier_patch", "px", "size of a wrong match; assumed"}, o.outlier_patch,
                  {1.0, 512.0});
  visitor.number({"pitch_shake", "deg",
                  "standard deviation of the vehicle's pitch, for which the points are not "
                  "corrected; as the scanner's"},
                 o.pitch_shake, {0.0, 5.0});
}

void visitFeatures(StereoCameraOptions& o, OptionVisitor& visitor) {
  visitor.toggle({"features", "", "corners are tracked from image to image: points with velocity"},
                 o.features);
  visitor.integer({"feature_spacing", "px", "minimum distance between two corners"},
                  o.feature_spacing, {1.0, 100.0});
  visitor.number({"feature_share", "1",
                  "share of textured squares of this size with a corner that is found in all four "
                  "images: 4 in 1000 px^2 on the cyclist of KITTI's drive 0005, 5 on its vehicles, "
                  "in images scaled to the demonstrator's focal length"},
                 o.feature_share, {0.0, 1.0});
  visitor.number({"feature_noise", "px",
                  "standard deviation of flow (per axis) and disparity of a corner; medians on "
                  "KITTI's drive 0005: 0.10 and 0.09 px"},
                 o.feature_noise, {0.01, 5.0});
  visitor.number({"wrong_feature_share", "1", "share of corners that are matched wrongly; assumed"},
                 o.wrong_feature_share, {0.0, 1.0});
}

}  // namespace

void StereoCameraOptions::visit(OptionVisitor& visitor) {
  visitMount(*this, visitor);
  visitImages(*this, visitor);
  visitMatching(*this, visitor);
  visitFeatures(*this, visitor);
}

}  // namespace datmo::simulator
