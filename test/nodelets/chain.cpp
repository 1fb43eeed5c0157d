// SPDX-License-Identifier: BSD-3-Clause
#include "chain.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <XmlRpcClient.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <tf2_msgs/TFMessage.h>

#include <ros/callback_queue.h>
#include <ros/master.h>
#include <ros/network.h>
#include <rosgraph_msgs/Clock.h>

namespace datmo {

namespace {

constexpr std::uint32_t kQueue = 1000;  // messages that arrive while the test does something else
constexpr double kStep = 1.0 / 16.0;    // s
constexpr double kClockJump = 0.9;      // s, just below what StampGate wants confirmed

tf2_msgs::TFMessage message(const geometry_msgs::TransformStamped& transform) {
  tf2_msgs::TFMessage result;
  result.transforms.push_back(transform);
  return result;
}

}  // namespace

Listener::Listener() : clock_(node_.advertise<rosgraph_msgs::Clock>("/clock", kQueue, true)) {
  subscribers_ = {keep("pose", poses), keep("map", maps), keep("labeled_scan", labeled_scans),
                  keep("objects", objects), keep("tracks", tracks)};
  subscribers_.push_back(node_.subscribe<StageTiming>(
      "timing", kQueue, [this](const StageTimingConstPtr& timing) { ++timings[timing->stage]; }));
  subscribers_.push_back(node_.subscribe<tf2_msgs::TFMessage>(
      "/tf", kQueue, [this](const tf2_msgs::TFMessageConstPtr& list) { transforms.add(*list); }));
  subscribers_.push_back(node_.subscribe<diagnostic_msgs::DiagnosticArray>(
      "/diagnostics", kQueue, [this](const diagnostic_msgs::DiagnosticArrayConstPtr& list) {
        reported_ = list->header.stamp;
        for (const auto& status : list->status) {
          diagnostics_[status.name.substr(0, status.name.find(':'))] = status;
        }
      }));
}

template <typename Message>
ros::Subscriber Listener::keep(const std::string& topic,
                               std::vector<boost::shared_ptr<const Message>>& kept) {
  return node_.subscribe<Message>(
      topic, kQueue,
      [&kept](const boost::shared_ptr<const Message>& arrived) { kept.push_back(arrived); });
}

bool Listener::waitFor(const std::function<bool()>& condition, double max_seconds) {
  const ros::SteadyTime end = ros::SteadyTime::now() + ros::WallDuration(max_seconds);
  while (!condition()) {
    if (ros::SteadyTime::now() > end || !ros::ok()) {
      return false;
    }
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.01));
  }
  return true;
}

void Listener::setClock(const ros::Time& now) {
  if (!ros::Time::isSimTime()) {
    return;
  }
  rosgraph_msgs::Clock clock;
  clock.clock = now;
  clock_.publish(clock);
  const bool is_jump = !now_.isZero() && std::abs((now - now_).toSec()) > kClockJump;
  now_ = now;
  if (is_jump && !diagnostics_.empty()) {
    waitFor([this] { return reported_ == now_; });
  }
}

bool Listener::waitForNodelets() {
  return waitFor([this] {
    bool connected = diagnostics_.size() >= 3;
    for (const ros::Subscriber& subscriber : subscribers_) {
      connected = connected && subscriber.getNumPublishers() >= 1;
    }
    return connected;
  });
}

double Listener::diagnostic(const std::string& nodelet, const std::string& key) const {
  return std::strtod(diagnosticText(nodelet, key).c_str(), nullptr);
}

std::string Listener::diagnosticText(const std::string& nodelet, const std::string& key) const {
  const auto found = diagnostics_.find(nodelet);
  if (found != diagnostics_.end()) {
    for (const auto& value : found->second.values) {
      if (value.key == key) {
        return value.value;
      }
    }
  }
  return "";
}

std::string Listener::diagnosticMessage(const std::string& nodelet) const {
  const auto found = diagnostics_.find(nodelet);
  return found == diagnostics_.end() ? "" : found->second.message;
}

pid_t processOf(const std::string& node) {
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcValue uri;
  request[0] = ros::this_node::getName();
  request[1] = node;
  if (!ros::master::execute("lookupNode", request, response, uri, false)) {
    return 0;
  }
  std::string host;
  std::uint32_t port = 0;
  ros::network::splitURI(uri, host, port);
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port));
  XmlRpc::XmlRpcValue caller;
  caller[0] = ros::this_node::getName();
  XmlRpc::XmlRpcValue answer;
  const bool answered = client.execute("getPid", caller, answer) && !client.isFault();
  return answered ? static_cast<pid_t>(static_cast<int>(answer[2])) : 0;
}

