// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/scan_loading.h"

#include <algorithm>

#include "evaluate/topic_reader.h"
#include "input_bag.h"
#include <tf2_msgs/TFMessage.h>

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "datmo_fusion/ros/convert/scan_conversion.h"
#include "datmo_fusion/ros/frames.h"
#include "datmo_fusion/ros/transform_topics.h"

namespace datmo::evaluation {

namespace {

constexpr char kBaseFrame[] = "base_link";

void readMounts(const rosbag::Bag& bag, tf2::BufferCore& transforms) {
  rosbag::View view(bag, rosbag::TopicQuery(kStaticTransformTopic));
  for (const rosbag::MessageInstance& instance : view) {
    for (const auto& transform : read<tf2_msgs::TFMessage>(instance)->transforms) {
      transforms.setTransform(transform, bag.getFileName(), true);
    }
  }
}

template <typename Message>
std::vector<Scan> readScans(TopicReader reader, const tf2::BufferCore& transforms) {
  std::vector<Scan> scans;
  reader.forEach<Message>([&](const Message& message) {
    const ScannerMount mount = scannerMount(transforms, kBaseFrame, message.header.frame_id);
    scans.push_back(toScan(message, mount, ScanConversionOptions()).scan);
  });
  std::stable_sort(scans.begin(), scans.end(),
                   [](const Scan& a, const Scan& b) { return a.stamp < b.stamp; });
  return scans;
}

}  // namespace

std::vector<Scan> loadScans(const std::string& file, const TopicOptions& topics) {
  rosbag::Bag bag;
  openInput(file, bag);
  tf2::BufferCore transforms;
  readMounts(bag, transforms);
  TopicReader echoes(bag, topics.echoes);
  if (echoes.isThere() && !holdsTopic(bag, topics.scan)) {
    return readScans<sensor_msgs::MultiEchoLaserScan>(echoes, transforms);
  }
  return readScans<sensor_msgs::LaserScan>(TopicReader(bag, topics.scan), transforms);
}

}  // namespace datmo::evaluation
