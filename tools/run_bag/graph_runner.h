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

/// Hosts the stages of a graph without a master. Messages go in one after the other, as they came,
/// and all that follows from one is done before the next; the same messages give the same results,
/// bit for bit.
///
/// Of the messages that wait, a stage nearer to the sensors is served first, and of those of one
/// stage the input that it declared first: the borders of a scan before the scan itself.
class GraphRunner {
 public:
  /// `last_stage`: the stages after it are left out; empty: none is. Throws OptionError.
  GraphRunner(const SensorSet& sensors, const GraphSwitches& switches,
              const std::string& last_stage = "");

  /// Some stages of a graph alone. Throws OptionError.
  GraphRunner(const SensorSet& sensors, const std::vector<GraphStage>& graph);

  /// What stages get from now on in place of a message; of those that some stage takes, also from
  /// another stage. Asked once for a message; null: it is lost, and no stage gets it. For trials of
  /// what a fault does.
  using Change = std::function<AnyMessage(const Publication& message)>;
  void changeInputs(Change change) { change_ = std::move(change); }

  void takeStaticTransforms(const tf2_msgs::TFMessage& message);

  /// What grid_slam publishes itself is left out: a bag of an earlier run may hold it. This and the
  /// following: what came of it, in the order in which it was made. `now`: when the message came.
  Publications takeTransforms(const tf2_msgs::TFMessage& message, Stamp now);

  /// A message on one of the graph's topics.
  template <typename Message>
  Publications take(const std::string& topic, const boost::shared_ptr<const Message>& message,
                    Stamp now) {
    return take({topic, ros::message_traits::datatype<Message>(), message}, now);
  }
  Publications take(const Publication& message, Stamp now);

  /// What is left when the last message came at `now`: nothing waits any longer.
  Publications finish(Stamp now);

  bool has(const std::string& stage) const;

  /// The stage of this name, which there must be, and which must be of this type.
  template <typename HostedStage>
  const HostedStage& stage(const std::string& name) const {
    return dynamic_cast<const HostedStage&>(stageNamed(name));
  }

  const StageTimes& times() const { return times_; }

  /// The same, and begins anew: they grow with the drive.
  StageTimes takeTimes() { return std::exchange(times_, {}); }
  std::vector<const StageMonitor*> monitors() const;

  /// Those of them that drop a message when it comes, if at all; a tracker does it when it has
  /// waited for too long.
  std::vector<const StageMonitor*> inputMonitors() const;

  /// How each stage does (stackHealth tells why there are no tracks). Faults are those since the
  /// last call; "nobody publishes it" is said of all that is silent. `now`: when the last message
  /// came.
  std::vector<StageState> states(Stamp now);

  /// Of what is wrong with messages before a stage has them.
  StageMonitor& inputs() { return inputs_monitor_; }
  const StageMonitor& inputs() const { return inputs_monitor_; }

 private:
  class Ports;

  struct Node {
    GraphStage row;
    std::unique_ptr<StageMonitor> monitor;
    std::unique_ptr<Stage> stage;
    std::vector<StageInput> inputs;
    std::vector<std::string> outputs;  ///< topics, as the stage calls them
    std::unique_ptr<StageHealth> health;
    std::uint64_t timed = 0;  ///< results
  };

  /// Which of the waiting messages comes first: by stage, input and age.
  using Turn = std::tuple<std::size_t, std::size_t, std::uint64_t>;

  const Stage& stageNamed(const std::string& name) const;
  void addStage(const GraphStage& row, const SensorSet& sensors);
  bool isFromSlam(const geometry_msgs::TransformStamped& transform) const;

  /// Hands the messages that wait to their stages until none does and no stage from `first` on has
  /// more.
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
