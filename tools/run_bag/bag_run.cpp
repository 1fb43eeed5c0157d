// SPDX-License-Identifier: BSD-3-Clause
#include "bag_run.h"

#include <algorithm>
#include <map>
#include <memory>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "bag_to_graph.h"
#include "command_line.h"
#include "drive_summary.h"
#include "graph_runner.h"
#include "input_bag.h"
#include "input_topics.h"
#include "interruption.h"
#include "matching_ahead.h"
#include "output_bag.h"
#include "progress_bar.h"
#include "stereo_images.h"

#include <rosbag/view.h>

#include "datmo_fusion/ros/stage/grid_slam_stage.h"
#include "datmo_fusion/ros/stage/loop_closing_stage.h"
#include "datmo_fusion/ros/stage/object_fusion_stage.h"
#include "datmo_fusion/ros/stage/track_fusion_stage.h"
#include "datmo_fusion/ros/whole_file.h"

namespace datmo {

namespace {

std::string speedNote(double data_seconds, double wall_seconds) {
  std::ostringstream note;
  note.precision(0);
  note << std::fixed << data_seconds << " s, " << data_seconds / wall_seconds << " x real time";
  return note.str();
}

double lengthOf(rosbag::View& view) { return (view.getEndTime() - view.getBeginTime()).toSec(); }

/// Messages by record time, and within one time transforms, odometry and calibrations (false)
/// before the scans and clouds that need them (true).
using OrderedMessages = std::multimap<std::pair<ros::Time, bool>, rosbag::MessageInstance>;

OrderedMessages inOrder(rosbag::View& view, const InputTopics& topics) {
  OrderedMessages messages;
  for (const rosbag::MessageInstance& message : view) {
    const std::string& topic = message.getTopic();
    const bool measured = topic == topics.scan || topic == topics.echoes || topic == topics.cloud ||
                          topic == topics.object_cloud || topic == topics.stereo.points ||
                          topics.scans.count(topic) > 0;
    messages.emplace(std::make_pair(message.getTime(), measured), message);
  }
  return messages;
}

void carry(rosbag::View& view, const InputTopics& topics, BagToGraph& run, std::ostream* progress) {
  const double length = lengthOf(view);
  ProgressBar bar(progress);
  const Stopwatch watch;
  for (const auto& [order, message] : inOrder(view, topics)) {
    if (interrupted()) {
      throw std::runtime_error("interrupted, no bag written");
    }
    run.handle(message);
    const double done = (order.first - view.getBeginTime()).toSec();
    bar.show(length > 0.0 ? done / length : 1.0, speedNote(done, watch.seconds()));
  }
  run.finish(view.getEndTime());
}

void checkResults(const Arguments& arguments, const DriveSummary& drive, const GraphRunner& graph) {
  const bool scans_used = (graph.has("grid_slam") ? drive.scans() : drive.fusedGrids()) > 0;
  if (scans_used && (!graph.has("tracker") || drive.trackLists() > 0)) {
    return;
  }
  std::string message = arguments.input + (scans_used ? ": no list of tracks was published"
                                                      : ": no scan could be used");
  for (const StageMonitor* monitor : graph.monitors()) {
    if (!monitor->lastError().empty()) {
      message += "; " + monitor->stage() + " reports: " + monitor->lastError();
    }
  }
  throw NoUsableInput(message);
}

/// Options that only the command line sets.
GraphSwitches switchesOf(const Arguments& arguments) {
  GraphSwitches switches;
  static_cast<StackSwitches&>(switches) = arguments;
  return switches;
}

SensorSet readSensorsFor(const Arguments& arguments) {
  SensorSet sensors(arguments.config, arguments.presets);
  if (!arguments.grid_rule.empty()) {
    sensors.set("grid_fusion", "rule", arguments.grid_rule);
  }
  for (const GraphStage& stage : stageGraph(switchesOf(arguments))) {
    for (const auto& [key, value] : stage.parameters) {
      if (key.rfind("sources/", 0) == 0) {  // the required topics depend on these
        sensors.set(stage.name, key, value);
      }
    }
  }
  if (!arguments.map.empty()) {
    sensors.set("grid_slam", "prior_map/file", arguments.map);
    sensors.set("map_fusion", "prior_map", arguments.map);
  }
  if (!arguments.start.empty()) {
    sensors.set("grid_slam", "prior_map/anywhere", false);
    sensors.set("grid_slam", "prior_map/x", arguments.start[0]);
    sensors.set("grid_slam", "prior_map/y", arguments.start[1]);
    sensors.set("grid_slam", "prior_map/heading", degrees(arguments.start[2]));
  }
  return sensors;
}

bool usesStereo(const std::vector<std::string>& sources) {
  return std::find(sources.begin(), sources.end(), "stereo") != sources.end();
}

GraphSwitches switchesOf(const Arguments& arguments, const SensorSet& sensors,
                         const InputTopics& topics) {
  GraphSwitches switches = switchesOf(arguments);
  switches.scan_from_cloud = !topics.cloud.empty();
  switches.stereo = topics.stereo.input();
  switches.stereo_tracker =
      arguments.track_fusion &&
      usesStereo(sensors.options<TrackFusionStageOptions>("track_fusion").fuser.sourcesInUse());
  switches.stereo_objects =
      switches.stereo_tracker ||
      (arguments.object_fusion &&
       usesStereo(sensors.options<ObjectFusionStageOptions>("object_fusion").fuser.sourcesInUse()));
  return switches;
}

/// Null if there are no images to match, or only one thread.
std::unique_ptr<MatchingAhead> matchingAhead(const Arguments& arguments, const StereoTopics& topics,
                                             GraphRunner& graph) {
  const std::string stage = "stereo_image_proc";
  if (arguments.jobs < 2 || !graph.has(stage)) {
    return nullptr;
  }
  auto& images = graph.stage<StereoImages>(stage);
  auto ahead = std::make_unique<MatchingAhead>(arguments.input, topics, images.options(),
                                               static_cast<std::size_t>(arguments.jobs));
  images.matchWith([&match = *ahead](const StereoPair& pair) { return match.cloudOf(pair); });
  return ahead;
}

/// The optimized map, if there is one.
void saveMap(const GraphRunner& graph, const std::string& file) {
  if (graph.has("loop_closing")) {
    graph.stage<LoopClosingStage>("loop_closing").saveMap(file);
  } else {
    graph.stage<GridSlamStage>("grid_slam").saveMap(file);
  }
}

}  // namespace

void runBag(const Arguments& arguments, std::ostream& out, std::ostream* progress) {
  const SensorSet sensors = readSensorsFor(arguments);
  if (!arguments.times.empty()) {
    checkWritable(arguments.times);
  }
  if (!arguments.report.empty()) {
    checkWritable(arguments.report);
  }
  rosbag::Bag bag;
  openInput(arguments.input, bag);
  if (!arguments.save_map.empty()) {
    checkWritable(arguments.save_map);
  }
  const InputTopics topics = findTopics(bag, arguments, sensors);
  OutputBag output(arguments.output);
  GraphRunner graph(sensors, switchesOf(arguments, sensors, topics),
                    stageType(arguments.last_stage));
  const std::unique_ptr<MatchingAhead> ahead = matchingAhead(arguments, topics.stereo, graph);
  DriveSummary drive;
  BagToGraph run(topics, graph, drive, output, arguments);

  run.handleStaticTransforms(bag);
  rosbag::View view(bag, rosbag::TopicQuery(topics.all()));
  const Stopwatch watch;
  try {
    carry(view, topics, run, arguments.quiet ? nullptr : progress);
  } catch (const std::exception& error) {
    throw std::runtime_error(arguments.input + " to " + arguments.output + ": " + error.what());
  }
  const double took = watch.seconds();
  run.refusals().check();
  checkResults(arguments, drive, graph);
  const RunTime time{lengthOf(view), took};
  std::vector<NamedText> texts = run.text().files();
  if (!arguments.times.empty()) {
    texts.push_back({arguments.times, toJson(graph.times())});
  }
  if (!arguments.report.empty()) {
    texts.push_back(
        {arguments.report, run.report().json(drive, time, toStamp(view.getEndTime()), graph)});
  }
  // The largest files first: if the disk is full, no report stays behind of a run that has failed.
  output.close();
  if (!arguments.save_map.empty()) {
    saveMap(graph, arguments.save_map);
  }
  writeWholeFiles(texts);
  output.finish();
  if (!arguments.quiet) {
    printTable(out, drive, graph, run.refusals(), time);
  }
}

}  // namespace datmo
