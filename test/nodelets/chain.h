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

/// The running nodelets, seen from outside: keeps their output. Waits for conditions, each for a
/// bounded time; nothing sleeps.
class Listener {
 public:
  Listener();

  /// Waits until the condition holds; returns false if it does not within `max_seconds` of wall
  /// time: far more than a busy machine needs.
  bool waitFor(const std::function<bool()>& condition, double max_seconds = 120.0);

  /// Sets the ROS time of all, unless that is the computer's. If it jumps, waits until the nodelets
  /// have it (by their diagnostics): a message that overtakes the clock counts as stray and is
  /// dropped.
  void setClock(const ros::Time& now);

  /// Waits until the three nodelets are connected with this test, and have reported.
  bool waitForNodelets();

  /// Returns the value of a key in the diagnostics of a nodelet; 0 before it is there.
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

/// Returns the process of a node; 0 if it does not answer.
pid_t processOf(const std::string& node);

/// Returns the value that a nodelet keeps after `value` was requested for one of its dynamic text
/// options.
std::string askForChoice(const std::string& nodelet, const std::string& choice,
                         const std::string& value);

/// The same for a numeric option; NaN if there is none of that name.
double askForNumber(const std::string& nodelet, const std::string& option, double value);

/// Sends the nodelets a drive through a World, with the clock.
class Chain : public Listener {
 public:
  explicit Chain(const World& world = World());

  /// Waits until the nodelets are subscribed to this test, too.
  bool waitForNodelets();

  void mountSensors();

  /// Sends motion just before a time of the drive, until grid_slam has received it: a scan may
  /// overtake its odometry, and before the first scan there is no older odometry.
  bool prepareMotion(double seconds);

  void setClock(double seconds) { Listener::setClock(ros::Time(world_.start() + seconds)); }

  /// Sends clock, tf and odometry of a time of the drive.
  void sendMotion(double seconds);

  void sendScan(const sensor_msgs::LaserScan& scan) { scan_.publish(scan); }

  /// Sends motion and scan of one step of the drive; waits for the tracks of that scan.
  bool step(double seconds);

  /// Returns the other car in a list of tracks; null if it is not there.
  const TrackMessage* otherCarIn(const TrackArray& list) const;

  /// Runs steps at 16 Hz from one time of the drive to another. Returns false if one did not come
  /// through.
  bool drive(double from, double to);

 protected:
  const World& world() const { return world_; }

  /// What is sent from now on comes from another one.
  void enter(const World& world) { world_ = world; }

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
  explicit StereoChain(const World& world = World());

  /// Waits until the nodelets are subscribed, and those named here report.
  bool waitForNodelets(const std::vector<std::string>& names);

  void sendCameraInfo() { camera_info_.publish(World::rightCameraInfo()); }
  void sendCloud(const sensor_msgs::PointCloud2& cloud) { cloud_.publish(cloud); }

 private:
  ros::NodeHandle node_;
  ros::Publisher cloud_;
  ros::Publisher camera_info_;
};

}  // namespace datmo
