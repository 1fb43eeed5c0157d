// SPDX-License-Identifier: BSD-3-Clause
#include "message_kinds.h"

#include <utility>

#include "message_mutation.h"
#include "ros/raw_message.h"
#include <boost/make_shared.hpp>
#include <tf2_msgs/TFMessage.h>

#include <geometry_msgs/AccelWithCovarianceStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <geometry_msgs/TwistWithCovarianceStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/MultiEchoLaserScan.h>
#include <sensor_msgs/NavSatFix.h>
#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/ros/bounded_stream.h"
#include "datmo_fusion/ros/convert/earth_conversion.h"
#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/frame_ids.h"
#include "datmo_fusion/ros/stage/part_clocks.h"
#include "datmo_fusion/ros/stage/radar_objects_stage.h"

namespace datmo::campaign {

namespace {

template <typename Message>
const Message& typed(const AnyMessage& message) {
  return *static_cast<const Message*>(message.get());
}

template <typename Message>
AnyMessage decode(std::vector<std::uint8_t> bytes) {
  const auto message = decodeBounded<Message>(std::move(bytes));
  if constexpr (ros::message_traits::HasHeader<Message>::value ||
                std::is_same_v<Message, tf2_msgs::TFMessage>) {
    stripSlashes(*message);
  }
  return message;
}

template <typename Message>
std::pair<const std::string, MessageKind> kind() {
  return {ros::message_traits::datatype<Message>(),
          {decode<Message>,
           [](const AnyMessage& message) { return toRaw(typed<Message>(message)).bytes; },
           [](const AnyMessage& message, ros::Duration shift) -> AnyMessage {
             return boost::make_shared<Message>(shifted(typed<Message>(message), shift));
           },
           [](const AnyMessage& message, std::mt19937& random) -> AnyMessage {
             return boost::make_shared<Message>(mutated(typed<Message>(message), random));
           }}};
}

}  // namespace

const std::map<std::string, MessageKind>& messageKinds() {
  static const std::map<std::string, MessageKind> kinds{
      kind<nav_msgs::Odometry>(),
      kind<nav_msgs::OccupancyGrid>(),
      kind<sensor_msgs::LaserScan>(),
      kind<sensor_msgs::MultiEchoLaserScan>(),
      kind<sensor_msgs::PointCloud2>(),
      kind<sensor_msgs::CameraInfo>(),
      kind<sensor_msgs::Image>(),
      kind<sensor_msgs::Imu>(),
      kind<sensor_msgs::JointState>(),
      kind<sensor_msgs::NavSatFix>(),
      kind<geometry_msgs::AccelWithCovarianceStamped>(),
      kind<geometry_msgs::TwistStamped>(),
      kind<geometry_msgs::TwistWithCovarianceStamped>(),
      kind<geometry_msgs::PoseWithCovarianceStamped>(),
      kind<tf2_msgs::TFMessage>(),
      kind<EarthFrameMessage>(),
      kind<LabeledScanMessage>(),
      kind<ObjectArray>(),
      kind<PartClock>(),
      kind<RadarScanMessage>(),
      kind<RoadBorders>(),
      kind<StationTracksMessage>(),
      kind<StereoAlignmentMessage>(),
      kind<TrackArray>()};
  return kinds;
}

}  // namespace datmo::campaign
