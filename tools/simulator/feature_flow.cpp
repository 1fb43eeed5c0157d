// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/feature_flow.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "datmo_fusion/common/angle.h"

namespace datmo::simulator {

namespace {

/// Prior of the camera's motion, as the stage has it from odometry.
constexpr double kTurnSigma = 0.05;  // rad/s
constexpr double kSpeedSigma = 0.5;  // m/s

/// px; a wrong match is anywhere in a window of this half width.
constexpr double kWrongReach = 20.0;

/// Any time can be used: only the difference of two matters.
constexpr double kEpoch = 1000.0;

Stamp stampOf(double time) { return Stamp::fromSeconds(kEpoch + time); }

/// Axes of the optical frame in the vehicle's frame; the camera points `nod` (rad) too high.
Eigen::Isometry3d mountOf(const StereoCameraOptions& options, double nod) {
  Eigen::Matrix3d optical_in_base;
  optical_in_base << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  Eigen::Isometry3d mount = Eigen::Isometry3d::Identity();
  mount.linear() = Eigen::AngleAxisd(-nod, Eigen::Vector3d::UnitY()) * optical_in_base;
  mount.translation() = Eigen::Vector3d(options.mount_x, options.mount_y, options.mount_height);
  return mount;
}

/// The camera's pose according to tf.
Eigen::Isometry3d reportedMount(const StereoCameraOptions& options) {
  Eigen::Isometry3d mount = mountOf(options, 0.0);
  mount.linear() =
      Eigen::AngleAxisd(-degrees(options.mount_heading_error), Eigen::Vector3d::UnitZ()) *
      mount.linear();
  return mount;
}

Eigen::Isometry3d inSpace(const Pose2& pose) {
  Eigen::Isometry3d result(Eigen::AngleAxisd(pose.heading(), Eigen::Vector3d::UnitZ()));
  result.translation().head<2>() = pose.position();
  return result;
}

/// The position at another time of the part of an object that is at `point` now.
Point2 pointBefore(const Point2& point, std::uint32_t object, const WorldState& now,
                   const WorldState& before) {
  const auto has_id = [object](const ObjectState& state) { return state.id == object; };
  const auto is = std::find_if(now.objects.begin(), now.objects.end(), has_id);
  const auto was = std::find_if(before.objects.begin(), before.objects.end(), has_id);
  if (object == kNoObject || is == now.objects.end() || was == before.objects.end()) {
    return point;
  }
  return was->center * (is->center.inverse() * point);
}

}  // namespace

FeatureFlow::FeatureFlow(const StereoCameraOptions& options, std::uint64_t seed)
    : options_(options),
      random_(seed, "features"),
      texture_(options.weak_texture_patch, options.weak_texture_share, options.weak_road_share,
               seed) {}

std::vector<PointVelocity> FeatureFlow::measure(const World& world, double time) {
  const View now{time, random_.normal(degrees(options_.pitch_shake)), world.at(time)};
  const std::optional<View> before = std::exchange(last_, now);
  if (!before) {
    return {};
  }
  const StereoRig rig{
      {options_.focal_length, options_.focal_length, options_.middleColumn(), options_.middleRow()},
      options_.baseline,
      options_.feature_noise,
      options_.feature_noise};
  const std::vector<FeatureQuad> found = quads(world, *before, now);
  const auto motion = cameraMotion(rig, found, prior(*before, now), CameraMotionOptions());
  if (!motion) {
    return {};
  }
  return pointVelocities(rig, found, *motion, stampOf(before->time),
                         {stampOf(now.time), reportedMount(options_)});
}

std::vector<FeatureQuad> FeatureFlow::quads(const World& world, const View& before,
                                            const View& now) {
  const double corner = std::hypot(1.0, options_.middleColumn() / options_.focal_length);
  const RayCaster caster(world, now.state, cameraInWorld(now).translation().head<2>(),
                         corner * options_.max_range);
  std::vector<FeatureQuad> result;
  for (int row = 0; row < options_.image_height; row += options_.feature_spacing) {
    for (int column = 0; column < options_.image_width; column += options_.feature_spacing) {
      if (!random_.chance(options_.feature_share)) {
        continue;
      }
      const Eigen::Vector2d pixel(column + options_.feature_spacing * random_.uniform(),
                                  row + options_.feature_spacing * random_.uniform());
      if (const auto quad = quadAt(pixel, caster, before, now)) {
        result.push_back(*quad);
      }
    }
  }
  return result;
}

std::optional<FeatureQuad> FeatureFlow::quadAt(const Eigen::Vector2d& pixel,
                                               const RayCaster& caster, const View& before,
                                               const View& now) {
  const Eigen::Isometry3d camera = cameraInWorld(now);
  const double right = (pixel.x() - options_.middleColumn()) / options_.focal_length;
  const double down = (pixel.y() - options_.middleRow()) / options_.focal_length;
  const double range_per_depth = std::hypot(1.0, right);
  const double heading = now.state.base.heading() - std::atan(right);
  const Point2 origin = camera.translation().head<2>();
  const double reach = options_.max_range * range_per_depth;
  const SlopedRay line{options_.mount_height, (down - now.nod) / range_per_depth, reach};
  const std::optional<RayEnd> end = endOf(line, caster.passages(heading, reach));
  const HalfLine ray = halfLine(origin, heading);
  if (!end || texture_.isEven(*end, ray.origin + end->range * ray.direction)) {
    return std::nullopt;
  }
  const Point2 point = ray.origin + end->range * ray.direction;
  const std::uint32_t object = end->solid == nullptr ? kNoObject : end->solid->object;
  const Point2 point_before = pointBefore(point, object, now.state, before.state);
  const auto later = seen({point.x(), point.y(), end->height}, now);
  const auto earlier = seen({point_before.x(), point_before.y(), end->height}, before);
  if (!later || !earlier) {
    return std::nullopt;
  }
  FeatureQuad quad{noisy(*earlier), noisy(*later)};
  if (random_.chance(options_.wrong_feature_share)) {
    quad.earlier.pixel +=
        kWrongReach * Eigen::Vector2d(2.0 * random_.uniform() - 1.0, 2.0 * random_.uniform() - 1.0);
  }
  return quad;
}

Eigen::Isometry3d FeatureFlow::cameraInWorld(const View& view) const {
  return inSpace(view.state.base) * mountOf(options_, view.nod);
}

std::optional<StereoFeature> FeatureFlow::seen(const Eigen::Vector3d& point,
                                               const View& view) const {
  const Eigen::Vector3d in_camera = cameraInWorld(view).inverse() * point;
  if (in_camera.z() < options_.min_range || in_camera.z() > options_.max_range) {
    return std::nullopt;
  }
  const StereoFeature feature{
      {options_.middleColumn() + options_.focal_length * in_camera.x() / in_camera.z(),
       options_.middleRow() + options_.focal_length * in_camera.y() / in_camera.z()},
      options_.disparityAt(in_camera.z())};
  const bool inside = feature.pixel.x() >= feature.disparity &&
                      feature.pixel.x() < options_.image_width && feature.pixel.y() >= 0.0 &&
                      feature.pixel.y() < options_.image_height;
  return inside ? std::make_optional(feature) : std::nullopt;
}

StereoFeature FeatureFlow::noisy(StereoFeature feature) {
  // The flow of a feature is the difference of two pixels.
  const double pixel_sigma = options_.feature_noise / std::sqrt(2.0);
  feature.pixel += Eigen::Vector2d(random_.normal(pixel_sigma), random_.normal(pixel_sigma));
  feature.disparity += options_.disparity_bias + random_.normal(options_.feature_noise);
  return feature;
}

CameraMotion FeatureFlow::prior(const View& before, const View& now) const {
  const Eigen::Isometry3d mount = reportedMount(options_);
  return priorMotion({before.state.base.inverse() * now.state.base, now.time - before.time,
                      kTurnSigma, kSpeedSigma},
                     mount, mount);
}

}  // namespace datmo::simulator