std::string askForChoice(const std::string& nodelet, const std::string& choice,
                         const std::string& value) {
  dynamic_reconfigure::Reconfigure call;
  call.request.config.strs.resize(1);
  call.request.config.strs[0].name = choice;
  call.request.config.strs[0].value = value;
  const bool answered = ros::service::call("/" + nodelet + "/set_parameters", call);
  return answered && !call.response.config.strs.empty() ? call.response.config.strs[0].value : "";
}

double askForNumber(const std::string& nodelet, const std::string& option, double value) {
  dynamic_reconfigure::Reconfigure call;
  call.request.config.doubles.resize(1);
  call.request.config.doubles[0].name = option;
  call.request.config.doubles[0].value = value;
  ros::service::call("/" + nodelet + "/set_parameters", call);
  for (const auto& kept : call.response.config.doubles) {
    if (kept.name == option) {
      return kept.value;
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

Chain::Chain(const World& world)
    : world_(world),
      scan_(node_.advertise<sensor_msgs::LaserScan>("scan", kQueue)),
      odometry_(node_.advertise<nav_msgs::Odometry>("odometry", kQueue)),
      tf_(node_.advertise<tf2_msgs::TFMessage>("/tf", kQueue)),
      tf_static_(node_.advertise<tf2_msgs::TFMessage>("/tf_static", kQueue, true)) {}

bool Chain::waitForNodelets() {
  setClock(0.0);
  return Listener::waitForNodelets() && waitFor([this] {
           // All nodelets of a process share one connection for tf; the other one is this test's.
           return scan_.getNumSubscribers() >= 1 && odometry_.getNumSubscribers() >= 1 &&
                  tf_.getNumSubscribers() >= 2 && tf_static_.getNumSubscribers() >= 1;
         });
}

void Chain::mountSensors() {
  tf2_msgs::TFMessage mounts;
  mounts.transforms = {world_.scannerInBase(), world_.cameraInBase()};
  tf_static_.publish(mounts);
}

bool Chain::prepareMotion(double seconds) {
  const double known = diagnostic("grid_slam", "odometry received");
  sendMotion(seconds - kStep);
  return waitFor([&] { return diagnostic("grid_slam", "odometry received") > known; });
}

void Chain::sendMotion(double seconds) {
  setClock(seconds);
  tf_.publish(message(world_.baseInOdom(seconds)));
  odometry_.publish(world_.odometry(seconds));
}

bool Chain::step(double seconds) {
  sendMotion(seconds);
  const auto scan = world_.scan(seconds);
  sendScan(scan);
  return waitFor(
      [&] { return !tracks.empty() && tracks.back()->header.stamp == scan.header.stamp; });
}

const TrackMessage* Chain::otherCarIn(const TrackArray& list) const {
  constexpr double kNear = 1.5;  // m
  const Box2 truth = world_.otherCar(list.header.stamp.toSec() - world_.start());
  const auto found =
      std::find_if(list.tracks.begin(), list.tracks.end(), [&](const TrackMessage& track) {
        return truth.distanceTo({track.pose.position.x, track.pose.position.y}) < kNear;
      });
  return found == list.tracks.end() ? nullptr : &*found;
}

bool Chain::drive(double from, double to) {
  const int steps = static_cast<int>(std::lround((to - from) / kStep));
  for (int i = 0; i < steps; ++i) {
    if (!step(from + kStep * i)) {
      return false;
    }
  }
  return true;
}

StereoChain::StereoChain(const World& world)
    : Chain(world),
      cloud_(node_.advertise<sensor_msgs::PointCloud2>("stereo/points2", kQueue)),
      camera_info_(
          node_.advertise<sensor_msgs::CameraInfo>("stereo/right/camera_info", kQueue, true)) {}

bool StereoChain::waitForNodelets(const std::vector<std::string>& names) {
  return Chain::waitForNodelets() && waitFor([&] {
           return cloud_.getNumSubscribers() >= 1 && camera_info_.getNumSubscribers() >= 1 &&
                  std::none_of(names.begin(), names.end(), [this](const std::string& name) {
                    return diagnosticMessage(name).empty();
                  });
         });
}

}  // namespace datmo
