// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/earth_frame_stage.h"

#include <cmath>
#include <string>

#include <boost/make_shared.hpp>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/frames.h"

namespace datmo {

namespace {

/// A receiver sends a few between two poses; more are waiting for a pose that does not come.
constexpr std::size_t kMaxWaiting = 50;

Pose2 between(const Pose2& a, const Pose2& b, double share) {
  return {a.position() + share * (b.position() - a.position()),
          a.heading() + share * normalizeAngle(b.heading() - a.heading())};
}

}  // namespace

void EarthFrameStageOptions::visit(OptionVisitor& visitor) {
  visitor.number({"fix_sigma", "m",
                  "standard deviation of a position along each axis, if the receiver does not "
                  "report it; about that of a receiver without corrections"},
                 fix_sigma, {0.001, 1000.0});
  visitor.number({"max_gap", "s", "maximum time between two poses for interpolation"}, max_gap,
                 {0.01, 10.0});
  visitor.group("input", [&] { input.visit(visitor); });
  visitor.group("filter", [&] { filter.visit(visitor); });
}

EarthFrameStage::EarthFrameStage(const Checked<EarthFrameStageOptions>& options,
                                 const TransformBuffer& transforms, StageMonitor& monitor)
    : options_(*options),
      transforms_(transforms),
      monitor_(monitor),
      runner_(monitor, options->input, "forgets the map's pose on the earth", [this] { reset(); }),
      filter_(options->filter) {}

void EarthFrameStage::reset() {
  filter_.reset();
  plane_.reset();
  last_pose_.reset();
  waiting_.clear();
}

void EarthFrameStage::handleFix(const sensor_msgs::NavSatFix& message) {
  runner_.serve([&] {
    const GeodeticPosition position = positionOf(message);
    const Eigen::Isometry3d antenna =
        sensorMount(transforms_.core(), options_.frames.base, message.header.frame_id);
    runner_.check("gnss", message.header.stamp);
    if (!plane_) {
      plane_.emplace(position);
    }
    EarthFix fix;
    fix.stamp = toStamp(message.header.stamp);
    fix.in_plane = plane_->toPlane(position);
    fix.covariance = covarianceOf(message, options_.fix_sigma);
    fix.antenna_in_base = antenna.translation().head<2>();
    waiting_.push_back(fix);
    if (waiting_.size() > kMaxWaiting) {
      waiting_.pop_front();
      throw InputError("no_pose", "no pose for any of the last " + std::to_string(kMaxWaiting) +
                                      " positions: expected pose of grid_slam");
    }
  });
}

EarthFrameMessagePtr EarthFrameStage::handlePose(
    const geometry_msgs::PoseWithCovarianceStamped& message) {
  return runner_.serve([&]() -> EarthFrameMessagePtr {
    runner_.check("pose/local", message.header.stamp);
    const StampedPose now{toStamp(message.header.stamp), fromMessage(message.pose)};
    while (!waiting_.empty() && waiting_.front().stamp <= now.stamp) {
      EarthFix fix = waiting_.front();
      waiting_.pop_front();
      const double gap = last_pose_ ? secondsBetween(last_pose_->stamp, now.stamp) : 0.0;
      if (!last_pose_ || fix.stamp < last_pose_->stamp || gap <= 0.0 || gap > options_.max_gap) {
        monitor_.dropped({"no_pose", "no poses before and after a position within max_gap"});
        continue;
      }
      const double share = secondsBetween(last_pose_->stamp, fix.stamp) / gap;
      fix.base_in_map = {between(last_pose_->pose.pose, now.pose.pose, share), now.pose.covariance};
      filter_.add(fix);
      report();
      runner_.processed(fix.stamp);
      last_fix_ = fix.stamp;
    }
    last_pose_ = now;
    filter_.moveTo(now.pose.pose);
    const auto map = filter_.mapInPlane(now.pose.pose);
    if (!map) {
      return nullptr;
    }
    return boost::make_shared<EarthFrameMessage>(
        toMessage(EarthFrame{last_fix_, *plane_, *map}, options_.frames.map));
  });
}

void EarthFrameStage::report() {
  const EarthFrameCounts& counts = filter_.counts();
  if (counts.gated > gated_) {
    gated_ = counts.gated;
    monitor_.warned({"far_position",
                     "a position too far from the vehicle's estimated position: rejected; starts "
                     "over after filter/restart_after in a row"});
  }
  const auto map = filter_.mapInPlane();
  if (map) {
    monitor_.announce("earth", "the map's pose on the earth is known");
    monitor_.figure("heading of the map, standard deviation [rad]",
                    std::sqrt(map->covariance(2, 2)));
  }
  monitor_.condition(
      map ? HealthLevel::kOk : HealthLevel::kDegraded,
      map ? "the map's pose on the earth is known"
          : "the map's pose on the earth is unknown until the vehicle has driven for a while");
}

void EarthFrameStage::connect(StagePorts& ports) {
  const auto frames = ports.out<EarthFrameMessage>("earth_frame");
  ports.in<sensor_msgs::NavSatFix>("gnss",
                                   [this](const auto& fix, Stamp /*now*/) { handleFix(*fix); });
  ports.in<geometry_msgs::PoseWithCovarianceStamped>(
      "pose/local",
      [this, frames](const auto& pose, Stamp /*now*/) { frames.publish(handlePose(*pose)); });
}

}  // namespace datmo
