// SPDX-License-Identifier: BSD-3-Clause
#include "campaign_graph.h"

#include "all_levels.h"

#include "datmo_fusion/ros/transform_topics.h"

namespace datmo::campaign {

namespace {

GraphSwitches cloudSwitches() {
  GraphSwitches cloud;
  cloud.scan_from_cloud = cloud.cloud_objects = true;
  return cloud;
}

GraphSwitches imageSwitches() {
  GraphSwitches images;
  images.stereo = StereoPoints::kRectifiedImages;
  images.stereo_objects = images.mono = true;
  return images;
}

GraphSwitches otherSensors() {
  GraphSwitches others;
  others.merge_scans = others.radar = others.v2x = others.track_fusion = true;
  others.map_fusion = others.loop_closing = others.stereo_objects = others.stereo_tracker = true;
  return others;
}

GraphSwitches withRisk() {
  GraphSwitches alone;
  alone.road_border = alone.risk = true;
  return alone;
}

}  // namespace

const std::vector<CampaignGraph>& campaignGraphs() {
  static const std::vector<CampaignGraph> graphs{
      {"all levels", allLevels()},
      {"a 3D lidar", cloudSwitches()},
      {"a twist", withRisk(), "twist"},
      {"an Imu and wheels", withRisk(), "imu_and_wheels"},
      {"images", imageSwitches()},
      {"two scanners, radar and stations", otherSensors()},
      {"several echoes, and a twist", allLevels(), "twist", true},
      {"all switches", allSwitches()}};
  return graphs;
}

SensorSet sensorsOf(const std::string& config, const CampaignGraph& graph) {
  SensorSet sensors(config);
  sensors.set("motion", "source", graph.motion);
  return sensors;
}

Publications handleAny(const Publication& message, Stamp now, GraphRunner& runner) {
  const auto transforms = message.as<tf2_msgs::TFMessage>();
  if (transforms && message.topic == kStaticTransformTopic) {
    runner.handleStaticTransforms(*transforms);
    return {};
  }
  return transforms ? runner.handleTransforms(*transforms, now) : runner.handle(message, now);
}

}  // namespace datmo::campaign
