// SPDX-License-Identifier: BSD-3-Clause
#include "bag_to_graph.h"

#include <stdexcept>

#include "command_line.h"
#include "message_record.h"

#include <geometry_msgs/AccelWithCovarianceStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <geometry_msgs/TwistWithCovarianceStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/MultiEchoLaserScan.h>
#include <sensor_msgs/NavSatFix.h>
#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/ros/convert/earth_conversion.h"
#include "datmo_fusion/ros/convert/risk_conversion.h"
#include "datmo_fusion/ros/stage/guard.h"
#include "datmo_fusion/ros/stage/radar_objects_stage.h"
#include "datmo_fusion/ros/transform_topics.h"

namespace datmo {

BagToGraph::BagToGraph(const InputTopics& topics, GraphRunner& graph, DriveSummary& drive,
                       OutputBag& output, const Arguments& arguments)
    : graph_(graph),
      drive_(drive),
      output_(output),
      write_grids_(arguments.write_grids),
      refusals_(graph.inputMonitors()),
      text_(arguments.text) {
  readMotion(topics);
  readScans(topics);
  readStereo(topics.stereo);
  readMono(topics.mono);
  on<RadarScanMessage>(topics.radar, "radar");
  on<sensor_msgs::NavSatFix>(topics.v2x.gnss, "gnss");
  on<StationTracksMessage>(topics.v2x.stations, "stations");
  on<sensor_msgs::JointState>(topics.host.steering, "steering");
  on<geometry_msgs::AccelWithCovarianceStamped>(topics.host.acceleration, "acceleration");
  readSources(topics);
}

void BagToGraph::readSources(const InputTopics& topics) {
  for (const auto& [topic, source] : topics.grids) {
    on<nav_msgs::OccupancyGrid>(topic, "grids/" + source);
  }
  for (const auto& [topic, source] : topics.objects) {
    on<ObjectArray>(topic, "objects/" + source);
  }
  for (const auto& [topic, source] : topics.tracks) {
    on<TrackArray>(topic, "tracks/" + source);
  }
}

void BagToGraph::handleStaticTransforms(const rosbag::Bag& bag) {
  rosbag::View view(bag, rosbag::TopicQuery(kStaticTransformTopic));
  for (const rosbag::MessageInstance& message : view) {
    guarded(graph_.inputs(), message.getTopic(),
            [&] { graph_.handleStaticTransforms(*plain<tf2_msgs::TFMessage>(message)); });
  }
}

void BagToGraph::handle(const rosbag::MessageInstance& message) {
  const auto readers = readers_.find(message.getTopic());
  if (readers == readers_.end()) {
    bool is_whole = false;
    guarded(graph_.inputs(), message.getTopic(), [&] {
      checkRecord(message);
      is_whole = true;
    });
    if (is_whole) {
      output_.copy(message);
      report_.noteTruth();
    }
    return;
  }
  for (const auto& [graph_topic, reader] : readers->second) {
    Publications published;
    guarded(graph_.inputs(), message.getTopic(),
            [&, &reader = reader] { published = reader(message, toStamp(message.getTime())); });
    write(message.getTime(), published);
  }
  refusals_.book(message.getTopic());
  report_.book(message.getTopic(), toStamp(message.getTime()), graph_);
}

void BagToGraph::readMotion(const InputTopics& topics) {
  readers_[kTransformTopic]["tf"] = [this](const rosbag::MessageInstance& message, Stamp now) {
    return graph_.handleTransforms(*plain<tf2_msgs::TFMessage>(message), now);
  };
  const MotionTopics& motion = topics.motion;
  on<nav_msgs::Odometry>(motion.odometry, "odometry");
  on<sensor_msgs::Imu>(motion.imu, "imu");
  on<geometry_msgs::TwistStamped>(motion.twist, "twist");
  on<geometry_msgs::TwistWithCovarianceStamped>(motion.twist_with_covariance,
                                                "twist_with_covariance");
  on<sensor_msgs::JointState>(motion.joint_states, "joint_states");
}

void BagToGraph::readScans(const InputTopics& topics) {
  on<sensor_msgs::LaserScan>(topics.scan, "scan");
  on<sensor_msgs::MultiEchoLaserScan>(topics.echoes, "echoes");
  for (const auto& [topic, source] : topics.scans) {
    on<sensor_msgs::LaserScan>(topic, "scans/" + source);
  }
  on<sensor_msgs::PointCloud2>(topics.cloud, "cloud");
  on<sensor_msgs::PointCloud2>(topics.object_cloud, "cloud");
}

void BagToGraph::readStereo(const StereoTopics& topics) {
  on<sensor_msgs::PointCloud2>(topics.velocities, "stereo/point_velocities");
  on<sensor_msgs::PointCloud2>(topics.points, "stereo/points2");
  on<sensor_msgs::Image>(topics.left_image, "stereo/left/image_rect");
  on<sensor_msgs::CameraInfo>(topics.left_info, "stereo/left/camera_info");
  on<sensor_msgs::Image>(topics.right_image, "stereo/right/image_rect");
  on<sensor_msgs::CameraInfo>(topics.right_info, "stereo/right/camera_info");
}

/// Both may use the same camera: then a message goes to both.
void BagToGraph::readMono(const MonoTopics& topics) {
  on<sensor_msgs::Image>(topics.image, "stereo/left/image_rect");
  on<sensor_msgs::CameraInfo>(topics.info, "stereo/left/camera_info");
}

void BagToGraph::write(const ros::Time& time, const Publications& published) {
  for (const Publication& publication : published) {
    drive_.add(publication);
    text_.add(publication);
    report_.add(publication);
    if (isResult(publication)) {
      writeAsOneOf<geometry_msgs::PoseWithCovarianceStamped, nav_msgs::OccupancyGrid,
                   nav_msgs::Path, sensor_msgs::LaserScan, sensor_msgs::PointCloud2,
                   tf2_msgs::TFMessage, LabeledScanMessage, LocalizationState, RoadBorders,
                   ObjectArray, DroppedObjects, TrackArray, RiskArray, StereoAlignmentMessage,
                   EarthFrameMessage, StationTracksMessage>(time, publication);
    }
  }
}

/// Topics that are internal to the stages are not written: grids only on demand; odometry made of
/// other sensors, clouds and early objects (the complete ones follow) never.
bool BagToGraph::isResult(const Publication& publication) const {
  const bool is_grid = publication.topic.rfind("grids/", 0) == 0;
  const bool is_stereo =
      publication.topic.rfind("stereo/", 0) == 0 && publication.topic != "stereo/alignment";
  const bool is_early = publication.topic == "objects/early";
  const bool is_odometry = publication.as<nav_msgs::Odometry>() != nullptr;
  return is_grid ? write_grids_ : !is_stereo && !is_early && !is_odometry;
}

template <typename... Messages>
void BagToGraph::writeAsOneOf(const ros::Time& time, const Publication& publication) {
  if (!(writeIf(time, publication.topic, publication.as<Messages>()) || ...)) {
    throw std::logic_error(publication.topic + " has the type " + publication.data_type +
                           ": expected one of those that BagToGraph::write lists");
  }
}

template <typename Message>
bool BagToGraph::writeIf(const ros::Time& time, const std::string& topic,
                         const boost::shared_ptr<const Message>& message) {
  if (message) {
    output_.write(withSlash(topic), time, *message);
  }
  return message != nullptr;
}

}  // namespace datmo
