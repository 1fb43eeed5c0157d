// SPDX-License-Identifier: BSD-3-Clause
#include "convert/clouds_to_scans.h"

#include <algorithm>
#include <utility>

#include "command_line.h"
#include "input_bag.h"
#include "interruption.h"
#include "output_bag.h"
#include "run_bag/sensor_set.h"
#include <tf2_msgs/TFMessage.h>

#include <rosbag/view.h>
#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/ros/frame_ids.h"
#include "datmo_fusion/ros/stage/cloud_to_scan_stage.h"
#include "datmo_fusion/ros/transform_topics.h"

namespace datmo {

namespace {

constexpr char kCloud[] = "cloud";
constexpr char kScan[] = "scan";

constexpr char kDescription[] =
    "Copies a bag, and replaces each cloud of a 3D lidar on /cloud by a planar scan on /scan, as\n"
    "the nodelet cloud_to_scan does.";

constexpr char kFooter[] =
    "cloud:=TOPIC and scan:=TOPIC name other topics.\n"
    "Exit code: 0 on success; 1 for an invalid command line, yaml file or bag, and when\n"
    "interrupted; 2 when no cloud could be used. After 1 and 2 no output bag is left.";

/// When the last beam of a scan has been measured.
ros::Time endOf(const sensor_msgs::LaserScan& scan) {
  const auto steps = static_cast<double>(scan.ranges.empty() ? 0 : scan.ranges.size() - 1);
  return scan.header.stamp + ros::Duration(steps * static_cast<double>(scan.time_increment));
}

class CloudConversion {
 public:
  CloudConversion(const CloudsToScansArguments& arguments, const rosbag::Bag& input)
      : arguments_(arguments),
        input_(input),
        sensors_(arguments.config),
        options_(sensors_.options<CloudToScanStageOptions>("cloud_to_scan")),
        monitor_("cloud_to_scan"),
        transforms_(options_.input.restart_after, sensors_.shared(), monitor_),
        stage_(options_, transforms_, monitor_),
        output_(arguments.output) {}

  ConvertedClouds run() {
    takeMounts();
    for (const rosbag::MessageInstance& message : rosbag::View(input_)) {
      if (interrupted()) {
        throw std::runtime_error("interrupted");
      }
      handle(message);
    }
    if (result_.scans == 0) {
      throw NoUsableInput(arguments_.input + ": none of " + std::to_string(result_.dropped) +
                          " clouds on " + arguments_.cloud_topic + " could be used");
    }
    output_.finish();
    return result_;
  }

 private:
  /// A message with its frames as the stages expect them.
  template <typename Message>
  boost::shared_ptr<const Message> plain(const rosbag::MessageInstance& message) {
    return withPlainFrames<Message>(message.getTopic(), read<Message>(message), monitor_);
  }

  /// All of them before the first cloud, regardless of their position in the bag.
  void takeMounts() {
    for (const auto& message : rosbag::View(input_, rosbag::TopicQuery(kStaticTransformTopic))) {
      transforms_.addStatic(*plain<tf2_msgs::TFMessage>(message));
    }
  }

  void handle(const rosbag::MessageInstance& message) {
    const std::string& topic = message.getTopic();
    monitor_.setTime(toStamp(message.getTime()));
    if (topic == kTransformTopic) {
      transforms_.add(*plain<tf2_msgs::TFMessage>(message));
    }
    if (topic == arguments_.cloud_topic) {
      handleCloud(message);
    }
    if (topic != arguments_.cloud_topic || arguments_.keep_clouds) {
      output_.copy(message);
    }
  }

  void handleCloud(const rosbag::MessageInstance& message) {
    const auto scan = stage_.handleCloud(*plain<sensor_msgs::PointCloud2>(message));
    if (!scan) {
      ++result_.dropped;
      return;
    }
    ++result_.scans;
    if (scan->mount) {
      tf2_msgs::TFMessage mount;
      mount.transforms = {*scan->mount};
      output_.writeLatched(kStaticTransformTopic, message.getTime(), mount);
    }
    output_.write(arguments_.scan_topic, std::max(message.getTime(), endOf(*scan->scan)),
                  *scan->scan);
  }

  const CloudsToScansArguments& arguments_;
  const rosbag::Bag& input_;
  SensorSet sensors_;
  CloudToScanStageOptions options_;
  StageMonitor monitor_;
  TransformBuffer transforms_;
  CloudToScanStage stage_;
  OutputBag output_;
  ConvertedClouds result_;
};

}  // namespace

CloudsToScansArguments parseCloudsToScans(std::vector<std::string> words) {
  CloudsToScansArguments arguments;
  for (const Remapping& one : takeRemappings(words, {kCloud, kScan})) {
    (one.ours == kCloud ? arguments.cloud_topic : arguments.scan_topic) = one.theirs;
  }
  CommandLine line("clouds_to_scans", kDescription, "bags");
  line.footer(kFooter);
  line.addFile("IN.bag", arguments.input, "with the clouds")->required();
  line.addFile("OUT.bag", arguments.output, "with the scans")->required();
  line.addFile("--config", arguments.config,
               "the sensor set, with a section cloud_to_scan; required", "CONFIG.yaml")
      ->required();
  line.add_flag("--keep-clouds", arguments.keep_clouds, "also copies the clouds");
  line.read(std::move(words));
  if (isSameFile(arguments.input, arguments.output)) {
    throw UsageError(arguments.output + ": the output must not be the input");
  }
  return arguments;
}

ConvertedClouds convertClouds(const CloudsToScansArguments& arguments) {
  rosbag::Bag input;
  openInput(arguments.input, input);
  if (!holdsTopic(input, arguments.cloud_topic)) {
    failForTopic(input,
                 "no PointCloud2 on " + arguments.cloud_topic + " (cloud:=TOPIC names another)");
  }
  return CloudConversion(arguments, input).run();
}

}  // namespace datmo
