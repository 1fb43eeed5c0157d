// SPDX-License-Identifier: BSD-3-Clause
#include "campaign_sensors.h"

#include <utility>

#include "stereo_pair_sample.h"
#include <boost/make_shared.hpp>

#include <geometry_msgs/AccelWithCovarianceStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <geometry_msgs/TwistWithCovarianceStamped.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/MultiEchoLaserScan.h>
#include <sensor_msgs/NavSatFix.h>

#include "datmo_fusion/ros/convert/earth_conversion.h"
#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/radar_objects_stage.h"
#include "datmo_fusion/ros/transform_topics.h"

namespace datmo::campaign {

namespace {

constexpr int kImageSteps = 4;                  // from image to image
constexpr double kWheelRadius = 0.3;            // m
constexpr double kAccelerationVariance = 0.04;  // m^2/s^4
constexpr double kFixVariance = 0.01;           // m^2, as of a receiver with corrections
constexpr std::uint32_t kStation = 7;

template <typename Message>
void add(const std::string& topic, const Message& message, std::vector<Publication>& sent) {
  sent.push_back(
      {topic, ros::message_traits::datatype<Message>(), boost::make_shared<Message>(message)});
}

tf2_msgs::TFMessage listOf(std::vector<geometry_msgs::TransformStamped> transforms) {
  tf2_msgs::TFMessage message;
  message.transforms = std::move(transforms);
  return message;
}

sensor_msgs::MultiEchoLaserScan withEchoes(const sensor_msgs::LaserScan& scan) {
  sensor_msgs::MultiEchoLaserScan message;
  message.header = scan.header;
  message.angle_min = scan.angle_min;
  message.angle_max = scan.angle_max;
  message.angle_increment = scan.angle_increment;
  message.scan_time = scan.scan_time;
  message.range_min = scan.range_min;
  message.range_max = scan.range_max;
  message.ranges.resize(scan.ranges.size());
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    message.ranges[i].echoes = {scan.ranges[i]};
  }
  return message;
}

/// The stereo camera is slower than the scanner.
void addImages(int step, std::vector<Publication>& sent) {
  if (step % kImageSteps != 0) {
    return;
  }
  const int index = step / kImageSteps;
  StereoPairSample pair;
  pair.disparity += index % 4;  // otherwise the camera would look frozen: same first pixel
  const Stamp stamp = Stamp::fromSeconds(World::kStart + CampaignSensors::kStep * step);
  for (const auto& [side, is_right] :
       {std::pair<std::string, bool>("left", false), {"right", true}}) {
    add("stereo/" + side + "/camera_info", *pair.info(stamp, is_right), sent);
    sensor_msgs::Image image = *pair.image(stamp, is_right, "mono8");
    image.data.front() = static_cast<std::uint8_t>(index);
    add("stereo/" + side + "/image_rect", image, sent);
  }
}

}  // namespace

std::vector<Publication> CampaignSensors::at(int step) const {
  const double seconds = kStep * step;
  std::vector<Publication> sent;
  add(kStaticTransformTopic, listOf({world_.scannerInBase(), world_.cameraInBase()}), sent);
  add(kTransformTopic, listOf({world_.baseInOdom(seconds)}), sent);
  addMotion(seconds, sent);
  addOthers(seconds, sent);
  if (graph_.switches.stereo == StereoPoints::kClouds) {
    addClouds(seconds, sent);
  } else {
    addImages(step, sent);
    if (graph_.switches.scan_from_cloud) {
      add("cloud", world_.cloud(seconds), sent);
    }
  }
  addScans(seconds, sent);
  return sent;
}

