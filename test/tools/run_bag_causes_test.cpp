// SPDX-License-Identifier: BSD-3-Clause
// Why are there no tracks? Causes are provoked, and the sentence that names them is checked.
#include <functional>
#include <limits>
#include <optional>

#include "run_bag/graph_runner.h"
#include "run_bag_drive.h"
#include <boost/make_shared.hpp>
#include <gtest/gtest.h>

#include "datmo_fusion/ros/stage/stack_health.h"

namespace datmo::run_bag_causes_test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Messages sent at one time; those that are removed are not sent.
struct Sent {
  std::optional<nav_msgs::Odometry> odometry;
  std::optional<tf2_msgs::TFMessage> transform;
  std::optional<sensor_msgs::LaserScan> scan;
};

struct Cause {
  std::string name;
  std::function<void(Sent& sent)> spoil;
  std::string sentence;  ///< must contain this
  bool has_mount = true;
  std::string config = "";
  GraphSwitches switches = {};
};

GraphSwitches with(bool GraphSwitches::*on) {
  GraphSwitches switches;
  switches.*on = true;
  return switches;
}

void nothing(Sent& /*sent*/) {}

class RunBagCauses : public RunBag {
 protected:
  StackHealth healthAfter(const Cause& cause) {
    writeConfig("grid_slam: {map_period: 0.5}\n" + cause.config +
                (cause.has_mount ? "mounts: {scanner: {x: 2.0}}\n" : ""));
    GraphRunner graph(SensorSet(arguments_.config), cause.switches);
    Stamp stamp = kStart;
    for (int i = 0; i < kScans; ++i) {
      stamp = kStart + i * kPeriod;
      const nav_msgs::Odometry odometry = odometryAt(stamp);
      Sent sent{odometry, transform(fromMessage(odometry.pose.pose), stamp, "odom", "base_link"),
                scanAt(stamp)};
      cause.spoil(sent);
      if (sent.odometry) {
        graph.handle("odometry", boost::make_shared<const nav_msgs::Odometry>(*sent.odometry),
                     stamp);
      }
      if (sent.transform) {
        graph.handleTransforms(*sent.transform, stamp);
      }
      if (sent.scan) {
        graph.handle("scan", boost::make_shared<const sensor_msgs::LaserScan>(*sent.scan), stamp);
      }
    }
    return stackHealth(graph.states(stamp), "tracks");
  }

  void expectSentence(const Cause& cause) {
    const StackHealth health = healthAfter(cause);
    EXPECT_TRUE(holds(health.sentence, cause.sentence)) << cause.name << ": " << health.sentence;
    EXPECT_EQ(health.level,
              holds(cause.sentence, "no tracks") ? HealthLevel::kNoOutput : HealthLevel::kDegraded)
        << cause.name;
  }
};

std::vector<Cause> causes() {
  const auto scan = [](const std::function<void(sensor_msgs::LaserScan&)>& spoil) {
    return [spoil](Sent& sent) { spoil(*sent.scan); };
  };
  return {
      {"no input", [](Sent& sent) { sent = {}; }, "no tracks: grid_slam: no odometry yet"},
      {"no scan", [](Sent& sent) { sent.scan.reset(); }, "no tracks: grid_slam: no scan yet"},
      {"no mount", [](Sent&) {}, "no tracks: grid_slam: transform base_link -> scanner", false, ""},
      {"no frame", scan([](auto& each) { each.header.frame_id = ""; }),
       "no tracks: grid_slam: a message without frame_id"},
      {"another frame", scan([](auto& each) { each.header.frame_id = "laser"; }),
       "no tracks: grid_slam: transform base_link -> laser"},
      {"stamp of zero", scan([](auto& each) { each.header.stamp = ros::Time(); }),
       "no tracks: grid_slam: stamp 0"},
      {"one stamp", scan([](auto& each) { each.header.stamp = toTime(kStart); }),
       "no tracks: grid_slam: stamp 1000.000000 s twice"},
      {"stamps beyond 2100",
       scan([](auto& each) { each.header.stamp = ros::Time(4200000000U, 0); }),
       "no tracks: grid_slam: stamp 4200000000 s"},
      {"no beams", scan([](auto& each) { each.ranges.clear(); }),
       "no tracks: grid_slam: scan without beams"},
      {"too few beams", scan([](auto& each) { each.ranges.resize(3); }),
       "no tracks: grid_slam: scan with 3 beams: expected 81"},
      {"no spacing", scan([](auto& each) { each.angle_increment = 0.0F; }),
       "no tracks: grid_slam: scan with an angle increment of 0"},
      {"no range", scan([](auto& each) { each.range_max = kNan; }),
       "no tracks: grid_slam: scan with a range limit of nan"},
      {"odometry of a trailer", [](Sent& sent) { sent.odometry->child_frame_id = "trailer"; },
       "degraded: grid_slam: odometry of 'trailer' in 'odom': expected 'base_link' in 'odom'"},
      {"odometry without frame", [](Sent& sent) { sent.odometry->header.frame_id = ""; },
       "degraded: grid_slam: odometry of 'base_link' in ''"},
      {"odometry that is not finite",
       [](Sent& sent) { sent.odometry->twist.twist.linear.x = kNan; },
       "degraded: grid_slam: odometry with speed nan m/s"},
      {"odometry too fast", [](Sent& sent) { sent.odometry->twist.twist.linear.x = 300.0; },
       "degraded: grid_slam: odometry with speed 300.000000 m/s"},
      {"no odometry", [](Sent& sent) { sent.odometry.reset(); },
       "degraded: grid_slam: no odometry yet"},
      {"no twist", [](Sent& sent) { sent.odometry.reset(); }, "degraded: motion: no twist yet",
       true, "motion: {source: twist}\n"},
      {"no Imu", [](Sent& sent) { sent.odometry.reset(); }, "degraded: motion: no imu yet", true,
       "motion: {source: imu}\n"},
      {"no wheels", [](Sent& sent) { sent.odometry.reset(); }, "degraded: motion: no imu yet", true,
       "motion: {source: imu_and_wheels}\n"},
  };
}

