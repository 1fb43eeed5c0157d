// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "world.h"
#include <sys/types.h>

#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>

#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/transform_buffer.h"

namespace datmo {

/// The running nodelets, seen from outside: keeps what comes back. Waits for conditions, each for a
/// bounded time; nothing sleeps.
class Listener {
 public:
  Listener();

  /// Until the condition holds; false if it does not within `max_seconds` of the computer's clock:
  /// by far more than a machine needs that has other things to do.
  bool waitFor(const std::function<bool()>& condition, double max_seconds = 120.0);

  /// ROS time of all. Where it jumps, waits until the nodelets have it (by their diagnostics): a
  /// message that overtakes the clock is a stray one, and is dropped.
  void setClock(const ros::Time& now);

  /// Until the three nodelets are connected with this test, and have reported.
  bool waitForNodelets();

  /// Value of a key in the diagnostics of a nodelet; 0 before it is there.
  double diagnostic(const std::string& nodelet, const std::string& key) const;
  /// The same as text; empty before it is there.
  std::string diagnosticText(const std::string& nodelet, const std::string& key) const;
  std::string diagnosticMessage(const std::string& nodelet) const;

  std::vector<geometry_msgs::PoseWithCovarianceStampedConstPtr> poses;
  std::vector<nav_msgs::OccupancyGridConstPtr> maps;
  std::vector<LabeledScanConstPtr> labeled_scans;
  std::vector<ObjectArrayConstPtr> objects;
  std::vector<TrackArrayConstPtr> tracks;
  std::map<std::string, int> timings;  ///< by stage
  TransformBuffer transforms{1.0};

 private:
  template <typename Message>
  ros::Subscriber keep(const std::string& topic,
                       std::vector<boost::shared_ptr<const Message>>& kept);

  ros::NodeHandle node_;
  std::vector<ros::Subscriber> subscribers_;
  std::map<std::string, diagnostic_msgs::DiagnosticStatus> diagnostics_;  ///< by nodelet
  ros::Time reported_;                                                    ///< of the newest of them
  ros::Publisher clock_;
  ros::Time now_;
};

/// Process of a node; 0 if it does not answer.
pid_t processOf(const std::string& node);

/// What a nodelet keeps after `value` was asked for of one of its live options that are text.
std::string askForChoice(const std::string& nodelet, const std::string& choice,
                         const std::string& value);

/// The same of one that is a number; NaN if there is none of that name.
double askForNumber(const std::string& nodelet, const std::string& option, double value);

/// Sends the nodelets a drive through a World, with the clock.
class Chain : public Listener {
 public:
  Chain();

  /// Until the nodelets listen to this test, too.
  bool waitForNodelets();

  void mountSensors();

  /// Motion just before a time of the drive, until grid_slam knows it: a scan may overtake its
  /// odometry, and the first one has no older to go by.
  bool prepareMotion(double seconds);

  void setClock(double seconds) { Listener::setClock(ros::Time(World::kStart + seconds)); }

  /// Clock, tf and odometry at a time of the drive.
  void sendMotion(double seconds);

  void sendScan(const sensor_msgs::LaserScan& scan) { scan_.publish(scan); }

  /// A step of the drive: motion and scan; waits until the tracks of that scan are there.
  bool step(double seconds);

  /// The other car in a list of tracks; null if it is not there.
  const TrackMessage* otherCarIn(const TrackArray& list) const;

  /// Steps at 16 Hz from one time of the drive to another. False if one did not come through.
  bool drive(double from, double to);

 private:
  ros::NodeHandle node_;
  World world_;
  ros::Publisher scan_;
  ros::Publisher odometry_;
  ros::Publisher tf_;
  ros::Publisher tf_static_;
};

/// The same with the stereo camera.
class StereoChain : public Chain {
 public:
  StereoChain();

  /// Until the nodelets listen, and those named here report.
  bool waitForNodelets(const std::vector<std::string>& names);

  void sendCameraInfo() { camera_info_.publish(World::rightCameraInfo()); }
  void sendCloud(const sensor_msgs::PointCloud2& cloud) { cloud_.publish(cloud); }

 private:
  ros::NodeHandle node_;
  ros::Publisher cloud_;
  ros::Publisher camera_info_;
};

}  // namespace datmo
