// SPDX-License-Identifier: BSD-3-Clause
// live.launch in real time: a scanner on loopback that speaks its protocol, odometry, and the
// clouds of a stereo camera, whose tracks are fused with the scanner's. Each scan leads to one list
// of tracks, or the stage that dropped it says so. Measures the time from the scan's departure at
// the scanner to the arrival of its tracks at another process, over TCP. The speed of this computer
// decides how long that takes and how much is dropped; no check depends on it. Then the process
// stands still for a while: clouds that have waited for too long give way to newer ones.
//
// Parameters: ~seconds of the drive, ~scan_rate and ~cloud_rate (Hz), ~out: a JSON file for the
// measurements.
#include <csignal>
#include <cstddef>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "latency_summary.h"
#include "paced_drive.h"
#include "turning_sick.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <ros/callback_queue.h>
#include <ros/spinner.h>

#include "datmo_fusion/ros/stage/queue_length.h"

namespace datmo::live_devices_test {
namespace {

constexpr int kPort = 20212;          // live_devices.test's
constexpr double kMotionRate = 50.0;  // Hz
constexpr double kCloudDelay = 0.1;   // s, of the images' transfer and matching
constexpr double kPatience = 120.0;   // s, far more than a busy machine needs
constexpr double kUsual = 0.5;        // s, of the usual rates
constexpr double kStandstill = 1.2 * maxWaitInQueue<sensor_msgs::PointCloud2>();  // s
constexpr double kReported = 3.0;       // s, in which the diagnostics report once
constexpr std::uint32_t kQueue = 1000;  // messages that arrive while the test does something else

/// A stage between scan and tracks, and its input there.
struct PassedStage {
  std::string name;
  std::string input;
};

const std::vector<PassedStage> kPassedStages{{"grid_slam", "scan"},
                                             {"moving_objects", "labeled_scan"},
                                             {"tracker", "objects"},
                                             {"track_fusion", "tracks/lidar"}};

/// When lists of tracks arrive, in a thread of its own: the test is busy with other sensors.
class TrackArrivals {
 public:
  struct Arrival {
    ros::Time stamp;
    ros::SteadyTime at;
  };

  TrackArrivals() {
    node_.setCallbackQueue(&queue_);
    tracks_ = node_.subscribe<TrackArray>(
        "tracks", kQueue,
        [this](const TrackArrayConstPtr& list) {
          const std::lock_guard<std::mutex> lock(mutex_);
          arrivals_.push_back({list->header.stamp, ros::SteadyTime::now()});
        },
        ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
    spinner_.start();
  }

  std::vector<Arrival> all() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return arrivals_;
  }

  std::size_t count() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return arrivals_.size();
  }

 private:
  mutable std::mutex mutex_;
  std::vector<Arrival> arrivals_;
  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  ros::AsyncSpinner spinner_{1, &queue_};
  ros::Subscriber tracks_;
};

class LiveDevicesTest : public testing::Test {
 protected:
  LiveDevicesTest() {
    scan_ = node_.subscribe<sensor_msgs::LaserScan>(
        "scan", kQueue, [this](const sensor_msgs::LaserScanConstPtr& scan) {
          ++scans_;
          numbers_[scan->header.stamp] = TurningSick::numberOf(*scan);
        });
    stereo_objects_ = node_.subscribe<ObjectArray>(
        "objects/stereo", kQueue, [this](const ObjectArrayConstPtr& /*list*/) { ++stereo_lists_; });
  }

  /// The drive itself is one of the publishers.
  bool receivesScans() const { return scan_.getNumPublishers() >= 2; }

  double count(const std::string& stage, const std::string& key) const {
    return drive_.diagnostic(stage, key);
  }

  double lost(const PassedStage& stage) const {
    return count(stage.name, "lost on " + stage.input);
  }

  /// Returns whether the diagnostics account for all scans: what a stage publishes is received by
  /// the next one or counted as lost, and what it receives but does not process is counted as
  /// dropped, with the reason. A stage counts what it drops of all its inputs together.
  bool isEachScanAccountedFor() const {
    double published = count("device", "processed");
    if (published + count("device", "measurements discarded") != sent() ||
        static_cast<double>(scans_) != published) {
      return false;
    }
    for (const PassedStage& stage : kPassedStages) {
      const double received = count(stage.name, stage.input + " received");
      const double processed = count(stage.name, "processed");
      const double dropped = count(stage.name, "dropped") - lost(stage);
      if (received + lost(stage) != published || received - processed > dropped) {
        return false;
      }
      published = processed;
    }
    return static_cast<double>(arrivals_.count()) == published;
  }

  double sent() const { return static_cast<double>(scanner_.departures().size()); }

  nlohmann::json stages() const {
    nlohmann::json list = {{{"stage", "device"},
                            {"processed", count("device", "processed")},
                            {"dropped", count("device", "measurements discarded")}}};
    for (const PassedStage& stage : kPassedStages) {
      list.push_back({{"stage", stage.name},
                      {"received", count(stage.name, stage.input + " received")},
                      {"lost", lost(stage)},
                      {"processed", count(stage.name, "processed")},
                      {"dropped", count(stage.name, "dropped")},
                      {"last_error", drive_.diagnosticText(stage.name, "last error")}});
    }
    return list;
  }

