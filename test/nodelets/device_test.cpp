// SPDX-License-Identifier: BSD-3-Clause
// The running device nodelet with a fake scanner of each make: its scans, and what it reports when
// the scanner disappears and returns.
#include <cmath>
#include <vector>

#include "chain.h"
#include "device/fake_hokuyo.h"
#include "device/fake_lidar.h"
#include "device/fake_sick.h"
#include "device/nmea_sentences.h"
#include "device/velodyne_packets.h"
#include "ros/lidar_messages.h"
#include <gtest/gtest.h>

#include <geometry_msgs/TwistStamped.h>
#include <sensor_msgs/NavSatFix.h>
#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/ros/convert/earth_conversion.h"

namespace datmo::device_test {
namespace {

constexpr int kPort = 20940;          // device.test's
constexpr int kSickPort = 20211;      // device_sick.test's
constexpr int kLidarPort = 20236;     // device_velodyne.test's
constexpr int kReceiverPort = 20110;  // device_nmea.test's

class ScanRecorder : public Listener {
 public:
  ScanRecorder() {
    scan_ = node_.subscribe<sensor_msgs::LaserScan>(
        "scan", kQueue,
        [this](const sensor_msgs::LaserScanConstPtr& scan) { scans.push_back(scan); });
  }

  bool isConnected() const { return scan_.getNumPublishers() > 0; }

  std::vector<sensor_msgs::LaserScanConstPtr> scans;

 private:
  static constexpr std::uint32_t kQueue = 10;

  ros::NodeHandle node_;
  ros::Subscriber scan_;
};

TEST(DeviceTest, ScansArePublishedAndAFailureIsReported) {
  samples::FakeHokuyo scanner(kPort);
  ScanRecorder recorder;
  ASSERT_TRUE(recorder.waitFor([&recorder] { return recorder.isConnected(); }));
  scanner.accept();
  scanner.shakeHands();
  const ros::Time before = ros::Time::now();
  scanner.send(samples::FakeHokuyo::scan(100, {1000, 2000, 65533, 1, 5000}));
  ASSERT_TRUE(recorder.waitFor([&recorder] { return !recorder.scans.empty(); }));
  const sensor_msgs::LaserScan& scan = *recorder.scans.front();
  EXPECT_EQ(scan.header.frame_id, "front_laser");
  EXPECT_GE(scan.header.stamp, before - ros::Duration(samples::FakeHokuyo::kSweep + 1e-6));
  EXPECT_LE(scan.header.stamp, ros::Time::now());
  ASSERT_EQ(scan.ranges.size(), samples::FakeHokuyo::kBeams);
  EXPECT_FLOAT_EQ(scan.ranges[1], 2.0F);
  EXPECT_TRUE(std::isinf(scan.ranges[2]));
  EXPECT_TRUE(std::isnan(scan.ranges[3]));
  EXPECT_NEAR(scan.angle_min, -0.785398, 1e-6);
  EXPECT_NEAR(scan.angle_increment, samples::FakeHokuyo::kBeamSpacing, 1e-6);
  EXPECT_FLOAT_EQ(scan.range_min, 0.02F);
  EXPECT_FLOAT_EQ(scan.range_max, 30.0F);
  EXPECT_FLOAT_EQ(scan.scan_time, 0.025F);

  scanner.send(samples::FakeHokuyo::scan(175, {1000, 1000, 1000, 1000, 1000}));
  EXPECT_TRUE(recorder.waitFor([&recorder] {
    return recorder.diagnostic("device", "scans missed") == 2.0 &&
           recorder.diagnostic("device", "connections") >= 1.0;
  }));

  scanner.close();
  EXPECT_TRUE(recorder.waitFor(
      [&recorder] { return recorder.diagnostic("device", "dropped: lost_connection") >= 1.0; }));
  EXPECT_NE(recorder.diagnosticMessage("device").find("127.0.0.1:20940 has closed the connection"),
            std::string::npos)
      << recorder.diagnosticMessage("device");
  scanner.accept();
  scanner.shakeHands();
  scanner.send(samples::FakeHokuyo::scan(5, {1000, 1000, 1000, 1000, 1000}));
  EXPECT_TRUE(recorder.waitFor([&recorder] { return recorder.scans.size() == 3; }));
  EXPECT_TRUE(recorder.waitFor(
      [&recorder] { return recorder.diagnostic("device", "connections") >= 2.0; }));
}

TEST(SickDeviceTest, ScansArePublishedAndAFailureIsReported) {
  samples::FakeSick scanner(kSickPort);
  ScanRecorder recorder;
  ASSERT_TRUE(recorder.waitFor([&recorder] { return recorder.isConnected(); }));
  scanner.accept();
  scanner.shakeHands();
  const ros::Time before = ros::Time::now();
  samples::SickTelegram telegram;
  scanner.scan(telegram);
  ASSERT_TRUE(recorder.waitFor([&recorder] { return !recorder.scans.empty(); }));
  const sensor_msgs::LaserScan& scan = *recorder.scans.front();
  EXPECT_EQ(scan.header.frame_id, "front_laser");
  EXPECT_GE(scan.header.stamp, before - ros::Duration(0.020001));
  EXPECT_LE(scan.header.stamp, ros::Time::now());
  ASSERT_EQ(scan.ranges.size(), 4U);
  EXPECT_FLOAT_EQ(scan.ranges[0], 1.0F);
  EXPECT_EQ(scan.intensities.size(), 4U);
  EXPECT_NEAR(scan.angle_min, -2.356194, 1e-6);
  EXPECT_FLOAT_EQ(scan.range_max, 20.0F);

  telegram.state = 2;
  telegram.counter += 3;
  telegram.begun += 120000;
  telegram.sent += 120000;
  scanner.scan(telegram);
  EXPECT_TRUE(recorder.waitFor([&recorder] {
    return recorder.diagnostic("device", "scans missed") == 2.0 &&
           recorder.diagnostic("device", "warned: dirty_window") == 1.0;
  }));

  scanner.close();
  EXPECT_TRUE(recorder.waitFor(
      [&recorder] { return recorder.diagnostic("device", "dropped: lost_connection") >= 1.0; }));
  scanner.accept();
  scanner.shakeHands();
  scanner.scan(samples::SickTelegram());
  EXPECT_TRUE(recorder.waitFor([&recorder] { return recorder.scans.size() == 3; }));
  EXPECT_TRUE(recorder.waitFor(
      [&recorder] { return recorder.diagnostic("device", "connections") >= 2.0; }));
}

/// The clouds of a lidar and the scans that cloud_to_scan makes of them.
class LidarRecorder : public ScanRecorder {
 public:
  LidarRecorder() {
    cloud_ = node_.subscribe<sensor_msgs::PointCloud2>(
        "points", 1, [this](const sensor_msgs::PointCloud2ConstPtr& cloud) { last = cloud; });
    tf2_msgs::TFMessage mount;
    mount.transforms = {samples::transform("base_link", "roof_lidar", 0.5)};
    mount.transforms[0].transform.translation.z = samples::kLidarHeight;
    tf_static_.publish(mount);
  }

