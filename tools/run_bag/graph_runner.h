// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "sensor_set.h"
#include "stage_times.h"
#include <tf2_msgs/TFMessage.h>

#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_graph.h"
#include "datmo_fusion/ros/transform_buffer.h"

namespace datmo {

/// What a stage has published.
struct Publication {
  std::string topic;  ///< the graph's
  std::string data_type;
  AnyMessage message;

  /// Null for a message of another type.
  template <typename Message>
  boost::shared_ptr<const Message> as() const {
    return data_type == ros::message_traits::datatype<Message>()
               ? boost::static_pointer_cast<const Message>(message)
               : nullptr;
  }
};

using Publications = std::vector<Publication>;

/// Hosts the stages of a graph without a master. Messages are passed in one by one, in their order
/// of arrival, and everything that follows from one is processed before the next; the same messages
/// give the same results, bit for bit.
///
/// Of the waiting messages, those of stages nearer to the sensors are processed first, and within a
/// stage those of the input that was declared first: the borders of a scan before the scan itself.
class GraphRunner {
 public:
  /// `last_stage`: the stages after it are omitted; empty: none. Throws OptionError.
  GraphRunner(const SensorSet& sensors, const GraphSwitches& switches,
              const std::string& last_stage = "");

  /// Only some stages of a graph. Throws OptionError.
  GraphRunner(const SensorSet& sensors, const std::vector<GraphStage>& graph);

  /// Sets a function that replaces messages from now on: each message that some stage reads, also
  /// those from other stages. It is called once per message; null: the message is lost. For tests
  /// with faults.
  using Change = std::function<AnyMessage(const Publication& message)>;
  void changeInputs(Change change) { change_ = std::move(change); }

  void handleStaticTransforms(const tf2_msgs::TFMessage& message);

  /// Transforms that grid_slam publishes itself are ignored, as a bag of an earlier run may contain
  /// them. This and the following functions return the results, in the order in which they were
  /// published. `now`: arrival time of the message.
  Publications handleTransforms(const tf2_msgs::TFMessage& message, Stamp now);

  /// A message on one of the graph's topics.
  template <typename Message>
  Publications handle(const std::string& topic, const boost::shared_ptr<const Message>& message,
                      Stamp now) {
    return handle({topic, ros::message_traits::datatype<Message>(), message}, now);
  }
  Publications handle(const Publication& message, Stamp now);

  /// The remaining results if the last message arrived at `now`: nothing waits any longer.
  Publications finish(Stamp now);

  bool has(const std::string& stage) const;

  /// The stage of this name, which must exist and be of this type.
  template <typename HostedStage>
  const HostedStage& stage(const std::string& name) const {
    return dynamic_cast<const HostedStage&>(stageNamed(name));
  }

  template <typename HostedStage>
  HostedStage& stage(const std::string& name) {
    return dynamic_cast<HostedStage&>(stageNamed(name));
  }

  const StageTimes& times() const { return times_; }

  /// The same, and clears them, as they grow with the drive.
  StageTimes takeTimes() { return std::exchange(times_, {}); }
  std::vector<const StageMonitor*> monitors() const;

  /// Those that drop a message on arrival, if at all; a tracker drops it when it has waited for too
  /// long.
  std::vector<const StageMonitor*> inputMonitors() const;

  /// The health of each stage (stackHealth tells why there are no tracks). Faults are those since
  /// the last call; "it has no publisher" is reported for every silent topic. `now`: arrival time
  /// of the last message.
  std::vector<StageState> states(Stamp now);

  /// Of faults of messages before they reach a stage.
  StageMonitor& inputs() { return inputs_monitor_; }
  const StageMonitor& inputs() const { return inputs_monitor_; }

 private:
  class Ports;

  struct Node {
    GraphStage row;
    std::unique_ptr<StageMonitor> monitor;
    std::unique_ptr<Stage> stage;
    std::vector<StageInput> inputs;
    std::vector<std::string> outputs;  ///< topics, by the stage's names
    std::unique_ptr<StageHealth> health;
    std::uint64_t timed = 0;  ///< results
  };

  /// Which of the waiting messages comes first: by stage, input and age.
  using Turn = std::tuple<std::size_t, std::size_t, std::uint64_t>;

  Stage& stageNamed(const std::string& name) const;
  void addStage(const GraphStage& row, const SensorSet& sensors);
  bool isFromSlam(const geometry_msgs::TransformStamped& transform) const;

  /// Passes the waiting messages to their stages until none is left and no stage from `first` on
  /// has more.
  Publications settle(Stamp now, std::size_t first = 0);
  void serveNext(Stamp now);
  bool publishNext(Stamp now, std::size_t first);
  void deliver(const Publication& message);
  void publish(const Publication& message);
  void bookTime(Node& node);

  SharedOptions shared_;
  StageMonitor inputs_monitor_{"inputs"};
  TransformBuffer transforms_;
  Change change_;  ///< empty: none
  std::vector<Node> nodes_;
  std::map<Turn, AnyMessage> waiting_;
  std::uint64_t delivered_ = 0;
  Publications published_;
  StageTimes times_;
};

}  // namespace datmo
