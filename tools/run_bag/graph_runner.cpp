// SPDX-License-Identifier: BSD-3-Clause
#include "graph_runner.h"

#include <algorithm>
#include <iterator>

#include "stage_types.h"

#include "datmo_fusion/ros/stage/grid_slam_stage.h"
#include "datmo_fusion/ros/stage/guard.h"
#include "datmo_fusion/ros/transform_topics.h"

namespace datmo {

namespace {

/// The graph up to the last stage, or all of it.
std::vector<GraphStage> graphUntil(const GraphSwitches& switches, const std::string& last) {
  std::vector<GraphStage> graph = stageGraph(switches);
  const auto is_last = [&last](const GraphStage& stage) { return stage.type == last; };
  const auto after = std::find_if(graph.rbegin(), graph.rend(), is_last).base();
  if (after != graph.begin()) {
    graph.erase(after, graph.end());
  }
  return graph;
}

OptionValues valuesOf(const GraphStage& row, const SensorSet& sensors) {
  OptionValues values = sensors.values(row.name);
  for (const auto& [key, value] : row.parameters) {
    values[key] = value;
  }
  return values;
}

}  // namespace

/// The ports of one stage.
class GraphRunner::Ports : public StagePorts {
 public:
  Ports(GraphRunner& runner, Node& node) : runner_(runner), node_(node) {}

 private:
  void addInput(StageInput input) override { node_.inputs.push_back(std::move(input)); }

  StageOutput::Publish addOutput(StageOutput output) override {
    node_.outputs.push_back(output.topic);
    return [&runner = runner_, topic = node_.row.resolved(output.topic), type = output.data_type,
            content = output.content,
            check = std::make_shared<OutputCheck>(output.topic, *node_.monitor)](
               const AnyMessage& message) {
      if (check->passes(content(message))) {
        runner.publish({topic, type, message});
      }
    };
  }

