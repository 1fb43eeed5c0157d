// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/cloud_to_scan_stage.h"

#include <cmath>

#include <boost/make_shared.hpp>
#include <tf2_msgs/TFMessage.h>

#include "datmo_fusion/ros/frames.h"
#include "datmo_fusion/ros/transform_topics.h"

namespace datmo {

void CloudToScanStageOptions::visit(OptionVisitor& visitor) {
  visitor.text({"scan_frame", "",
                "frame of the scan; the stage publishes frames/base -> scan_frame, below the lidar "
                "in the middle of the band: no other node may publish it"},
               scan_frame, {});
  visitMaxSweep(visitor, max_sweep);
  visitor.group("input", [&] { input.visit(visitor); });
  scan.visit(visitor);
}

SharedKeys CloudToScanStageOptions::sharedKeys() {
  return SharedKeys().group<OwnVehicleOptions>("vehicle/", "vehicle/own_points/");
}

CloudToScanStage::CloudToScanStage(const Checked<CloudToScanStageOptions>& options,
                                   const TransformBuffer& transforms, StageMonitor& monitor)
    : options_(*options),
      transforms_(transforms),
      monitor_(monitor),
      model_(options->scan),
      runner_(monitor, options->input, "starts over") {
  if (options->scan_frame.empty() || options->scan_frame == options->frames.base) {
    throw OptionError("scan_frame = '" + options->scan_frame +
                      "': expected a name other than that of the vehicle's frame, '" +
                      options->frames.base + "'");
  }
  options_.scan_frame = options->frames.prefix + options->scan_frame;
}

std::optional<CloudToScanOutput> CloudToScanStage::handleCloud(
    const sensor_msgs::PointCloud2& message) {
  return runner_.serve([&] {
    ConvertedCloud converted = toLidarCloud(message, options_.max_sweep);
    LidarCloud& cloud = converted.cloud;
    cloud.lidar_in_base =
        sensorMount(transforms_.core(), options_.frames.base, message.header.frame_id);
    runner_.check("cloud", message.header.stamp);
    const PlanarScan scan = model_.scan(cloud);
    warnOf(converted, scan);
    show(converted, scan);
    CloudToScanOutput output{toMessage(scan, message.header.stamp),
                             newMount(cloud.lidar_in_base, message.header.stamp)};
    runner_.processed(toStamp(output.scan->header.stamp));
    return std::make_optional(output);
  });
}

void CloudToScanStage::warnOf(const ConvertedCloud& converted, const PlanarScan& scan) {
  if (converted.unusable_times) {
    monitor_.warned(*converted.unusable_times);
  }
  if (!converted.cloud.times.empty() && scan.beam_time == 0.0 && !scan.sweep_ends_inside) {
    monitor_.warned(
        InputError("uneven_point_times", "the points' times (field " + converted.time_field +
                                             ") are not those of one uniform rotation: assumes "
                                             "that all beams were measured at once"));
  }
  if (scan.sweep_ends_inside) {
    monitor_.warned(InputError(
        "sweep_ends_inside",
        "the lidar's rotation ends within field_of_view: assumes that all beams were measured at "
        "once; expected a full turn of 6.28319 rad, or a narrower field of view"));
  }
  if (options_.scan.ground.estimate && !scan.ground.seen) {
    monitor_.warned(InputError("no_ground", "no ground plane found: uses z = 0 of " +
                                                options_.frames.base + " as the ground"));
  }
}

void CloudToScanStage::show(const ConvertedCloud& converted, const PlanarScan& scan) {
  monitor_.figure("points of the cloud", static_cast<double>(converted.cloud.points->size()));
  monitor_.figure("points that are not finite", static_cast<double>(converted.holes));
  monitor_.figure("points of the own vehicle", static_cast<double>(scan.own_points));
  monitor_.figure("points in the band", static_cast<double>(scan.band_points));
  monitor_.figure("blind beams", static_cast<double>(scan.blind_beams));
  monitor_.figure("ground seen, 0 or 1", scan.ground.seen ? 1.0 : 0.0);
  monitor_.figure("ground's height [m]", scan.ground.plane.height);
  monitor_.figure("ground's slope ahead [m/m]", scan.ground.plane.slope_x);
  monitor_.figure("ground's slope to the left [m/m]", scan.ground.plane.slope_y);
}

sensor_msgs::LaserScanPtr CloudToScanStage::toMessage(const PlanarScan& scan,
                                                      const ros::Time& stamp) const {
  auto message = boost::make_shared<sensor_msgs::LaserScan>();
  message->header.stamp = stamp + ros::Duration(scan.first_time);
  message->header.frame_id = options_.scan_frame;
  message->angle_min = static_cast<float>(scan.first_bearing);
  message->angle_increment = static_cast<float>(scan.beam_spacing);
  message->angle_max = static_cast<float>(
      scan.first_bearing + scan.beam_spacing * static_cast<double>(scan.ranges.size() - 1));
  message->time_increment = static_cast<float>(scan.beam_time);
  message->range_min = static_cast<float>(options_.scan.min_range);
  message->range_max = static_cast<float>(options_.scan.max_range);
  message->ranges = scan.ranges;
  return message;
}

std::optional<geometry_msgs::TransformStamped> CloudToScanStage::newMount(
    const Eigen::Isometry3d& lidar_in_base, const ros::Time& stamp) {
  Eigen::Vector3d mount = lidar_in_base.translation();
  mount.z() = model_.height();
  if (mount_ && *mount_ == mount) {
    return std::nullopt;
  }
  mount_ = mount;
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = stamp;
  transform.header.frame_id = options_.frames.base;
  transform.child_frame_id = options_.scan_frame;
  transform.transform.translation.x = mount.x();
  transform.transform.translation.y = mount.y();
  transform.transform.translation.z = mount.z();
  transform.transform.rotation.w = 1.0;
  return transform;
}

void CloudToScanStage::connect(StagePorts& ports) {
  const auto mounts = ports.out<tf2_msgs::TFMessage>(kStaticTransformTopic, true);
  const auto scans = ports.out<sensor_msgs::LaserScan>("scan");
  ports.in<sensor_msgs::PointCloud2>("cloud", [=](const auto& cloud, Stamp /*now*/) {
    const auto output = handleCloud(*cloud);
    if (output && output->mount) {
      const auto mount = boost::make_shared<tf2_msgs::TFMessage>();
      mount->transforms = {*output->mount};
      mounts.publish(mount);
    }
    if (output) {
      scans.publish(output->scan);
    }
  });
}

}  // namespace datmo
