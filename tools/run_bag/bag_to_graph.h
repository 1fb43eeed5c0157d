// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <string>

#include "arguments.h"
#include "drive_summary.h"
#include "graph_runner.h"
#include "input_bag.h"
#include "input_refusals.h"
#include "input_topics.h"
#include "output_bag.h"
#include "run_report.h"
#include "text_outputs.h"

#include <rosbag/bag.h>

#include "datmo_fusion/ros/frame_ids.h"

namespace datmo {

/// Passes the messages of a bag to the graph of stages, and the results to another bag, to the
/// summary and to text files.
class BagToGraph {
 public:
  /// All but `topics` and `arguments` must outlive it.
  BagToGraph(const InputTopics& topics, GraphRunner& graph, DriveSummary& drive, OutputBag& output,
             const Arguments& arguments);

  /// Of the whole bag, regardless of their position in it.
  void handleStaticTransforms(const rosbag::Bag& bag);

  /// A message on a topic that no stage reads is copied.
  void handle(const rosbag::MessageInstance& message);

  /// `end`: end of the bag.
  void finish(const ros::Time& end) { write(end, graph_.finish(toStamp(end))); }

  const InputRefusals& refusals() const { return refusals_; }
  const TextOutputs& text() const { return text_; }
  const RunReport& report() const { return report_; }

 private:
  using Reader = std::function<Publications(const rosbag::MessageInstance&, Stamp now)>;

  /// Connects a topic of the bag to one of the graph, in addition to others that read it: the
  /// wheels and the steering may be joints of one message. A topic without a name is not read.
  template <typename Message>
  void on(const std::string& topic, const std::string& graph_topic) {
    if (!topic.empty()) {
      readers_[topic].try_emplace(
          graph_topic, [this, graph_topic](const rosbag::MessageInstance& message, Stamp now) {
            return graph_.handle(graph_topic, plain<Message>(message), now);
          });
    }
  }

  /// A message with its frames as the stages expect them.
  template <typename Message>
  boost::shared_ptr<const Message> plain(const rosbag::MessageInstance& message) {
    return withPlainFrames<Message>(message.getTopic(), read<Message>(message), graph_.inputs());
  }

  void readMotion(const InputTopics& topics);
  void readScans(const InputTopics& topics);
  void readStereo(const StereoTopics& topics);
  void readMono(const MonoTopics& topics);
  void readSources(const InputTopics& topics);

  void write(const ros::Time& time, const Publications& published);
  bool isResult(const Publication& publication) const;

  /// Throws std::logic_error for a message of none of these types.
  template <typename... Messages>
  void writeAsOneOf(const ros::Time& time, const Publication& publication);
  /// Whether there was a message of this type.
  template <typename Message>
  bool writeIf(const ros::Time& time, const std::string& topic,
               const boost::shared_ptr<const Message>& message);

  GraphRunner& graph_;
  DriveSummary& drive_;
  OutputBag& output_;
  bool write_grids_;
  InputRefusals refusals_;
  TextOutputs text_;
  RunReport report_;
  std::map<std::string, std::map<std::string, Reader>> readers_;  ///< by topic, and graph topic
};

}  // namespace datmo