  /// Returns the latencies, s, by the order of arrival. Expects each list to belong to another
  /// scan.
  std::vector<double> latencies() const {
    const std::vector<ros::SteadyTime> departures = scanner_.departures();
    std::vector<double> found;
    std::set<std::size_t> answered;
    for (const TrackArrivals::Arrival& list : arrivals_.all()) {
      const auto scan = numbers_.find(list.stamp);
      if (scan == numbers_.end() || !answered.insert(scan->second).second) {
        ADD_FAILURE() << "tracks at " << list.stamp << " s, of no scan or of one with tracks";
      } else {
        found.push_back((list.at - departures.at(scan->second)).toSec());
      }
    }
    return found;
  }

  double staleClouds() const { return count("stereo_objects", "dropped: stale_message"); }

  /// Stops the process for longer than a cloud may wait, with some in the queue of stereo_objects;
  /// returns whether these are then dropped. Whether any still wait depends on the computer: tries
  /// again.
  bool dropsCloudsThatWaited(const PacedRates& rates) {
    const pid_t process = processOf("/perception");
    const sensor_msgs::PointCloud2 cloud = World().cloud(0.0, 1);
    const double before = staleClouds();
    bool dropped = false;
    for (const double end = drive_.now() + kPatience; !dropped && drive_.now() < end;) {
      drive_.run(kUsual, rates);
      sendAtOnce(cloud);
      drive_.run(kReported, {}, [&, lists = stereo_lists_] { return stereo_lists_ > lists; });
      if (process <= 0 || kill(process, SIGSTOP) != 0) {
        return false;
      }
      drive_.run(kStandstill, {});
      kill(process, SIGCONT);
      dropped = drive_.run(kReported, rates, [&] { return staleClouds() > before; });
    }
    return dropped;
  }

  /// Sends as many clouds as a queue has room for, of stamps for which there is odometry already.
  void sendAtOnce(sensor_msgs::PointCloud2 cloud) {
    constexpr std::uint32_t kClouds = queueLength<sensor_msgs::PointCloud2>();
    const ros::Time now = ros::Time::now();
    for (std::uint32_t i = 0; i < kClouds; ++i) {
      cloud.header.stamp = now - ros::Duration(kCloudDelay * (kClouds - i) / (kClouds + 1));
      drive_.sendCloud(cloud);
    }
  }

  TrackArrivals arrivals_;  // subscribes first: its transport hints are used for all
  PacedDrive drive_;
  TurningSick scanner_{kPort, ros::param::param("~scan_rate", 16.6)};
  std::size_t scans_ = 0;
  std::map<ros::Time, std::size_t> numbers_;  ///< of the scans, by their stamps

 private:
  ros::NodeHandle node_;
  ros::Subscriber scan_;
  ros::Subscriber stereo_objects_;
  std::size_t stereo_lists_ = 0;
};

TEST_F(LiveDevicesTest, EachScanLeadsToTracksOrIsCountedAsDropped) {
  PacedRates rates;
  rates.motion = kMotionRate;
  rates.clouds = ros::param::param("~cloud_rate", 12.0);
  rates.cloud_delay = kCloudDelay;
  ASSERT_TRUE(drive_.waitFor([this] { return !drive_.diagnosticMessage("device").empty(); }));
  ASSERT_TRUE(drive_.start(
      {"moving_objects", "tracker", "stereo_objects", "stereo_tracker", "track_fusion"}));
  ASSERT_TRUE(drive_.waitFor([this] { return receivesScans(); }));
  ASSERT_NO_THROW(scanner_.connect());  // last: a device that is silent for long is given up
  scanner_.begin([this] { return drive_.now(); });
  drive_.run(ros::param::param("~seconds", 3.0), rates);
  EXPECT_TRUE(drive_.run(kPatience, rates, [this] {
    return count("stereo_tracker", "processed") > 0.0 && arrivals_.count() > 0;
  })) << "no tracks, or none of the camera";
  scanner_.stop();
  const double seconds = drive_.now();

  // Sends nothing more, so that the diagnostics catch up.
  EXPECT_TRUE(drive_.run(kPatience, {}, [this] { return isEachScanAccountedFor(); }))
      << stages().dump(1);
  EXPECT_EQ(static_cast<double>(numbers_.size()), count("device", "processed"))
      << "each scan has a stamp of its own";
  const std::vector<double> found = latencies();
  const nlohmann::json figures = {{"seconds", seconds},
                                  {"scans", sent()},
                                  {"without_tracks", sent() - static_cast<double>(found.size())},
                                  {"tracks", latencySummary(found)},
                                  {"clouds", drive_.sent("stereo/points2")},
                                  {"without_clouds", count("track_fusion", "fused without stereo")},
                                  {"stages", stages()}};
  writeFigures(figures, "latencies_s", found);

  EXPECT_TRUE(dropsCloudsThatWaited(rates))
      << drive_.diagnosticText("stereo_objects", "last error");
  const double processed = count("stereo_objects", "processed");
  EXPECT_TRUE(drive_.run(kPatience, rates, [&] {
    return count("stereo_objects", "processed") > processed;
  })) << "newer clouds are not processed";
}

}  // namespace
}  // namespace datmo::live_devices_test
