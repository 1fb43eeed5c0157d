// record_latency _output:=FILE.json
// How long the live chain takes, as another process sees it: from a scan's arrival here to the
// arrival of the tracks of the same stamp. The scan comes to the chain as it comes here, so that
// its transport cancels out; that of the tracks is counted. The map is listened to as rviz does, so
// that its way out is part of what the chain does. Times are the computer's.
//
// The file is written when the node ends:
//   first_scan, last_scan  s of the computer's monotonic clock, when they came
//   latency                s, one for each scan that led to tracks, in their order
//   unanswered             number of scans that did not
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

#include "datmo_fusion/ros/messages.h"

namespace datmo {
namespace {

class LatencyRecorder {
 public:
  LatencyRecorder() {
    const auto hints = ros::TransportHints().tcpNoDelay();
    const auto listen = [&](const std::string& topic, auto callback) {
      subscribers_.push_back(node_.subscribe(topic, kQueue, callback, this, hints));
    };
    listen("scan", &LatencyRecorder::takeScan<sensor_msgs::LaserScan>);
    listen("echoes", &LatencyRecorder::takeScan<sensor_msgs::MultiEchoLaserScan>);
    listen("tracks", &LatencyRecorder::takeTracks);
    listen("timing", &LatencyRecorder::takeTiming);
    listen("map", &LatencyRecorder::takeMap);
  }

  void write(std::ostream& out) const {
    out << std::setprecision(9) << "{\"first_scan\": " << secondsOf(first_scan_)
        << ", \"last_scan\": " << secondsOf(last_scan_) << ", \"latency\": ";
    writeList(out, latency_);
    out << ", \"unanswered\": " << arrivals_.size() << ", \"stages\": {";
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
  void takeScan(const boost::shared_ptr<const Message>& message) {
    last_scan_ = Clock::now();
    first_scan_ = first_scan_ == Clock::time_point() ? last_scan_ : first_scan_;
    arrivals_[message->header.stamp] = last_scan_;
  }

  void takeTracks(const TrackArrayConstPtr& message) {
    const auto scan = arrivals_.find(message->header.stamp);
    if (scan != arrivals_.end()) {
      latency_.push_back(std::chrono::duration<double>(Clock::now() - scan->second).count());
      arrivals_.erase(scan);
    }
  }

  void takeTiming(const StageTimingConstPtr& message) {
    stages_[message->stage].push_back(message->processing_time);
  }

  void takeMap(const nav_msgs::OccupancyGridConstPtr& /*message*/) {}

  static constexpr std::uint32_t kQueue = 100;

  ros::NodeHandle node_;
  std::vector<ros::Subscriber> subscribers_;
  std::map<ros::Time, Clock::time_point> arrivals_;  ///< of scans that wait for their tracks
  Clock::time_point first_scan_;
  Clock::time_point last_scan_;
  std::vector<double> latency_;
  std::map<std::string, std::vector<double>> stages_;
};

}  // namespace
}  // namespace datmo

int main(int argc, char** argv) {
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
