// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/stereo_camera.h"

#include <cmath>
#include <string>

#include "simulator/matching_faults.h"

namespace datmo::simulator {

namespace {

void check(const StereoCameraOptions& options) {
  checkOptions(options);
  if (options.min_range >= options.max_range) {
    throw OptionError("stereo/min_range = " + std::to_string(options.min_range) +
                      ": expected less than stereo/max_range, " +
                      std::to_string(options.max_range) + " m");
  }
}

/// Number of `pixels` that are evaluated, the first of each step.
int count(int pixels, int step) { return (pixels + step - 1) / step; }

}  // namespace

StereoCamera::StereoCamera(const StereoCameraOptions& options, std::uint64_t seed)
    : options_(options),
      random_(seed, "stereo"),
      texture_(options.weak_texture_patch, options.weak_texture_share, options.weak_road_share,
               seed) {
  check(options_);
}

Viewpoint StereoCamera::viewpoint() const {
  const double half_field = std::atan(0.5 * options_.image_width / options_.focal_length);
  return {"stereo", Pose2(options_.mount_x, options_.mount_y, 0.0), options_.mount_height,
          2.0 * half_field, std::min(options_.effective_range, options_.max_range)};
}

StereoPoints StereoCamera::measure(const World& world, double time) {
  const double nod = random_.normal(degrees(options_.pitch_shake));
  DisparityImage image = look(world, world.at(time), nod);
  removeHidden(image);
  mixEdges(image, options_.edge_width, options_.edge_mixing, random_);
  addNoise(image, options_.disparity_noise, options_.noise_common_share, options_.noise_patch,
           random_);
  addOutliers(image, options_.outlier_share, options_.outlier_patch,
              options_.disparityAt(options_.max_range), options_.disparityAt(options_.min_range),
              random_);
  return {time, pointsOf(image)};
}

/// `nod`: rad, upwards.
DisparityImage StereoCamera::look(const World& world, const WorldState& state, double nod) const {
  DisparityImage image;
  image.columns = count(options_.image_width, options_.column_step);
  image.rows = count(options_.image_height, options_.row_step);
  image.column_step = options_.column_step;
  image.row_step = options_.row_step;
  image.seen.assign(rowMajorSize(image.columns, image.rows), kNoDisparity);
  image.measured = image.seen;
  const Pose2 camera = state.base * viewpoint().sensor_in_base;
  const double corner = std::hypot(1.0, options_.middleColumn() / options_.focal_length);
  const RayCaster caster(world, state, camera.position(), corner * options_.max_range);
  for (int column = 0; column < image.columns; ++column) {
    lookAlongColumn(caster, camera, column, nod, image);
  }
  return image;
}

/// An image column is in one vertical plane, because the cameras are level: one ray over the ground
/// finds the solids in it, then each row is a line of sight in this plane. A nod shifts the rows up
/// or down, to first order.
void StereoCamera::lookAlongColumn(const RayCaster& caster, const Pose2& camera, int column,
                                   double nod, DisparityImage& image) const {
  const double right =
      (column * options_.column_step - options_.middleColumn()) / options_.focal_length;
  const double range_per_depth = std::hypot(1.0, right);
  const double heading = camera.heading() - std::atan(right);
  const double reach = options_.max_range * range_per_depth;
  const std::vector<Passage> passages = caster.passages(heading, reach);
  const HalfLine ray = halfLine(camera.position(), heading);
  for (int row = 0; row < image.rows; ++row) {
    const double down = (row * options_.row_step - options_.middleRow()) / options_.focal_length;
    const SlopedRay line{options_.mount_height, (down - nod) / range_per_depth, reach};
    const std::optional<RayEnd> end = endOf(line, passages);
    if (!end) {
      continue;
    }
    const std::size_t slot = image.slot(column, row);
    image.seen[slot] = options_.disparityAt(end->range / range_per_depth);
    if (!texture_.isEven(*end, ray.origin + end->range * ray.direction)) {
      image.measured[slot] = image.seen[slot];
    }
  }
}

std::vector<Eigen::Vector3f> StereoCamera::pointsOf(const DisparityImage& image) const {
  const double min = options_.disparityAt(options_.max_range);
  const double max = options_.disparityAt(options_.min_range);
  std::vector<Eigen::Vector3f> points;
  for (int row = 0; row < image.rows; ++row) {
    const double down = (row * options_.row_step - options_.middleRow()) / options_.focal_length;
    for (int column = 0; column < image.columns; ++column) {
      const double disparity = image.measured[image.slot(column, row)];
      const double biased = disparity + options_.disparity_bias;
      if (disparity < min || disparity > max || biased <= 0.0) {
        continue;
      }
      const double right =
          (column * options_.column_step - options_.middleColumn()) / options_.focal_length;
      const double depth = options_.depthAt(biased);
      points.push_back((depth * Eigen::Vector3d(right, down, 1.0)).cast<float>());
    }
  }
  return points;
}

}  // namespace datmo::simulator
