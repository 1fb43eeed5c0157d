// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/simulation_messages.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo::simulator {

namespace {

const char* const kMapFrame = "map";

std_msgs::Header header(Stamp stamp, const std::string& frame) {
  std_msgs::Header result;
  result.stamp = toTime(stamp);
  result.frame_id = frame;
  return result;
}

/// The fields common to both kinds of scan.
template <typename Message>
Message emptyScan(const LaserScannerOptions& options, Stamp stamp) {
  Message message;
  const int gaps = options.beamCount() - 1;
  const double half_field = degrees(0.5 * options.field_of_view);
  const double last = degrees(gaps * options.beam_spacing) - half_field;
  message.header = header(stamp, "scanner");
  message.angle_min = static_cast<float>(-half_field);
  message.angle_max = static_cast<float>(last);
  message.angle_increment = static_cast<float>(degrees(options.beam_spacing));
  message.time_increment = gaps > 0 ? static_cast<float>(options.sweep_duration / gaps) : 0.0F;
  message.scan_time = static_cast<float>(1.0 / options.scan_rate);
  message.range_min = static_cast<float>(options.min_range);
  message.range_max = static_cast<float>(std::min(options.effective_range, options.max_range));
  return message;
}

geometry_msgs::Point32 toPoint32(const Point2& point) {
  geometry_msgs::Point32 message;
  message.x = static_cast<float>(point.x());
  message.y = static_cast<float>(point.y());
  return message;
}

TrueObject toMessage(const ObjectTruth& truth, const Pose2& world_in_map) {
  const ObjectKind& kind = truth.state.kind;
  const Point2 velocity = world_in_map.rotate(truth.state.velocity);
  TrueObject message;
  message.id = truth.state.id;
  message.label = kind.label;
  message.classification = static_cast<std::uint8_t>(kind.object_class);
  message.pose = datmo::toMessage(world_in_map * truth.state.center);
  message.pose.position.z = 0.5 * kind.height;
  message.size.x = kind.length;
  message.size.y = kind.width;
  message.size.z = kind.height;
  message.velocity.x = velocity.x();
  message.velocity.y = velocity.y();
  message.moving = truth.state.moving;
  message.visible_to = truth.visible_to;
  message.lidar_beams = static_cast<std::uint16_t>(truth.lidar_beams);
  message.occlusion = static_cast<float>(truth.occlusion);
  return message;
}

std::uint8_t surfaceOf(const Echo& echo) {
  switch (echo.surface) {
    case Surface::kBody:
      return TrueEchoes::BODY;
    case Surface::kCurb:
      return TrueEchoes::CURB;
    case Surface::kPaint:
      break;
  }
  return TrueEchoes::PAINT;
}

}  // namespace

sensor_msgs::LaserScan toLaserScan(const EchoScan& scan, const LaserScannerOptions& options,
                                   Stamp stamp) {
  auto message = emptyScan<sensor_msgs::LaserScan>(options, stamp);
  for (const std::vector<Echo>& echoes : scan.beams) {
    message.ranges.push_back(echoes.empty() ? std::numeric_limits<float>::infinity()
                                            : static_cast<float>(echoes.front().range));
  }
  return message;
}

sensor_msgs::MultiEchoLaserScan toMultiEchoScan(const EchoScan& scan,
                                                const LaserScannerOptions& options, Stamp stamp) {
  auto message = emptyScan<sensor_msgs::MultiEchoLaserScan>(options, stamp);
  for (const std::vector<Echo>& echoes : scan.beams) {
    sensor_msgs::LaserEcho beam;
    for (const Echo& echo : echoes) {
      beam.echoes.push_back(static_cast<float>(echo.range));
    }
    message.ranges.push_back(beam);
  }
  return message;
}

TrueEchoes toTrueEchoes(const EchoScan& scan, Stamp stamp) {
  TrueEchoes message;
  message.header = header(stamp, "scanner");
  for (const std::vector<Echo>& echoes : scan.beams) {
    if (echoes.empty()) {
      message.surfaces.push_back(TrueEchoes::NOTHING);
      message.objects.push_back(kNoObject);
      message.ranges.push_back(0.0F);
      continue;
    }
    const Echo& nearest = echoes.front();
    message.surfaces.push_back(surfaceOf(nearest));
    message.objects.push_back(nearest.object);
    message.ranges.push_back(static_cast<float>(nearest.true_range));
  }
  return message;
}

nav_msgs::Odometry toMessage(const Odometry& odometry, Stamp stamp) {
  constexpr std::size_t kSpeed = 0;     // of 6 x 6: x
  constexpr std::size_t kYawRate = 35;  // of 6 x 6: rotation about z
  nav_msgs::Odometry message;
  message.header = header(stamp, "odom");
  message.child_frame_id = "base_link";
  message.pose = datmo::toMessage(odometry.pose);
  message.twist.twist.linear.x = odometry.twist.forward_speed;
  message.twist.twist.angular.z = odometry.twist.yaw_rate;
  message.twist.covariance[kSpeed] = odometry.speed_variance;
  message.twist.covariance[kYawRate] = odometry.yaw_rate_variance;
  return message;
}

datmo_fusion::TrueContact toTrueContact(const EgoContact& contact, Stamp stamp) {
  datmo_fusion::TrueContact message;
  message.header = header(stamp, kMapFrame);
  message.id = contact.object;
  message.label = contact.label;
  message.side = static_cast<std::uint8_t>(contact.side);
  message.strike_speed = static_cast<float>(contact.speed);
  return message;
}

nav_msgs::Odometry toTruePose(const WorldState& state, const Pose2& map_in_world, Stamp stamp) {
  nav_msgs::Odometry message;
  message.header = header(stamp, kMapFrame);
  message.child_frame_id = "base_link_ground_truth";
  message.pose.pose = datmo::toMessage(map_in_world.inverse() * state.base);
  message.twist.twist.linear.x = state.twist.forward_speed;
  message.twist.twist.angular.z = state.twist.yaw_rate;
  return message;
}

TrueObjectArray toMessage(const std::vector<ObjectTruth>& objects, const Pose2& map_in_world,
                          Stamp stamp) {
  TrueObjectArray message;
  message.header = header(stamp, kMapFrame);
  for (const ObjectTruth& object : objects) {
    message.objects.push_back(toMessage(object, map_in_world.inverse()));
  }
  return message;
}

TrueRoadBorders toTrueBorders(const RoadNetwork& roads, const WorldState& state,
                              const Pose2& map_in_world, Stamp stamp) {
  const Pose2 world_in_map = map_in_world.inverse();
  TrueRoadBorders message;
  message.header = header(stamp, kMapFrame);
  message.at_intersection = roads.atIntersection(state.base.position());
  for (const Polyline& curb : roads.curbs()) {
    ::datmo_fusion::Polyline border;
    for (const Point2& point : curb) {
      border.points.push_back(toPoint32(world_in_map * point));
    }
    message.borders.push_back(border);
  }
  return message;
}

}  // namespace datmo::simulator
