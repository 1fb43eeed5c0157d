// SPDX-License-Identifier: BSD-3-Clause
// Another station's CAM and CPM over loopback to tracks/v2x, and our own tracks to CAM and CPM.
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "chain.h"
#include "device/device_probe.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/device/datagram_listener.h"
#include "datmo_fusion/device/datagram_sender.h"
#include "datmo_fusion/fusion/wire/station_messages.h"
#include "datmo_fusion/risk/host_motion.h"
#include "datmo_fusion/ros/convert/earth_conversion.h"
#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/signal_wire.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo::v2x_wire_test {
namespace {

constexpr int kPort = 37301;     // v2x_wire.test's, of the nodelet
constexpr int kOurPort = 37302;  // and to which it sends
constexpr std::uint32_t kOther = 9;
const LocalPlane kPlane({degrees(45.19), degrees(5.72), 0.0});
const Pose2 kMap(100.0, 50.0, 0.3);  // in the plane

class Stations : public Listener {
 public:
  Stations() {
    foreign_ = node_.subscribe<TrackArray>(
        "tracks/v2x", kQueue, [this](const TrackArrayConstPtr& list) { foreign = list; });
    advice_ = node_.subscribe<SignalAdviceMessage>(
        "signal_advice", kQueue,
        [this](const SignalAdviceMessage::ConstPtr& message) { advice = message; });
    DatagramHandlers handlers;
    handlers.listening = [] {};
    handlers.received = [this](std::string_view bytes) { datagrams.put(std::string(bytes)); };
    handlers.fault = [](const DeviceError& error) { ADD_FAILURE() << error.what(); };
    ours_ = std::make_unique<DatagramListener>(DeviceAddress{"", kOurPort}, handlers);
  }

  bool isConnected() const {
    return foreign_.getNumPublishers() > 0 && frames_.getNumSubscribers() > 0 &&
           own_.getNumSubscribers() > 0 && poses_.getNumSubscribers() > 0;
  }

  /// Publishes where the map and the vehicle are at a time. `x`: m, in the map.
  void publishPoses(const ros::Time& time, double x) {
    const Stamp now = toStamp(time);
    EarthFrame frame{now, kPlane, {kMap, 1e-4 * Eigen::Matrix3d::Identity()}};
    frames_.publish(toMessage(frame, "map"));
    geometry_msgs::PoseWithCovarianceStamped pose;
    pose.header.stamp = toTime(now);
    pose.header.frame_id = "map";
    pose.pose =
        toMessage(PoseWithCovariance{Pose2(x, 0.0, 0.0), 1e-4 * Eigen::Matrix3d::Identity()});
    poses_.publish(pose);
  }

  /// Our sensors' tracks: none, so that only the vehicle itself is sent.
  void publishOwn() {
    TrackArray none;
    none.header.stamp = ros::Time::now();
    none.header.frame_id = "map";
    own_.publish(none);
  }

  /// A stationary car, and a pedestrian beside it, in the map.
  void sendOther() const {
    StationTrackList list;
    list.stamp = toStamp(ros::Time::now());
    list.station = kOther;
    for (std::uint32_t id = 0; id < 2; ++id) {
      StationTrack track;
      track.id = id;
      track.position = kMap * Point2(30.0, 5.0 * id);
      track.heading = kMap.heading();
      track.heading_variance = 1e-4;
      track.covariance *= 0.01;
      track.length = id == 0 ? 4.0 : 0.5;
      track.width = id == 0 ? 1.8 : 0.5;
      const ObjectClass kind = id == 0 ? ObjectClass::kVehicle : ObjectClass::kPedestrian;
      track.class_probabilities[static_cast<std::size_t>(kind)] = 1.0;
      list.tracks.push_back(track);
    }
    for (const std::string& bytes : encodeStation(list, kPlane, StationMessageOptions(), true)) {
      sender_.send(bytes);
    }
  }

  void send(const std::string& bytes) const { sender_.send(bytes); }

  void sendRubbish() const { sender_.send("no message"); }

  TrackArrayConstPtr foreign;
  SignalAdviceMessage::ConstPtr advice;
  samples::Mailbox<std::string> datagrams;

 private:
  static constexpr std::uint32_t kQueue = 10;

