// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/risk_stage.h"

#include <cmath>
#include <utility>

#include <boost/make_shared.hpp>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/convert/road_conversion.h"
#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo {

namespace {

/// Where the map knows an obstacle, m, map frame. What the map does not know yet may be a road user
/// that has just come into view: it is a risk once it is a track, or map.
std::vector<Point2> standingPoints(const LabeledScan& scan) {
  std::vector<Point2> points;
  for (const ScanPoint& point : scan.points) {
    if (point.state == PointState::kStatic) {
      points.push_back(scan.base_in_map.pose * point.position);
    }
  }
  return points;
}

}  // namespace

void RiskStageOptions::visit(OptionVisitor& visitor) {
  visitor.group("input", [&] { input.visit(visitor); });
  visitor.toggle({"road_borders", "",
                  "the host is expected to follow the borders of the road; set by the launch "
                  "file's switch"},
                 road_borders);
  visitor.number({"border_age", "s", "borders older than this are not used"}, border_age,
                 {0.0, 60.0});
  visitor.group("host_state", [&] { host_state.visit(visitor); });
  risk.visit(visitor);
}

SharedKeys RiskStageOptions::sharedKeys() {
  return SharedKeys().group<HostVehicleOptions>("vehicle/", "vehicle/");
}

RiskStage::RiskStage(const Checked<RiskStageOptions>& options, StageMonitor& monitor)
    : options_(*options),
      monitor_(monitor),
      assessor_(options->risk),
      runner_(monitor, options->input, "starts over", [this] { reset(); }),
      host_(options->host_state, options->motion, options->frames, options->risk.vehicle, runner_) {
}

void RiskStage::reset() {
  assessor_.reset();
  host_.reset();
  map_frame_.clear();
  standing_.clear();
  road_.reset();
}

void RiskStage::handleLabeledScan(const LabeledScanMessage& message) {
  runner_.serve([&] {
    const LabeledScan scan = fromMessage(message);
    runner_.check("labeled_scan", message.header.stamp);
    map_frame_ = message.map_frame;
    standing_ = standingPoints(scan);
    host_.update(scan);
  });
}

void RiskStage::handleOdometry(const nav_msgs::Odometry& message) {
  runner_.serve([&] { host_.update(message); });
}

void RiskStage::handleSteering(const sensor_msgs::JointState& message) {
  runner_.serve([&] { host_.update(message); });
}

void RiskStage::handleAcceleration(const geometry_msgs::AccelWithCovarianceStamped& message) {
  runner_.serve([&] { host_.update(message); });
}

void RiskStage::handleRoadBorders(const RoadBorders& message) {
  runner_.serve([&] {
    RoadModel road = fromMessage(message);
    runner_.check("road_borders", message.header.stamp);
    road_ = std::move(road);
    road_frame_ = message.header.frame_id;
  });
}

std::optional<RoadModel> RiskStage::roadAt(Stamp stamp) {
  if (!options_.road_borders || !road_) {
    return std::nullopt;
  }
  if (road_frame_ != map_frame_ ||
      std::abs(secondsBetween(road_->stamp, stamp)) > options_.border_age) {
    monitor_.warned(
        {"old_borders", "borders of the road in '" + road_frame_ +
                            "', from another time or in another frame than the "
                            "tracks: expected '" +
                            map_frame_ +
                            "' within border_age; assumes that the host keeps its steering angle"});
    return std::nullopt;
  }
  return road_;
}

RiskArrayPtr RiskStage::handleTracks(const TrackArray& message) {
  return runner_.serve([&] {
    runner_.check("tracks", message.header.stamp);
    RiskInput input;
    input.tracks = fromMessage(message);
    input.stamp = input.tracks.stamp;
    input.host = host_.at(input.stamp);
    if (message.header.frame_id != map_frame_) {
      throw InputError("wrong_frame", "tracks in '" + message.header.frame_id + "': expected '" +
                                          map_frame_ + "', the map of labeled_scan");
    }
    if (options_.motion.hasSpeed() && !host_.hasOdometry(input.stamp)) {
      monitor_.warned({"no_odometry",
                       "no odometry near the tracks: the host's speed is taken from "
                       "its poses"});
    }
    input.standing = standing_;
    input.road = roadAt(input.stamp);
    const RiskReport result = assessor_.assess(input);
    report(result);
    runner_.processed(input.stamp);
    return boost::make_shared<RiskArray>(toMessage(result, message.header.frame_id));
  });
}

void RiskStage::report(const RiskReport& report) {
  const auto warn = [this](std::size_t count, const char* reason, const std::string& text) {
    if (count > 0) {
      monitor_.warned({reason, std::to_string(count) + " " + text});
    }
  };
  warn(report.counts.rejected, "bad_track",
       "bad tracks: expected finite numbers in range, a covariance that is positive definite, and "
       "an id of at least 1; no risk is assessed for them");
  warn(report.counts.over_budget, "many_tracks",
       "tracks too many: expected at most max_objects; only the most certain ones have a risk");
  monitor_.figure("level, 0 (none) to 3 (imminent)", static_cast<double>(report.level));
  monitor_.figure("objects assessed", static_cast<double>(report.objects.size()));
  // A road user behind a parked car is followed for a while unseen: nothing is wrong with that.
  monitor_.figure("objects not seen for max_silence", static_cast<double>(report.counts.old));
  monitor_.figure("objects out of reach", static_cast<double>(report.counts.unreachable));
  if (report.level >= RiskLevel::kWarning) {
    monitor_.announce("warning", "first warning: " + report.reason);
  }
}

void RiskStage::connect(StagePorts& ports) {
  const auto risks = ports.out<RiskArray>("risks");
  if (options_.motion.hasSpeed()) {
    ports.in<nav_msgs::Odometry>(
        options_.motion.odometryTopic(),
        [this](const auto& odometry, Stamp /*now*/) { handleOdometry(*odometry); });
  }
  ports.optionalIn<sensor_msgs::JointState>(
      "steering", [this](const auto& steering, Stamp /*now*/) { handleSteering(*steering); });
  ports.optionalIn<geometry_msgs::AccelWithCovarianceStamped>(
      "acceleration",
      [this](const auto& acceleration, Stamp /*now*/) { handleAcceleration(*acceleration); });
  if (options_.road_borders) {
    ports.in<RoadBorders>("road_borders", [this](const auto& borders, Stamp /*now*/) {
      handleRoadBorders(*borders);
    });
  }
  ports.in<LabeledScanMessage>(
      "labeled_scan", [this](const auto& scan, Stamp /*now*/) { handleLabeledScan(*scan); });
  ports.in<TrackArray>("tracks", [this, risks](const auto& tracks, Stamp /*now*/) {
    risks.publish(handleTracks(*tracks));
  });
}

}  // namespace datmo