void CampaignSensors::addMotion(double seconds, std::vector<Publication>& sent) const {
  const nav_msgs::Odometry odometry = world_.odometry(seconds);
  add("odometry", odometry, sent);
  geometry_msgs::TwistWithCovarianceStamped twist;
  twist.header.stamp = odometry.header.stamp;
  twist.header.frame_id = "base_link";
  twist.twist.twist = odometry.twist.twist;
  if (graph_.has_echoes) {
    add("twist_with_covariance", twist, sent);
  } else {
    geometry_msgs::TwistStamped plain;
    plain.header = twist.header;
    plain.twist = odometry.twist.twist;
    add("twist", plain, sent);
  }
  sensor_msgs::JointState wheels;
  wheels.header = twist.header;
  wheels.velocity.assign(2, odometry.twist.twist.linear.x / kWheelRadius);
  add("joint_states", wheels, sent);
  sensor_msgs::Imu imu;
  imu.header = twist.header;
  imu.angular_velocity = odometry.twist.twist.angular;
  add("imu", imu, sent);
  sensor_msgs::JointState steering;
  steering.header = twist.header;
  steering.name = {"front_left_steering", "front_right_steering"};
  steering.position.assign(2, odometry.twist.twist.angular.z);  // straight, if the drive is
  add("steering", steering, sent);
  geometry_msgs::AccelWithCovarianceStamped acceleration;
  acceleration.header = twist.header;
  acceleration.accel.covariance[0] = kAccelerationVariance;
  add("acceleration", acceleration, sent);
}

void CampaignSensors::addScans(double seconds, std::vector<Publication>& sent) const {
  const sensor_msgs::LaserScan scan = world_.scan(seconds);
  if (graph_.has_echoes) {
    add("echoes", withEchoes(scan), sent);
    return;
  }
  add("scan", scan, sent);
  add("scans/front", scan, sent);
  add("scans/rear", scan, sent);
}

void CampaignSensors::addClouds(double seconds, std::vector<Publication>& sent) const {
  add("stereo/right/camera_info", World::rightCameraInfo(), sent);
  const sensor_msgs::PointCloud2 cloud = world_.cloud(seconds);
  add("stereo/points2", cloud, sent);
  add("cloud", cloud, sent);
}

/// A radar, a GNSS receiver, and a station that tracks someone standing ahead.
void CampaignSensors::addOthers(double seconds, std::vector<Publication>& sent) const {
  const Stamp stamp = Stamp::fromSeconds(World::kStart + seconds);
  const Pose2 base = world_.baseInMap(seconds);
  const Point2 car = base.inverse() * world_.otherCar(seconds).center.position();
  RadarScanMessage radar;
  radar.header.stamp = toTime(stamp);
  radar.header.frame_id = "scanner";
  radar.returns.resize(2);
  radar.returns[0].range = static_cast<float>(car.norm());
  radar.returns[0].azimuth = static_cast<float>(std::atan2(car.y(), car.x()));
  radar.returns[1].range = static_cast<float>(2.0 * car.norm());
  add("radar", radar, sent);

  const LocalPlane plane({degrees(45.19), degrees(5.72), 212.0});
  const GeodeticPosition position = plane.toGeodetic(base.position());
  sensor_msgs::NavSatFix fix;
  fix.header.stamp = toTime(stamp);
  fix.header.frame_id = "base_link";
  fix.latitude = toDegrees(position.latitude);
  fix.longitude = toDegrees(position.longitude);
  fix.altitude = position.altitude;
  fix.position_covariance = {kFixVariance, 0.0, 0.0, 0.0,         kFixVariance,
                             0.0,          0.0, 0.0, kFixVariance};
  fix.position_covariance_type = sensor_msgs::NavSatFix::COVARIANCE_TYPE_DIAGONAL_KNOWN;
  add("gnss", fix, sent);

  StationTrackList list;
  list.stamp = stamp;
  list.station = kStation;
  StationTrack track;
  track.id = 5;
  track.position = Point2(60.0, 5.0);
  track.covariance = 0.04 * Eigen::Matrix4d::Identity();
  track.length = track.width = 0.5;
  track.class_probabilities[static_cast<std::size_t>(ObjectClass::kPedestrian)] = 1.0;
  list.tracks.push_back(track);
  add("stations", toMessage(list, plane), sent);
}

}  // namespace datmo::campaign
