// SPDX-License-Identifier: BSD-3-Clause
// record_latency _output:=FILE.json
// Measures the latency of the live chain from another process: forwards each scan from
// recorded/scan or recorded/echoes, and takes the time until the tracks with the same stamp arrive,
// including transport over TCP in both directions. It subscribes to the map, as rviz does, so that
// the map is serialized and sent as well.
//
// The file is written when the node ends:
//   first_scan, last_scan  s of the computer's monotonic clock, when they were forwarded
//   latency                s, of each scan that led to tracks, in order
//   unanswered             number of scans that did not lead to tracks
//   stages                 s, processing time of each message, by stage (StageTiming)
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include <nav_msgs/OccupancyGrid.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/MultiEchoLaserScan.h>

#include "datmo_fusion/ros/convert/messages.h"

namespace datmo {
namespace {

class LatencyRecorder {
 public:
  LatencyRecorder() {
    handOn<sensor_msgs::LaserScan>("scan");
    handOn<sensor_msgs::MultiEchoLaserScan>("echoes");
    listen<TrackArray>("tracks", [this](const auto& tracks) { handleTracks(*tracks); });
    listen<StageTiming>("timing", [this](const auto& timing) {
      stages_[timing->stage].push_back(timing->processing_time);
    });
    listen<nav_msgs::OccupancyGrid>("map", [](const auto& /*map*/) {});
  }

  void write(std::ostream& out) const {
    out << std::setprecision(9) << "{\"first_scan\": " << secondsOf(first_scan_)
        << ", \"last_scan\": " << secondsOf(last_scan_) << ", \"latency\": ";
    writeList(out, latency_);
    out << ", \"unanswered\": " << departures_.size() << ", \"stages\": {";
    const char* separator = "";
    for (const auto& [stage, seconds] : stages_) {
      out << separator << '"' << stage << "\": ";
      writeList(out, seconds);
      separator = ", ";
    }
    out << "}}\n";
  }

 private:
  using Clock = std::chrono::steady_clock;

  static double secondsOf(Clock::time_point time) {
    return std::chrono::duration<double>(time.time_since_epoch()).count();
  }

  static void writeList(std::ostream& out, const std::vector<double>& values) {
    const char* separator = "[";
    for (const double value : values) {
      out << separator << value;
      separator = ", ";
    }
    out << (values.empty() ? "[]" : "]");
  }

  template <typename Message>
  void listen(const std::string& topic,
              const boost::function<void(const boost::shared_ptr<const Message>&)>& callback) {
    subscribers_.push_back(node_.subscribe<Message>(topic, kQueue, callback, ros::VoidConstPtr(),
                                                    ros::TransportHints().tcpNoDelay()));
  }

  template <typename Message>
  void handOn(const std::string& topic) {
    const ros::Publisher publisher = node_.advertise<Message>(topic, kQueue);
    listen<Message>("recorded/" + topic, [this, publisher](const auto& scan) {
      noteDeparture(scan->header.stamp);
      publisher.publish(scan);
    });
  }

  void noteDeparture(const ros::Time& stamp) {
    last_scan_ = Clock::now();
    first_scan_ = first_scan_ == Clock::time_point() ? last_scan_ : first_scan_;
    departures_[stamp] = last_scan_;
  }

  void handleTracks(const TrackArray& tracks) {
    const auto scan = departures_.find(tracks.header.stamp);
    if (scan != departures_.end()) {
      latency_.push_back(std::chrono::duration<double>(Clock::now() - scan->second).count());
      departures_.erase(scan);
    }
  }

  static constexpr std::uint32_t kQueue = 100;

  ros::NodeHandle node_;
  std::vector<ros::Subscriber> subscribers_;
  std::map<ros::Time, Clock::time_point> departures_;  ///< of scans whose tracks have not arrived
  Clock::time_point first_scan_;
  Clock::time_point last_scan_;
  std::vector<double> latency_;
  std::map<std::string, std::vector<double>> stages_;
};

}  // namespace
}  // namespace datmo

int main(int argc, char** argv) {
  if (argc == 2 && std::string(argv[1]) == "--help") {
    std::cout << "usage: record_latency _output:=FILE.json, with the chain of live_load.launch\n";
    return EXIT_SUCCESS;
  }
  ros::init(argc, argv, "record_latency");
  const std::string file = ros::param::param<std::string>("~output", "");
  std::ofstream out(file);
  if (!out) {
    std::cerr << "record_latency: _output = '" << file << "': cannot be written\n";
    return EXIT_FAILURE;
  }
  datmo::LatencyRecorder recorder;
  ros::spin();
  recorder.write(out);
  return EXIT_SUCCESS;
}