  GraphRunner& runner_;
  Node& node_;
};

GraphRunner::GraphRunner(const SensorSet& sensors, const GraphSwitches& switches,
                         const std::string& last_stage)
    : GraphRunner(sensors, graphUntil(switches, last_stage)) {}

GraphRunner::GraphRunner(const SensorSet& sensors, const std::vector<GraphStage>& graph)
    : shared_(sensors.shared()),
      transforms_(sensors.options<GridSlamStageOptions>("grid_slam").input.restart_after, shared_,
                  inputs_monitor_) {
  for (const GraphStage& row : graph) {
    addStage(row, sensors);
  }
}

void GraphRunner::addStage(const GraphStage& row, const SensorSet& sensors) {
  Node node{row, std::make_unique<StageMonitor>(row.name), nullptr, {}, {}, nullptr};
  node.stage = stageTypeNamed(row.type).make(valuesOf(row, sensors), shared_,
                                             {transforms_, *node.monitor, StepClock()});
  Ports ports(*this, node);
  node.stage->connect(ports);
  node.health = std::make_unique<StageHealth>(
      watchedInputs(node.inputs, [&row](const std::string& topic) { return row.resolved(topic); }),
      StreamOptions().silence_after);
  nodes_.push_back(std::move(node));
}

void GraphRunner::handleStaticTransforms(const tf2_msgs::TFMessage& message) {
  transforms_.addStatic(message);
}

bool GraphRunner::isFromSlam(const geometry_msgs::TransformStamped& transform) const {
  const FrameOptions& frames = shared_.frames;
  return transform.child_frame_id == frames.odom ||
         (!shared_.motion.fromOdometry() && transform.child_frame_id == frames.base);
}

Publications GraphRunner::handleTransforms(const tf2_msgs::TFMessage& message, Stamp now) {
  tf2_msgs::TFMessage others = message;
  auto& transforms = others.transforms;
  transforms.erase(std::remove_if(transforms.begin(), transforms.end(),
                                  [&](const auto& transform) { return isFromSlam(transform); }),
                   transforms.end());
  inputs_monitor_.setTime(now);
  transforms_.add(others);
  return settle(now);
}

Publications GraphRunner::handle(const Publication& message, Stamp now) {
  deliver(message);
  return settle(now);
}

Publications GraphRunner::finish(Stamp now) {
  Publications all;
  Stamp end = now;
  for (std::size_t stage = 0; stage < nodes_.size(); ++stage) {
    end = end + nodes_[stage].stage->maxWait();
    Publications published = settle(end, stage);
    std::move(published.begin(), published.end(), std::back_inserter(all));
  }
  return all;
}

Publications GraphRunner::settle(Stamp now, std::size_t first) {
  do {
    while (!waiting_.empty()) {
      serveNext(now);
    }
  } while (publishNext(now, first));
  return std::exchange(published_, {});
}

void GraphRunner::serveNext(Stamp now) {
  const auto served = waiting_.extract(waiting_.begin());
  const auto& [stage, index, age] = served.key();
  Node& node = nodes_[stage];
  const StageInput& input = node.inputs[index];
  node.monitor->received(input.booked_as, now);
  guarded(*node.monitor, input.topic, [&] { input.callback(served.mapped(), now); });
  bookTime(node);
}

bool GraphRunner::publishNext(Stamp now, std::size_t first) {
  for (std::size_t stage = first; stage < nodes_.size(); ++stage) {
    if (nodes_[stage].stage->publishNext(now)) {
      bookTime(nodes_[stage]);
      return true;
    }
  }
  return false;
}

void GraphRunner::deliver(const Publication& message) {
  bool is_changed = !change_;
  AnyMessage given = message.message;
  for (std::size_t stage = 0; stage < nodes_.size(); ++stage) {
    const Node& node = nodes_[stage];
    for (std::size_t input = 0; input < node.inputs.size(); ++input) {
      if (node.row.resolved(node.inputs[input].topic) == message.topic &&
          node.inputs[input].data_type == message.data_type) {
        given = is_changed ? given : change_(message);
        is_changed = true;
        if (!given) {
          return;
        }
        waiting_.emplace(Turn(stage, input, delivered_++), given);
      }
    }
  }
}

std::vector<StageState> GraphRunner::states(Stamp now) {
  const PublishedType nobody = [](const std::string& /*topic*/) { return std::string(); };
  std::vector<StageState> states;
  for (Node& node : nodes_) {
    StageState state = node.health->judge(*node.monitor, now, nobody);
    state.topics = topicsOf(node.inputs, node.outputs,
                            [&node](const std::string& topic) { return node.row.resolved(topic); });
    states.push_back(std::move(state));
  }
  return states;
}

void GraphRunner::publish(const Publication& message) {
  if (message.topic == kTransformTopic) {
    transforms_.add(*message.as<tf2_msgs::TFMessage>());
  } else if (message.topic == kStaticTransformTopic) {
    transforms_.addStatic(*message.as<tf2_msgs::TFMessage>());
  }
  published_.push_back(message);
  deliver(message);
}

void GraphRunner::bookTime(Node& node) {
  if (node.monitor->processedCount() > node.timed) {
    node.timed = node.monitor->processedCount();
    times_.add(node.row.name, node.monitor->lastProcessed().seconds);
  }
}

bool GraphRunner::has(const std::string& stage) const {
  return std::any_of(nodes_.begin(), nodes_.end(),
                     [&stage](const Node& node) { return node.row.name == stage; });
}

Stage& GraphRunner::stageNamed(const std::string& name) const {
  return *std::find_if(nodes_.begin(), nodes_.end(), [&name](const Node& node) {
            return node.row.name == name;
          })->stage;
}

std::vector<const StageMonitor*> GraphRunner::monitors() const {
  std::vector<const StageMonitor*> monitors{&inputs_monitor_};
  for (const Node& node : nodes_) {
    monitors.push_back(node.monitor.get());
  }
  return monitors;
}

std::vector<const StageMonitor*> GraphRunner::inputMonitors() const {
  std::vector<const StageMonitor*> monitors{&inputs_monitor_};
  for (const Node& node : nodes_) {
    if (node.row.type != "tracker") {
      monitors.push_back(node.monitor.get());
    }
  }
  return monitors;
}

}  // namespace datmo
