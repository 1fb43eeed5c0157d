// SPDX-License-Identifier: BSD-3-Clause
#include "mutated_drive.h"

#include <array>
#include <chrono>
#include <iterator>
#include <utility>

#include "all_levels.h"
#include "message_mutation.h"
#include "stereo_pair_sample.h"
#include <boost/make_shared.hpp>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>

#include "datmo_fusion/ros/convert/risk_conversion.h"

namespace datmo::campaign {

namespace {

constexpr double kStep = 1.0 / 16.0;   // s
constexpr int kMutatedSteps = 40;      // 2.5 s
constexpr int kCleanSteps = 48;        // longer than a map that starts over needs for its tracks
constexpr double kTooLong = 20.0;      // s for one message: a hang
constexpr unsigned kMaxMutations = 3;  // a step
constexpr int kImageSteps = 4;         // from image to image
constexpr const char* kImages = "images";

/// Graphs, so that each input of each stage is one of them: by name.
const std::array<std::pair<const char*, GraphSwitches>, 5>& graphs() {
  static const auto made = [] {
    GraphSwitches cloud;
    cloud.scan_from_cloud = cloud.cloud_objects = true;
    GraphSwitches alone;
    alone.road_border = alone.risk = true;
    GraphSwitches images;
    images.stereo = StereoPoints::kRectifiedImages;
    images.stereo_objects = images.mono = true;
    return std::array<std::pair<const char*, GraphSwitches>, 5>{{{"all levels", allLevels()},
                                                                 {"a 3D lidar", cloud},
                                                                 {"a twist", alone},
                                                                 {"an Imu and wheels", alone},
                                                                 {kImages, images}}};
  }();
  return made;
}

/// The sensor set's, with the source of motion that the graph is there for.
SensorSet sensorsOf(const std::string& config, const std::string& graph) {
  SensorSet sensors(config);
  if (graph == "a twist") {
    sensors.set("motion", "source", std::string("twist"));
  } else if (graph == "an Imu and wheels") {
    sensors.set("motion", "source", std::string("imu_and_wheels"));
  }
  return sensors;
}

template <typename Message>
std::pair<std::string, std::function<AnyMessage(const AnyMessage&, std::mt19937&)>> mutationOf() {
  return {ros::message_traits::datatype<Message>(),
          [](const AnyMessage& message, std::mt19937& random) -> AnyMessage {
            return boost::make_shared<Message>(
                mutated(*boost::static_pointer_cast<const Message>(message), random));
          }};
}

/// Whether anything of a publication must not be published.
template <typename... Messages>
std::string faultOf(const Publication& publication) {
  std::string fault;
  const auto check = [&](const auto& message) {
    if (message) {
      fault = contentFault(*message);
    }
  };
  (check(publication.as<Messages>()), ...);
  return fault;
}

}  // namespace

const std::map<std::string, MutatedDrive::Mutate>& MutatedDrive::mutations() {
  static const std::map<std::string, Mutate> by_type{
      mutationOf<nav_msgs::Odometry>(),
      mutationOf<nav_msgs::OccupancyGrid>(),
      mutationOf<sensor_msgs::LaserScan>(),
      mutationOf<sensor_msgs::PointCloud2>(),
      mutationOf<sensor_msgs::CameraInfo>(),
      mutationOf<sensor_msgs::Image>(),
      mutationOf<StereoAlignmentMessage>(),
      mutationOf<sensor_msgs::Imu>(),
      mutationOf<sensor_msgs::JointState>(),
      mutationOf<geometry_msgs::TwistStamped>(),
      mutationOf<geometry_msgs::PoseWithCovarianceStamped>(),
      mutationOf<tf2_msgs::TFMessage>(),
      mutationOf<LabeledScanMessage>(),
      mutationOf<RoadBorders>(),
      mutationOf<ObjectArray>(),
      mutationOf<TrackArray>()};
  return by_type;
}

MutatedDrive::MutatedDrive(const std::string& config, unsigned seed, Tally& tally)
    : random_(seed),
      graph_(graphs()[seed % graphs().size()].first),
      runner_(sensorsOf(config, graph_), graphs()[seed % graphs().size()].second),
      tally_(tally) {}

std::vector<std::string> MutatedDrive::run() {
  int index = 0;
  for (; index < kMutatedSteps; ++index) {
    step(kStep * index);
    for (auto left = random_() % (kMaxMutations + 1); left > 0; --left) {
      mutateOne(kStep * index);
    }
  }
  for (; index < kMutatedSteps + kCleanSteps; ++index) {
    step(kStep * index);
  }
  now_ = "at the end";
  last_ = "nothing more";
  if (last_tracks_ < kStep * (kMutatedSteps + kCleanSteps / 2)) {
    note("no tracks again after " + std::to_string(kCleanSteps * kStep) + " s without mutations");
  }
  findFaults();
  return std::move(faults_);
}

void MutatedDrive::step(double seconds) {
  now_ = "step " + std::to_string(static_cast<int>(seconds / kStep));
  sendTransforms({world_.scannerInBase(), world_.cameraInBase()}, true, seconds);
  sendTransforms({world_.baseInOdom(seconds)}, false, seconds);
  const nav_msgs::Odometry odometry = world_.odometry(seconds);
  send("odometry", odometry, seconds);
  geometry_msgs::TwistStamped twist;
  twist.header.stamp = odometry.header.stamp;
  twist.header.frame_id = "base_link";
  twist.twist = odometry.twist.twist;
  send("twist", twist, seconds);
  sensor_msgs::JointState wheels;
  wheels.header = twist.header;
  wheels.velocity = {odometry.twist.twist.linear.x / 0.3, odometry.twist.twist.linear.x / 0.3};
  send("joint_states", wheels, seconds);
  sensor_msgs::Imu imu;
  imu.header = twist.header;
  imu.angular_velocity = odometry.twist.twist.angular;
  send("imu", imu, seconds);
  if (graph_ == kImages) {
    sendImages(seconds);
    send("scan", world_.scan(seconds), seconds);
    return;
  }
  send("stereo/right/camera_info", World::rightCameraInfo(), seconds);
  const sensor_msgs::PointCloud2 cloud = world_.cloud(seconds);
  send("stereo/points2", cloud, seconds);
  send("cloud", cloud, seconds);
  send("scan", world_.scan(seconds), seconds);
}

void MutatedDrive::sendImages(double seconds) {
  const int index = static_cast<int>(seconds / kStep) / kImageSteps;
  if (static_cast<int>(seconds / kStep) % kImageSteps != 0) {
    return;
  }
  StereoPairSample pair;
  pair.disparity += index % 4;  // else the camera is frozen, as with the same first pixel
  const Stamp stamp = Stamp::fromSeconds(World::kStart + seconds);
  for (const auto& [side, is_right] :
       {std::pair<std::string, bool>("left", false), {"right", true}}) {
    send("stereo/" + side + "/camera_info", *pair.info(stamp, is_right), seconds);
    sensor_msgs::Image image = *pair.image(stamp, is_right, "mono8");
    image.data.front() = static_cast<std::uint8_t>(index);
    send("stereo/" + side + "/image_rect", image, seconds);
  }
}

void MutatedDrive::sendTransforms(const std::vector<geometry_msgs::TransformStamped>& transforms,
                                  bool is_static, double seconds) {
  tf2_msgs::TFMessage message;
  message.transforms = transforms;
  const std::string topic = is_static ? "/tf_static" : "/tf";
  samples_[topic] = {ros::message_traits::datatype<tf2_msgs::TFMessage>(),
                     boost::make_shared<tf2_msgs::TFMessage>(message)};
  deliver(topic, samples_[topic], seconds);
  ++tally_.messages;
}

template <typename Message>
void MutatedDrive::send(const std::string& topic, const Message& message, double seconds) {
  samples_[topic] = {ros::message_traits::datatype<Message>(),
                     boost::make_shared<Message>(message)};
  last_ = topic;
  deliver(topic, samples_[topic], seconds);
  ++tally_.messages;
}

void MutatedDrive::mutateOne(double seconds) {
  auto sample = samples_.begin();
  std::advance(sample, static_cast<std::ptrdiff_t>(random_() % samples_.size()));
  const auto mutation = mutations().find(sample->second.data_type);
  if (mutation == mutations().end()) {
    return;
  }
  last_ = "mutated " + sample->first;
  ++tally_.mutated;
  ++tally_.mutated_on[sample->first];
  deliver(sample->first,
          {sample->second.data_type, mutation->second(sample->second.message, random_)}, seconds);
}

void MutatedDrive::deliver(const std::string& topic, Sample sample, double seconds) {
  const auto begin = std::chrono::steady_clock::now();
  const Stamp now = Stamp::fromSeconds(World::kStart + seconds + 0.01);
  const auto transforms = [&] {
    return boost::static_pointer_cast<const tf2_msgs::TFMessage>(sample.message);
  };
  try {
    if (topic == "/tf_static") {
      runner_.takeStaticTransforms(*transforms());
    } else if (topic == "/tf") {
      take(runner_.takeTransforms(*transforms(), now));
    } else {
      take(runner_.take({topic, sample.data_type, sample.message}, now));
    }
  } catch (const std::exception& error) {
    note(std::string("an exception left the graph: ") + error.what());
  }
  const double took =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (took > tally_.slowest) {
    tally_.slowest = took;
    tally_.slowest_on = last_;
  }
  if (took > kTooLong) {
    note("took " + std::to_string(took) + " s");
  }
}

void MutatedDrive::take(const Publications& published) {
  for (const Publication& publication : published) {
    samples_[publication.topic] = {publication.data_type, publication.message};
    const std::string fault =
        faultOf<nav_msgs::Odometry, tf2_msgs::TFMessage, geometry_msgs::PoseWithCovarianceStamped,
                LabeledScanMessage, RoadBorders, ObjectArray, DroppedObjects, TrackArray,
                StereoAlignmentMessage, RiskArray>(publication);
    if (!fault.empty()) {
      note("published on " + publication.topic + " " + fault);
    }
    if (const auto tracks = publication.as<TrackArray>()) {
      if (publication.topic == "tracks") {
        last_tracks_ = tracks->header.stamp.toSec() - World::kStart;
      }
    }
  }
}

/// What the code did not expect of itself.
void MutatedDrive::findFaults() {
  for (const StageMonitor* monitor : runner_.monitors()) {
    for (const auto* counts : {&monitor->drops(), &monitor->warnings()}) {
      for (const auto& [reason, count] : *counts) {
        tally_.refused[reason] += count;
      }
    }
    for (const char* const reason : {"unexpected_error", "bad_output"}) {
      const auto found = monitor->drops().find(reason);
      if (found != monitor->drops().end()) {
        note(monitor->stage() + ": " + reason + " " + std::to_string(found->second) +
             " times, last " + monitor->lastDrop());
      }
    }
  }
}

void MutatedDrive::note(const std::string& what) {
  faults_.push_back(graph_ + ", " + now_ + ", " + last_ + ": " + what);
}

}  // namespace datmo::campaign
