// SPDX-License-Identifier: BSD-3-Clause
// Assesses the risks of a run of run_bag again: from the same tracks, with another method or other
// options.
#include <algorithm>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "command_line.h"
#include "graph_runner.h"
#include "input_bag.h"
#include "output_bag.h"
#include "sensor_set.h"
#include "yaml_options.h"

#include <geometry_msgs/AccelWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/view.h>
#include <sensor_msgs/JointState.h>

#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/convert/risk_conversion.h"
#include "datmo_fusion/ros/frame_ids.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace {

using namespace datmo;  // NOLINT: a program

using Steering = sensor_msgs::JointState;
using Acceleration = geometry_msgs::AccelWithCovarianceStamped;

constexpr char kStage[] = "risk";
constexpr char kTruth[] = "/ground_truth/";

struct Arguments {
  std::string run;
  std::string drive;
  std::string output;
  std::string config;
  std::string odometry = "/odometry";
  std::string steering;      ///< empty: /steering, if there is one
  std::string acceleration;  ///< the same
  OptionValues overrides;
};

Arguments parse(const std::vector<std::string>& words) {
  Arguments arguments;
  std::vector<std::string> overrides;
  CommandLine line(
      "replay_risks",
      "Assesses the risks of a run of run_bag again, from its tracks, scans and borders and the\n"
      "odometry, steering and acceleration of the drive, and writes /risks and the ground truth.\n"
      "With the run's options the risks are the same bit for bit. Only for sensor sets with\n"
      "`motion: {source: odometry}`.",
      "bags");
  line.addFile("RUN.bag", arguments.run, "output of run_bag, with the ground truth by --with-truth")
      ->required();
  line.addFile("DRIVE.bag", arguments.drive, "input of that run")->required();
  line.addFile("OUT.bag", arguments.output, "for the risks")->required();
  line.addFile("--config", arguments.config, "the sensor set of the run; required", "CONFIG.yaml")
      ->required();
  line.addFile("--odometry", arguments.odometry, "its topic in DRIVE.bag (default /odometry)",
               "TOPIC");
  line.addFile("--steering", arguments.steering, "its topic (default /steering, if there is one)",
               "TOPIC");
  line.addFile("--acceleration", arguments.acceleration,
               "its topic (default /acceleration, if there is one)", "TOPIC");
  line.addRepeated("--set", overrides, "an option of the risk assessment, e.g. method=thesis",
                   "KEY=VALUE");
  line.read(words);
  for (const std::string& assignment : overrides) {
    setOption(assignment, arguments.overrides);
  }
  for (const std::string& input : {arguments.run, arguments.drive}) {
    if (isSameFile(input, arguments.output)) {
      throw UsageError(arguments.output + ": the output must not be an input");
    }
  }
  return arguments;
}

SensorSet sensorsOf(const Arguments& arguments) {
  SensorSet sensors(arguments.config);
  for (const auto& [key, value] : arguments.overrides) {
    sensors.set(kStage, key, value);
  }
  if (!sensors.shared().motion.fromOdometry()) {
    throw UsageError(arguments.config +
                     ": motion/source: expected odometry, of which the drive has messages");
  }
  return sensors;
}

/// Only the risk stage.
std::vector<GraphStage> riskAlone(bool road_borders) {
  GraphSwitches switches;
  switches.risk = true;
  switches.road_border = road_borders;
  std::vector<GraphStage> graph = stageGraph(switches);
  graph.erase(std::remove_if(graph.begin(), graph.end(),
                             [](const GraphStage& stage) { return stage.name != kStage; }),
              graph.end());
  return graph;
}

/// Passes recorded messages to the risk stage in the same way as run_bag.
class Replay {
 public:
  Replay(const Arguments& arguments, const rosbag::Bag& run)
      : graph_(sensorsOf(arguments), riskAlone(holdsTopic(run, "/road_borders"))),
        output_(arguments.output) {
    // Messages of one time, in the order of the stage's inputs; in run_bag odometry precedes scans.
    on<nav_msgs::Odometry>(arguments.odometry, "odometry");
    on<Steering>(arguments.steering, "steering");
    on<Acceleration>(arguments.acceleration, "acceleration");
    on<RoadBorders>("/road_borders", "road_borders");
    on<LabeledScanMessage>("/labeled_scan", "labeled_scan");
    on<TrackArray>("/tracks", "tracks");
  }

  void add(rosbag::View& view) {
    for (const rosbag::MessageInstance& message : view) {
      const std::string& topic = message.getTopic();
      if (ranks_.count(topic) > 0) {
        messages_.emplace(std::make_pair(message.getTime(), ranks_.at(topic)), message);
      } else if (topic.rfind(kTruth, 0) == 0) {
        output_.copy(message);
      }
    }
  }

  void finish() {
    for (const auto& [order, message] : messages_) {
      for (const Publication& each : readers_[order.second](message)) {
        output_.write("/risks", order.first, *each.as<RiskArray>());
      }
    }
    output_.finish();
  }

 private:
  template <typename Message>
  void on(const std::string& topic, const std::string& graph_topic) {
    ranks_[topic] = readers_.size();
    readers_.push_back([this, graph_topic](const rosbag::MessageInstance& message) {
      const boost::shared_ptr<const Message> plain =
          withPlainFrames<Message>(message.getTopic(), read<Message>(message), graph_.inputs());
      return graph_.handle(graph_topic, plain, toStamp(message.getTime()));
    });
  }

  GraphRunner graph_;
  OutputBag output_;
  std::map<std::string, std::size_t> ranks_;
  std::vector<std::function<Publications(const rosbag::MessageInstance&)>> readers_;
  std::multimap<std::pair<ros::Time, std::size_t>, rosbag::MessageInstance> messages_;
};

/// `asked`: as the user named it; empty: `usual`, if the drive has it.
template <typename Message>
std::string hostTopic(const rosbag::Bag& drive, const std::string& asked,
                      const std::string& usual) {
  return optionalTopic<Message>(drive, asked.empty() ? usual : asked, !asked.empty());
}

void replay(Arguments arguments) {
  rosbag::Bag run;
  rosbag::Bag drive;
  openInput(arguments.run, run);
  openInput(arguments.drive, drive);
  for (const auto& [bag, topic] :
       {std::make_pair(&run, std::string("/tracks")), std::make_pair(&drive, arguments.odometry)}) {
    if (!holdsTopic(*bag, topic)) {
      failForTopic(*bag, "no " + topic);
    }
  }
  arguments.steering = hostTopic<Steering>(drive, arguments.steering, "/steering");
  arguments.acceleration = hostTopic<Acceleration>(drive, arguments.acceleration, "/acceleration");
  Replay replayed(arguments, run);
  rosbag::View results(run);
  std::vector<std::string> topics{arguments.odometry};
  for (const std::string& topic : {arguments.steering, arguments.acceleration}) {
    if (!topic.empty()) {
      topics.push_back(topic);
    }
  }
  rosbag::View motion(drive, rosbag::TopicQuery(topics));
  replayed.add(results);
  replayed.add(motion);
  replayed.finish();
}

}  // namespace

int main(int count, char** words) {
  return runProgram("replay_risks", EXIT_FAILURE, count, words,
                    [](const auto& given) { replay(parse(given)); });
}
