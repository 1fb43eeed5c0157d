// SPDX-License-Identifier: BSD-3-Clause
// The bag runner on a drive with a radar beside the scanner.
#include <algorithm>
#include <cmath>

#include "run_bag_drive.h"

#include "datmo_fusion/ros/stage/radar_objects_stage.h"

namespace datmo::run_bag_radar_test {
namespace {

constexpr float kRelativeSpeed = 3.0F;  // m/s, speed of the vehicle ahead relative to the host

class RunBagWithRadar : public RunBag {
 protected:
  /// A vehicle ahead, and the wall at the end, in each cycle.
  void writeRadar(const std::string& topic) const {
    rosbag::Bag bag(arguments_.input, rosbag::bagmode::Append);
    for (int i = 0; i < kScans; ++i) {
      const Stamp stamp = kStart + i * kPeriod;
      RadarScanMessage scan;
      scan.header.stamp = toTime(stamp);
      scan.header.frame_id = "scanner";
      scan.returns.resize(2);
      const auto seconds = static_cast<float>(secondsBetween(kStart, stamp));
      scan.returns[0].range = 12.0F + kRelativeSpeed * seconds;
      scan.returns[0].doppler_velocity = kRelativeSpeed;
      scan.returns[1].range = static_cast<float>(kEnd - kSpeed * seconds);
      scan.returns[1].doppler_velocity = static_cast<float>(-kSpeed);
      bag.write(topic, toTime(stamp + 1e-3), scan);
    }
  }
};

TEST_F(RunBagWithRadar, ItsObjectsAreFused) {
  writeRadar("/radar");
  arguments_.radar = true;
  run();
  EXPECT_GE(count(arguments_.output, "/objects/radar"), std::size_t{kScans - 2});
  rosbag::Bag bag(arguments_.output);
  int fused = 0;
  for (const auto& message : rosbag::View(bag, rosbag::TopicQuery("/objects/fused"))) {
    const ObjectArrayConstPtr list = message.instantiate<ObjectArray>();
    const auto by_radar = [](const ObjectMessage& object) {
      return std::count(object.sensors.begin(), object.sensors.end(), "radar") > 0;
    };
    const auto object = std::find_if(list->objects.begin(), list->objects.end(), by_radar);
    if (object != list->objects.end()) {
      EXPECT_NEAR(object->velocity.x, kSpeed + kRelativeSpeed, 0.1);
      ++fused;
    }
  }
  EXPECT_GE(fused, kScans - 3);
}

TEST_F(RunBagWithRadar, ObjectsSeenByItAloneAreTracked) {
  writeRadar("/radar");
  arguments_.radar = true;
  run();
  rosbag::Bag bag(arguments_.output);
  TrackArrayConstPtr last;
  for (const auto& message : rosbag::View(bag, rosbag::TopicQuery("/tracks"))) {
    last = message.instantiate<TrackArray>();
  }
  ASSERT_TRUE(last);
  const double end = kPeriod * (kScans - 1);
  const auto is_there = [end](const TrackMessage& track) {
    const double ahead = 2.0 + kSpeed * end + 12.0 + static_cast<double>(kRelativeSpeed) * end;
    return std::abs(track.pose.position.x - ahead) < 1.0 && std::abs(track.pose.position.y) < 1.0;
  };
  const auto track = std::find_if(last->tracks.begin(), last->tracks.end(), is_there);
  ASSERT_NE(track, last->tracks.end());
  EXPECT_TRUE(track->moving);
  EXPECT_NEAR(track->velocity.x, kSpeed + static_cast<double>(kRelativeSpeed), 1.0);
}

TEST_F(RunBagWithRadar, AMissingTopicIsNamed) {
  arguments_.radar = true;
  EXPECT_NE(failure().find("no RadarScan on /radar for --radar"), std::string::npos);
  arguments_.remappings["/radar"] = "/radar_front";
  EXPECT_NE(failure().find("no RadarScan on /radar_front"), std::string::npos);
}

}  // namespace
}  // namespace datmo::run_bag_radar_test