  ros::NodeHandle node_;
  ros::Subscriber foreign_;
  ros::Subscriber advice_;
  ros::Publisher frames_ = node_.advertise<EarthFrameMessage>("earth_frame", kQueue);
  ros::Publisher poses_ =
      node_.advertise<geometry_msgs::PoseWithCovarianceStamped>("pose/local", kQueue);
  ros::Publisher own_ = node_.advertise<TrackArray>("tracks/own", kQueue);
  DatagramSender sender_{"127.0.0.1", kPort};
  std::unique_ptr<DatagramListener> ours_;
};

TEST(V2xWireTest, StationsReceiveEachOther) {
  Stations stations;
  ASSERT_TRUE(stations.waitFor([&] { return stations.isConnected(); }));
  // Both a CAM and its CPM have to come through; each time newer ones are sent.
  ASSERT_TRUE(stations.waitFor([&] {
    stations.publishPoses(ros::Time::now(), 0.0);
    stations.sendOther();
    return stations.foreign && stations.foreign->tracks.size() == 2;
  }));
  EXPECT_EQ(stations.foreign->header.frame_id, "map");
  for (const TrackMessage& track : stations.foreign->tracks) {
    const bool is_car = track.size.x > 2.0;
    EXPECT_NEAR(track.pose.position.x, 30.0, 0.1);
    EXPECT_NEAR(track.pose.position.y, is_car ? 0.0 : 5.0, 0.1);
    EXPECT_NEAR(track.size.x, is_car ? 4.0 : 0.5, 1e-5);
    EXPECT_EQ(track.sensors, (std::vector<std::string>{"station 9"}));
  }

  stations.sendRubbish();
  EXPECT_TRUE(stations.waitFor([&] {
    return stations.diagnostic("v2x_wire", "dropped: other_message") >= 1.0 ||
           stations.diagnostic("v2x_wire", "messages of other kinds") >= 1.0;
  }));

  ASSERT_TRUE(stations.waitFor([&] {
    stations.publishPoses(ros::Time::now(), 0.0);
    stations.publishOwn();
    return !stations.datagrams.isEmpty();
  }));
  const Stamp now = toStamp(ros::Time::now());
  const StationMessage received =
      decodeStation(stations.datagrams.take(), now, StationMessageOptions());
  EXPECT_EQ(received.list.station, 1U);
  ASSERT_EQ(received.list.tracks.size(), 1U);
  const Point2 in_plane =
      kPlane.toPlane(received.plane.toGeodetic(received.list.tracks[0].position));
  EXPECT_LT((in_plane - kMap * Point2(HostVehicleOptions().middleAhead(), 0.0)).norm(), 0.05);
  EXPECT_TRUE(
      stations.waitFor([&] { return stations.diagnostic("v2x_wire", "datagrams sent") >= 2.0; }));
}

/// A lane along the map's x axis, whose stop line is at 200 m, with lights of group 3.
std::string mapOfLane() {
  const GeodeticPosition line = kPlane.toGeodetic(kMap * Point2(200.0, 0.0));
  const Point2 step = kMap * Point2(-190.0, 0.0) - kMap.position();
  MapIntersection intersection;
  intersection.id.number = 42;
  intersection.latitude = std::llround(1e7 * toDegrees(line.latitude));
  intersection.longitude = std::llround(1e7 * toDegrees(line.longitude));
  MapLane lane;
  lane.direction = MapLane::kIngress;
  lane.nodes = {{}, {false, std::llround(100.0 * step.x()), std::llround(100.0 * step.y())}};
  lane.connections = {{1, std::nullopt, 3}};
  intersection.lanes = {lane};
  Mapem message;
  message.intersections = {intersection};
  return encode(message);
}

/// Green for one minute from now.
std::string greenLight() {
  SpatTiming timing;
  timing.min_end =
      std::llround(10.0 * std::fmod(ros::Time::now().toSec() + 60.0, 3600.0)) % SpatTiming::kHour;
  timing.max_end = timing.min_end;
  SpatIntersection intersection;
  intersection.id.number = 42;
  intersection.movements = {{3, {{SignalState::kProtected, timing}}}};
  Spatem message;
  message.intersections = {intersection};
  return encode(message);
}

TEST(V2xWireTest, ThereIsAdviceOnTheLightsAhead) {
  constexpr double kSpeed = 5.0;  // m/s
  Stations stations;
  ASSERT_TRUE(stations.waitFor([&] { return stations.isConnected(); }));
  const ros::Time start = ros::Time::now();
  const auto driven = [&](const ros::Time& time) { return kSpeed * (time - start).toSec(); };
  const ros::Duration period(0.05);
  ros::Time next = start;
  ASSERT_TRUE(stations.waitFor([&] {
    const ros::Time now = ros::Time::now();
    if (now >= next) {
      next += period;
      stations.publishPoses(now, driven(now));
      stations.publishOwn();
      stations.send(mapOfLane());
      stations.send(greenLight());
    }
    return stations.advice && stations.advice->verdict == SignalAdviceMessage::PASSES;
  })) << (stations.advice ? stations.advice->reason : "no advice");
  const SignalAdviceMessage& advice = *stations.advice;
  const HostVehicleOptions vehicle;
  const double front = vehicle.length - vehicle.rear_overhang;
  EXPECT_EQ(advice.intersection, 42);
  EXPECT_NEAR(advice.distance, 200.0 - front - driven(advice.header.stamp), 1.0);
  EXPECT_NEAR(advice.arrival, advice.distance / kSpeed, 0.2 * advice.arrival);
  EXPECT_TRUE(stations.waitFor(
      [&] { return stations.diagnostic("v2x_wire", "intersections with a map") == 1.0; }));
}

}  // namespace
}  // namespace datmo::v2x_wire_test