  sensor_msgs::PointCloud2ConstPtr last;

 private:
  ros::NodeHandle node_;
  ros::Publisher tf_static_ = node_.advertise<tf2_msgs::TFMessage>("/tf_static", 1, true);
  ros::Subscriber cloud_;
};

/// A lidar that turns in time with the computer's clock.
class TurningLidar {
 public:
  explicit TurningLidar(const samples::VelodyneSample& sample) : stream_(sample) {
    stream_.setTime(0.0);
  }

  /// Sends what the lidar has measured since the last call.
  void sendDue() {
    const double now = 1e6 * (ros::Time::now() - start_).toSec();
    while (stream_.time() < now) {
      lidar_.send(stream_.next());
    }
  }

  void lose(int packets) { stream_.skip(packets); }

 private:
  samples::FakeLidar lidar_{kLidarPort};
  samples::VelodyneStream stream_;
  ros::Time start_ = ros::Time::now();
};

/// Returns whether nothing of a turn's time is missing, nor the wall ahead: a busy machine loses
/// packets.
bool isWhole(const sensor_msgs::LaserScan& scan) {
  const float seconds = scan.time_increment * static_cast<float>(scan.ranges.size());
  return std::abs(std::abs(seconds) - 0.0995F) < 5e-3F &&
         std::abs(scan.ranges[scan.ranges.size() / 2] - 10.0F) < 0.3F;
}

TEST(VelodyneDeviceTest, TurnsBecomeCloudsAndDeskewedScans) {
  LidarRecorder recorder;
  TurningLidar lidar{samples::VelodyneSample()};
  ASSERT_TRUE(recorder.waitFor([&] {
    lidar.sendDue();
    return recorder.last != nullptr && !recorder.scans.empty();
  }));
  EXPECT_EQ(recorder.last->header.frame_id, "roof_lidar");
  ASSERT_EQ(recorder.last->fields.size(), 6U);
  EXPECT_EQ(recorder.last->fields[5].name, "time");
  // In time, within what a busy machine takes; not before it was measured.
  EXPECT_LT(recorder.last->header.stamp, ros::Time::now());
  EXPECT_TRUE(recorder.waitFor([&] {
    lidar.sendDue();
    return recorder.diagnostic("device", "connections") >= 1.0;
  }));
  EXPECT_TRUE(recorder.waitFor([&] {
    lidar.sendDue();
    return isWhole(*recorder.scans.back());
  })) << recorder.scans.size()
      << " scans, none of them whole";

  lidar.lose(3);
  EXPECT_TRUE(recorder.waitFor([&] {
    lidar.sendDue();
    return recorder.diagnostic("device", "packets missed") >= 3.0;
  }));
  // It disappears, and returns.
  EXPECT_TRUE(recorder.waitFor(
      [&recorder] { return recorder.diagnostic("device", "dropped: silent_device") >= 1.0; }));
  const auto before = recorder.scans.size();
  EXPECT_TRUE(recorder.waitFor([&] {
    lidar.sendDue();
    return recorder.scans.size() > before && recorder.diagnostic("device", "connections") >= 2.0;
  }));
}

/// Positions and velocities of a satellite receiver.
class FixRecorder : public Listener {
 public:
  FixRecorder() {
    fix_ = node_.subscribe<sensor_msgs::NavSatFix>(
        "gnss", 1, [this](const sensor_msgs::NavSatFixConstPtr& message) { fix = message; });
    twist_ = node_.subscribe<geometry_msgs::TwistStamped>(
        "twist", 1,
        [this](const geometry_msgs::TwistStampedConstPtr& message) { twist = message; });
  }