/// Causes: a misconfigured scanner, a vehicle that reports impossible motion, and sensors and
/// stages that are switched on but missing.
std::vector<Cause> furtherCauses() {
  const auto scan = [](const std::function<void(sensor_msgs::LaserScan&)>& spoil) {
    return [spoil](Sent& sent) { spoil(*sent.scan); };
  };
  const auto odometry = [](const std::function<void(nav_msgs::Odometry&)>& spoil) {
    return [spoil](Sent& sent) { spoil(*sent.odometry); };
  };
  return {
      {"frozen scans", scan([](auto& each) { each.ranges = scanAt(kStart).ranges; }),
       "no tracks: grid_slam: the scanner repeats its last scan bit for bit"},
      {"range limits the wrong way round", scan([](auto& each) { each.range_min = 60.0F; }),
       "no tracks: grid_slam: scan with ranges from 60.000000 to 50.000000 m: expected 0 <= "
       "range_min < range_max"},
      {"beams without a number",
       scan([](auto& each) { std::fill(each.ranges.begin(), each.ranges.end(), kNan); }),
       "degraded: grid_slam: scan with 81 beams, none of them valid: continues with the predicted "
       "pose"},
      {"beam times that fall", scan([](auto& each) { each.time_increment = -1.0F; }),
       "degraded: grid_slam: scan with 81 beams and a time increment of -1.000000 s: expected 0 or "
       "more, and at most 0.250000 s for all beams; assumes that they were measured at once"},
      {"a tilted scanner", nothing,
       "degraded: grid_slam: scan plane tilted by 11.459156 degrees: expected at most 5.000000",
       false, "mounts: {scanner: {x: 2.0, pitch: 0.2}}\n"},
      {"odometry's stamps of zero", odometry([](auto& each) { each.header.stamp = ros::Time(); }),
       "degraded: grid_slam: stamp 0"},
      {"odometry's one stamp", odometry([](auto& each) { each.header.stamp = toTime(kStart); }),
       "degraded: grid_slam: stamp 1000.000000 s twice"},
      {"odometry that turns by no rotation",
       odometry([](auto& each) { each.pose.pose.orientation.w = 2.0; }),
       "degraded: grid_slam: pose at 8.700000, 0.000000 with a quaternion of length 2.000000: "
       "expected finite numbers within 20000 km and length 1",
       true, "motion: {odometry_pose: true}\n"},
      {"odometry that no vehicle can have", odometry([](auto& each) {
         const bool odd = (each.header.stamp - toTime(kStart)).toNSec() / 60000000 % 2 == 1;
         each.twist.twist.linear.x = odd ? 40.0 : kSpeed;
       }),
       "degraded: grid_slam: odometry with speed 40.000000 m/s"},
      {"a scanner's clock that was set", scan([](auto& each) {
         const bool is_set = each.header.stamp >= toTime(kStart + 24 * kPeriod);
         each.header.stamp += ros::Duration(is_set ? 0.1 : 0.0);
       }),
       "degraded: grid_slam: stamps of scan are 0.100 s ahead of the sensor's previous clock"},
      {"odometry's clock that was set", odometry([](auto& each) {
         const bool is_set = each.header.stamp >= toTime(kStart + 24 * kPeriod);
         each.header.stamp -= ros::Duration(is_set ? 0.04 : 0.0);
       }),
       "degraded: grid_slam: stamps of odometry are 0.040 s behind the sensor's previous clock"},
      {"no stereo points", nothing, "degraded: stereo_alignment: no points2 yet", true, "",
       with(&GraphSwitches::low_level_fusion)},
      {"no clouds of a 3D lidar", nothing, "no tracks: cloud_to_scan: no cloud yet", true, "",
       with(&GraphSwitches::scan_from_cloud)},
      {"no images", nothing, "degraded: mono_classifier: no image yet", true, "",
       with(&GraphSwitches::mono)},
      {"no stereo points for objects", nothing, "degraded: stereo_alignment: no points2 yet", true,
       "", with(&GraphSwitches::stereo_objects)},
  };
}

TEST_F(RunBagCauses, TheFirstCauseInTheChainIsNamed) {
  for (const Cause& cause : causes()) {
    expectSentence(cause);
  }
}

TEST_F(RunBagCauses, RarerCausesAreNamed) {
  for (const Cause& cause : furtherCauses()) {
    expectSentence(cause);
  }
}

}  // namespace
}  // namespace datmo::run_bag_causes_test
