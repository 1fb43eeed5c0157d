// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/static_points_stage.h"

#include <utility>

#include <boost/make_shared.hpp>

#include <sensor_msgs/point_cloud2_iterator.h>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/transform_topics.h"
#include "datmo_fusion/slam/static_scan.h"

namespace datmo {

namespace {

sensor_msgs::PointCloud2ConstPtr toCloud(const std::vector<Point2>& points,
                                         const std_msgs::Header& header) {
  auto cloud = boost::make_shared<sensor_msgs::PointCloud2>();
  cloud->header = header;
  sensor_msgs::PointCloud2Modifier modifier(*cloud);
  modifier.setPointCloud2FieldsByString(1, "xyz");
  modifier.resize(points.size());
  cloud->is_dense = 1U;
  if (points.empty()) {
    return cloud;  // the iterator would read the first byte
  }
  sensor_msgs::PointCloud2Iterator<float> xyz(*cloud, "x");
  for (const Point2& point : points) {
    xyz[0] = static_cast<float>(point.x());
    xyz[1] = static_cast<float>(point.y());
    xyz[2] = 0.0F;
    ++xyz;
  }
  return cloud;
}

sensor_msgs::LaserScanConstPtr toLaserScan(const ScanField& field, std::vector<float> ranges,
                                           const std_msgs::Header& header) {
  if (ranges.empty()) {
    return nullptr;
  }
  auto scan = boost::make_shared<sensor_msgs::LaserScan>();
  scan->header = header;
  scan->angle_min = static_cast<float>(field.first_bearing);
  scan->angle_increment = static_cast<float>(field.beam_spacing);
  scan->angle_max = static_cast<float>(field.first_bearing +
                                       static_cast<double>(field.beams - 1) * field.beam_spacing);
  scan->time_increment = static_cast<float>(field.beam_time);
  scan->range_min = static_cast<float>(field.min_range);
  scan->range_max = static_cast<float>(staticRange(field));
  scan->ranges = std::move(ranges);
  return scan;
}

}  // namespace

void StaticPointsStageOptions::visit(OptionVisitor& visitor) {
  visitor.text({"scan_frame", "",
                "frame of static_scan; the stage publishes frames/base -> scan_frame: no other "
                "node may publish it"},
               scan_frame, {});
  visitor.toggle({"include_unknown", "",
                  "end points in unknown space count as stationary: a navigation stack must not "
                  "drive into them",
                  Tier::kPublic},
                 include_unknown);
  visitor.group("input", [&] { input.visit(visitor); });
}

StaticPointsStage::StaticPointsStage(const Checked<StaticPointsStageOptions>& options,
                                     StageMonitor& monitor)
    : options_(*options), monitor_(monitor), runner_(monitor, options->input, "starts over") {
  if (options->scan_frame.empty() || options->scan_frame == options->frames.base) {
    throw OptionError("scan_frame = '" + options->scan_frame +
                      "': expected a name other than that of the vehicle's frame, '" +
                      options->frames.base + "'");
  }
  options_.scan_frame = options->frames.prefix + options->scan_frame;
}

std::optional<StaticPointsOutput> StaticPointsStage::handleLabeledScan(
    const LabeledScanMessage& message) {
  return runner_.serve([&] {
    const LabeledScan scan = fromMessage(message);
    runner_.check("labeled_scan", message.header.stamp);
    std_msgs::Header at_scanner = message.header;
    at_scanner.frame_id = options_.scan_frame;
    StaticPointsOutput output;
    output.points = toCloud(staticPoints(scan, options_.include_unknown), message.header);
    output.scan = toLaserScan(scan.field, staticRanges(scan, options_.include_unknown), at_scanner);
    output.mount = newMount(scan, message.header);
    monitor_.figure("static points", static_cast<double>(output.points->width));
    runner_.processed(scan.stamp);
    return std::make_optional(output);
  });
}

tf2_msgs::TFMessageConstPtr StaticPointsStage::newMount(const LabeledScan& scan,
                                                        const std_msgs::Header& header) {
  const Pose2& mount = scan.scanner_in_base;
  if (mount_ && mount_->position() == mount.position() && mount_->heading() == mount.heading()) {
    return nullptr;
  }
  mount_ = mount;
  auto message = boost::make_shared<tf2_msgs::TFMessage>();
  message->transforms = {toTransform(mount, scan.stamp, header.frame_id, options_.scan_frame)};
  return message;
}

void StaticPointsStage::connect(StagePorts& ports) {
  const auto mounts = ports.out<tf2_msgs::TFMessage>(kStaticTransformTopic, true);
  const auto points = ports.out<sensor_msgs::PointCloud2>("static_points");
  const auto scans = ports.out<sensor_msgs::LaserScan>("static_scan");
  ports.in<LabeledScanMessage>("labeled_scan", [=](const auto& labeled_scan, Stamp /*now*/) {
    if (const auto output = handleLabeledScan(*labeled_scan)) {
      mounts.publish(output->mount);
      points.publish(output->points);
      scans.publish(output->scan);
    }
  });
}

}  // namespace datmo