  bool isConnected() const { return fix_.getNumPublishers() > 0 && twist_.getNumPublishers() > 0; }

  sensor_msgs::NavSatFixConstPtr fix;
  geometry_msgs::TwistStampedConstPtr twist;

 private:
  ros::NodeHandle node_;
  ros::Subscriber fix_;
  ros::Subscriber twist_;
};

TEST(NmeaDeviceTest, PositionsAndVelocitiesArePublishedAndAFailureIsReported) {
  samples::FakeServer receiver(kReceiverPort);
  FixRecorder recorder;
  ASSERT_TRUE(recorder.waitFor([&recorder] { return recorder.isConnected(); }));
  receiver.accept();
  receiver.send(samples::ggaLine(1.0) + samples::ggaLine(1.2) + samples::rmcLine(1.2, 10.0));
  ASSERT_TRUE(recorder.waitFor(
      [&recorder] { return recorder.fix != nullptr && recorder.twist != nullptr; }));
  EXPECT_EQ(recorder.fix->header.frame_id, "antenna");
  EXPECT_NEAR(recorder.fix->latitude, 45.0 + 10.0 / 60.0, 1e-9);
  EXPECT_EQ(recorder.fix->status.status, sensor_msgs::NavSatStatus::STATUS_FIX);
  EXPECT_NEAR(recorder.fix->position_covariance[4], 16.0, 1e-9);
  // The earth_frame stage accepts it.
  EXPECT_NEAR(positionOf(*recorder.fix).altitude, 250.0, 1e-9);
  EXPECT_NEAR(covarianceOf(*recorder.fix, 1.0)(0, 0), 16.0, 1e-9);
  EXPECT_NEAR(recorder.twist->twist.linear.x, 5.14444, 1e-4);
  EXPECT_TRUE(recorder.twist->header.frame_id.empty());  // the vehicle's
  receiver.close();
  EXPECT_TRUE(recorder.waitFor(
      [&recorder] { return recorder.diagnostic("device", "dropped: lost_connection") >= 1.0; }));
  recorder.fix.reset();
  receiver.accept();
  receiver.send(samples::ggaLine(9.0) + samples::ggaLine(9.2) +
                samples::nmeaLine("GPGGA,100009.400,,,,,0,00,,,M,,M,,"));
  EXPECT_TRUE(recorder.waitFor([&recorder] {
    return recorder.fix != nullptr &&
           recorder.fix->status.status == sensor_msgs::NavSatStatus::STATUS_NO_FIX;
  }));
}

}  // namespace
}  // namespace datmo::device_test
