// SPDX-License-Identifier: BSD-3-Clause
#include "input_topics.h"

#include <stdexcept>

#include "camera_topics.h"
#include "input_bag.h"

#include <geometry_msgs/AccelWithCovarianceStamped.h>
#include <rosbag/view.h>
#include <sensor_msgs/JointState.h>

#include "datmo_fusion/ros/stage/grid_fusion_stage.h"
#include "datmo_fusion/ros/stage/map_fusion_stage.h"
#include "datmo_fusion/ros/stage/object_fusion_stage.h"
#include "datmo_fusion/ros/stage/scan_merge_stage.h"
#include "datmo_fusion/ros/stage/track_fusion_stage.h"
#include "datmo_fusion/ros/transform_topics.h"

namespace datmo {

namespace {

const std::string kTruthPrefix = "/ground_truth/";

std::vector<std::string> truthTopics(const rosbag::Bag& bag) {
  rosbag::View view(bag);
  std::vector<std::string> topics;
  for (const rosbag::ConnectionInfo* connection : view.getConnections()) {
    if (connection->topic.rfind(kTruthPrefix, 0) == 0) {
      topics.push_back(connection->topic);
    }
  }
  return topics;
}

void findGridTopics(const rosbag::Bag& bag, const Arguments& arguments, const std::string& stage,
                    const std::vector<std::string>& sources, InputTopics& topics) {
  for (const std::string& source : sources) {
    if (source == "stereo") {
      topics.stereo = neededStereoTopics(bag, arguments, stage);
    } else if (source != "lidar" && !(source == "mono" && arguments.mono)) {
      topics.grids["/grids/" + source] = source;
    }
  }
}

/// An external system's objects of the stereo camera are used if there are no points or images to
/// detect them in.
void findObjectTopics(const rosbag::Bag& bag, const Arguments& arguments,
                      const ObjectFusionStageOptions& fusion, InputTopics& topics) {
  for (const std::string& source : fusion.fuser.sourcesInUse()) {
    const std::string topic = "/objects/" + source;
    const bool external = holdsTopic(bag, topic) && !holdsPoints(bag, arguments);
    if (source == "stereo" && !external) {
      topics.stereo = neededStereoTopics(bag, arguments, "object_fusion");
    } else if (source != "lidar" && !(source == "cloud" && arguments.cloud_objects) &&
               !(source == "mono" && arguments.mono) && !(source == "radar" && arguments.radar)) {
      topics.objects[topic] = source;
    }
  }
}

/// The same for tracks of the stereo camera: an external system's objects are preferred to its
/// tracks.
void findTrackTopics(const rosbag::Bag& bag, const Arguments& arguments,
                     const TrackFusionStageOptions& fusion, InputTopics& topics) {
  const std::string objects = "/objects/stereo";
  for (const std::string& source : fusion.fuser.sourcesInUse()) {
    const std::string topic = "/tracks/" + source;
    const bool with_points = holdsPoints(bag, arguments);
    if (source == "stereo" && !with_points && holdsTopic(bag, objects)) {
      topics.objects[objects] = source;
    } else if (source == "stereo" && (with_points || !holdsTopic(bag, topic))) {
      topics.stereo = neededStereoTopics(bag, arguments, "track_fusion");
    } else if (source != "lidar" && !(source == "v2x" && arguments.v2x)) {
      topics.tracks[topic] = source;
    }
  }
}

/// The topic, in whichever form the bag has it. Throws std::runtime_error if it is missing.
std::string neededMotionTopic(const rosbag::Bag& bag, const Arguments& arguments,
                              const std::string& topic, const std::string& type) {
  const std::string name = arguments.inputTopic(topic);
  if (!holdsTopic(bag, name)) {
    failForTopic(bag, "no " + type + " on " + name + " (give its topic, " + topic +
                          ":=/..., or another source of motion, in " + arguments.config +
                          ": motion: {source: ...}, one of odometry, twist, imu, imu_and_twist, "
                          "imu_and_wheels, none)");
  }
  return name;
}

MotionTopics motionTopics(const rosbag::Bag& bag, const Arguments& arguments,
                          const MotionOptions& motion) {
  MotionTopics topics;
  if (motion.fromOdometry()) {
    topics.odometry = neededMotionTopic(bag, arguments, "odometry", "Odometry");
  }
  if (motion.usesImu()) {
    topics.imu = neededMotionTopic(bag, arguments, "imu", "Imu");
  }
  if (motion.usesTwist()) {
    const std::string with_covariance = arguments.inputTopic("twist_with_covariance");
    if (holdsTopic(bag, with_covariance)) {
      topics.twist_with_covariance = with_covariance;
    } else {
      topics.twist = neededMotionTopic(bag, arguments, "twist", "TwistStamped");
    }
  }
  if (motion.usesWheels()) {
    topics.joint_states = neededMotionTopic(bag, arguments, "joint_states", "JointState");
  }
  return topics;
}

/// A cloud named on the command line replaces scans; otherwise scans are used, and without any the
/// cloud on /cloud.
void findScanTopics(const rosbag::Bag& bag, const Arguments& arguments, InputTopics& topics) {
  const std::string cloud = arguments.inputTopic("cloud");
  const bool asked = arguments.remappings.count("/cloud") > 0;
  const bool has_scan = holdsTopic(bag, topics.scan) || holdsTopic(bag, topics.echoes);
  if (asked && !holdsTopic(bag, cloud)) {
    failForTopic(bag, "no PointCloud2 on " + cloud);
  }
  if (asked || (!has_scan && holdsTopic(bag, cloud))) {
    topics.cloud = cloud;
    topics.scan.clear();
    topics.echoes.clear();
  } else if (!has_scan) {
    failForTopic(bag, "neither a LaserScan on " + topics.scan + " nor a MultiEchoLaserScan on " +
                          topics.echoes + " nor a 3D lidar's PointCloud2 on " + cloud +
                          " (cloud:=TOPIC names another)");
  }
}

/// One scan of each scanner in place of the one scan.
void findMergedScans(const rosbag::Bag& bag, const Arguments& arguments,
                     const ScanMergeStageOptions& merge, InputTopics& topics) {
  for (const std::string& source : merge.sourcesInUse()) {
    const std::string topic = arguments.inputTopic(source + "_scan", "scans/" + source);
    if (!holdsTopic(bag, topic)) {
      failForTopic(bag, "no LaserScan on " + topic +
                            " for --merge-scans (front_scan:=TOPIC and "
                            "rear_scan:=TOPIC name others; scan_merge/sources/" +
                            source + "/use: false goes without)");
    }
    topics.scans[topic] = source;
  }
}

/// The clouds in which objects are detected; without a name, those that are converted to scans.
std::string objectCloudTopic(const rosbag::Bag& bag, const Arguments& arguments) {
  const std::string topic = arguments.inputTopic("object_cloud", arguments.inputTopic("cloud"));
  if (!holdsTopic(bag, topic)) {
    failForTopic(bag, "no PointCloud2 on " + topic +
                          " for --cloud-objects (object_cloud:=TOPIC names another)");
  }
  return topic;
}

std::string radarTopic(const rosbag::Bag& bag, const Arguments& arguments) {
  const std::string topic = arguments.inputTopic("radar");
  if (!holdsTopic(bag, topic)) {
    failForTopic(bag, "no RadarScan on " + topic + " for --radar (radar:=TOPIC names another)");
  }
  return topic;
}

/// Stations may be silent, but the receiver must not: without it no track is passed on.
V2xTopics v2xTopics(const rosbag::Bag& bag, const Arguments& arguments) {
  const V2xTopics topics{arguments.inputTopic("gnss"), arguments.inputTopic("stations")};
  if (!holdsTopic(bag, topics.gnss)) {
    failForTopic(bag, "no NavSatFix on " + topics.gnss + " for --v2x (gnss:=TOPIC names another)");
  }
  return topics;
}

/// One of another type only if the command line names it.
template <typename Message>
std::string hostTopic(const rosbag::Bag& bag, const Arguments& arguments,
                      const std::string& topic) {
  return optionalTopic<Message>(bag, arguments.inputTopic(topic),
                                arguments.remappings.count("/" + topic) > 0);
}

HostTopics hostTopics(const rosbag::Bag& bag, const Arguments& arguments) {
  return {hostTopic<sensor_msgs::JointState>(bag, arguments, "steering"),
          hostTopic<geometry_msgs::AccelWithCovarianceStamped>(bag, arguments, "acceleration")};
}

}  // namespace

std::vector<std::string> MotionTopics::all() const {
  std::vector<std::string> topics;
  for (const std::string& topic : {odometry, imu, twist, twist_with_covariance, joint_states}) {
    if (!topic.empty()) {
      topics.push_back(topic);
    }
  }
  return topics;
}

std::vector<std::string> InputTopics::all() const {
  std::vector<std::string> topics = truth;
  topics.insert(topics.end(), {kTransformTopic});
  const std::vector<std::string> motion_topics = motion.all();
  topics.insert(topics.end(), motion_topics.begin(), motion_topics.end());
  for (const std::string& topic :
       {scan, echoes, cloud, object_cloud, stereo.points, stereo.velocities, stereo.left_image,
        stereo.right_image, stereo.left_info, stereo.right_info, mono.image, mono.info, radar,
        v2x.gnss, v2x.stations, host.steering, host.acceleration}) {
    if (!topic.empty()) {
      topics.push_back(topic);
    }
  }
  for (const auto* others : {&scans, &grids, &objects, &tracks}) {
    for (const auto& [topic, source] : *others) {
      topics.push_back(topic);
    }
  }
  return topics;
}

InputTopics findTopics(const rosbag::Bag& bag, const Arguments& arguments,
                       const SensorSet& sensors) {
  InputTopics topics;
  if (arguments.merge_scans) {
    findMergedScans(bag, arguments, sensors.options<ScanMergeStageOptions>("scan_merge"), topics);
  } else {
    topics.scan = arguments.inputTopic("scan");
    topics.echoes = arguments.inputTopic("echoes");
    findScanTopics(bag, arguments, topics);
  }
  if (arguments.cloud_objects) {
    topics.object_cloud = objectCloudTopic(bag, arguments);
    if (!topics.cloud.empty() && topics.object_cloud != topics.cloud) {
      throw std::runtime_error(
          "object_cloud:=" + topics.object_cloud + " with scans made of the clouds on " +
          topics.cloud + ": expected one 3D lidar, or object_cloud in addition to a planar scan");
    }
  }
  topics.motion = motionTopics(bag, arguments, sensors.shared().motion);
  if (arguments.low_level_fusion) {
    const auto fusion = sensors.options<GridFusionStageOptions>("grid_fusion");
    findGridTopics(bag, arguments, "grid_fusion", fusion.fuser.sourcesInUse(), topics);
  }
  if (arguments.map_fusion) {
    const auto fusion = sensors.options<MapFusionStageOptions>("map_fusion");
    findGridTopics(bag, arguments, "map_fusion", fusion.fuser.sourcesInUse(), topics);
  }
  if (arguments.v2x) {
    topics.v2x = v2xTopics(bag, arguments);
  }
  if (arguments.risk) {
    topics.host = hostTopics(bag, arguments);
  }
  if (arguments.mono) {
    topics.mono = monoTopics(bag, arguments);
  }
  if (arguments.radar) {
    topics.radar = radarTopic(bag, arguments);
  }
  if (arguments.fusesObjects()) {
    findObjectTopics(bag, arguments, sensors.options<ObjectFusionStageOptions>("object_fusion"),
                     topics);
  }
  if (arguments.track_fusion) {
    findTrackTopics(bag, arguments, sensors.options<TrackFusionStageOptions>("track_fusion"),
                    topics);
  }
  if (arguments.with_truth) {
    topics.truth = truthTopics(bag);
  }
  return topics;
}

}  // namespace datmo
