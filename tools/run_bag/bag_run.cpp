#include "bag_run.h"

#include <map>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "drive_summary.h"
#include "input_bag.h"
#include "interruption.h"
#include "output_bag.h"
#include "pipeline.h"
#include "progress_bar.h"
#include "whole_file.h"

#include <rosbag/view.h>

#include "datmo_fusion/ros/stamp_check.h"

namespace datmo {

namespace {

const std::string kTruthPrefix = "/ground_truth/";

/// The names that our inputs have in the bag.
struct InputTopics {
  std::string scan;
  std::string echoes;
  std::string odometry;
  std::vector<std::string> truth;

  std::vector<std::string> all() const {
    std::vector<std::string> topics = truth;
    topics.insert(topics.end(), {scan, echoes, odometry, "/tf"});
    return topics;
  }
};

std::vector<std::string> truthTopics(const rosbag::Bag& bag) {
  rosbag::View view(bag);
  std::vector<std::string> topics;
  for (const rosbag::ConnectionInfo* connection : view.getConnections()) {
    if (connection->topic.rfind(kTruthPrefix, 0) == 0) {
      topics.push_back(connection->topic);
    }
  }
  return topics;
}

InputTopics findTopics(const rosbag::Bag& bag, const Arguments& arguments, bool odometry_wanted) {
  InputTopics topics{arguments.inputTopic("scan"),
                     arguments.inputTopic("echoes"),
                     arguments.inputTopic("odometry"),
                     {}};
  const bool scans = holdsTopic(bag, topics.scan);
  const bool echoes = holdsTopic(bag, topics.echoes);
  if (!scans && !echoes) {
    failForTopic(bag, "neither a LaserScan on " + topics.scan + " nor a MultiEchoLaserScan on " +
                          topics.echoes);
  }
  if (odometry_wanted && !holdsTopic(bag, topics.odometry)) {
    failForTopic(bag, "no odometry on " + topics.odometry +
                          " (without any, set grid_slam/odometry to false in " + arguments.config +
                          ")");
  }
  if (arguments.with_truth) {
    topics.truth = truthTopics(bag);
  }
  return topics;
}

/// Carries the messages of a bag to the pipeline, and what comes of them to another bag.
class BagRun {
 public:
  BagRun(const InputTopics& topics, Pipeline& pipeline, DriveSummary& drive, OutputBag& output)
      : topics_(topics), pipeline_(pipeline), drive_(drive), output_(output) {}

  /// They hold for the whole bag, wherever in it they stand.
  void takeStaticTransforms(const rosbag::Bag& bag) {
    rosbag::View view(bag, rosbag::TopicQuery("/tf_static"));
    for (const rosbag::MessageInstance& message : view) {
      pipeline_.takeStaticTransforms(*read<tf2_msgs::TFMessage>(message));
    }
  }

  void take(const rosbag::MessageInstance& message) {
    const std::string& topic = message.getTopic();
    const ros::Time& time = message.getTime();
    const Stamp now = toStamp(time);
    if (topic == "/tf") {
      write(time, pipeline_.takeTransforms(*read<tf2_msgs::TFMessage>(message), now));
    } else if (topic == topics_.odometry) {
      pipeline_.takeOdometry(*read<nav_msgs::Odometry>(message));
    } else if (topic == topics_.scan) {
      write(time, pipeline_.takeScan(*read<sensor_msgs::LaserScan>(message), now));
    } else if (topic == topics_.echoes) {
      write(time, pipeline_.takeScan(*read<sensor_msgs::MultiEchoLaserScan>(message), now));
    } else {
      output_.copy(message);
    }
  }

 private:
  void write(const ros::Time& time, const Pipeline::Output& results) {
    drive_.add(results);
    if (results.slam) {
      writeSlam(time, *results.slam);
    }
    if (results.objects) {
      output_.write("/objects", time, *results.objects);
    }
    for (const TrackArrayPtr& tracks : results.tracks) {
      output_.write("/tracks", time, *tracks);
    }
    if (results.map) {
      output_.write("/map", time, *results.map);
    }
  }

  void writeSlam(const ros::Time& time, const GridSlamOutput& slam) {
    tf2_msgs::TFMessage transforms;
    transforms.transforms = slam.transforms;
    output_.write("/tf", time, transforms);
    output_.write("/pose", time, *slam.pose);
    output_.write("/split_scan", time, *slam.split_scan);
  }

  const InputTopics& topics_;
  Pipeline& pipeline_;
  DriveSummary& drive_;
  OutputBag& output_;
};

std::string speedNote(double data_seconds, double wall_seconds) {
  std::ostringstream note;
  note.precision(0);
  note << std::fixed << data_seconds << " s, " << data_seconds / wall_seconds << " x real time";
  return note.str();
}

double lengthOf(rosbag::View& view) { return (view.getEndTime() - view.getBeginTime()).toSec(); }

/// Messages by record time, and within one time transforms and odometry (false) before the scans
/// that need them (true).
using OrderedMessages = std::multimap<std::pair<ros::Time, bool>, rosbag::MessageInstance>;

OrderedMessages inOrder(rosbag::View& view, const InputTopics& topics) {
  OrderedMessages messages;
  for (const rosbag::MessageInstance& message : view) {
    const bool scan = message.getTopic() == topics.scan || message.getTopic() == topics.echoes;
    messages.emplace(std::make_pair(message.getTime(), scan), message);
  }
  return messages;
}

void carry(rosbag::View& view, const InputTopics& topics, BagRun& run, std::ostream* progress) {
  const double length = lengthOf(view);
  ProgressBar bar(progress);
  const Stopwatch watch;
  for (const auto& [order, message] : inOrder(view, topics)) {
    if (interrupted()) {
      throw std::runtime_error("interrupted, so that no bag is written");
    }
    run.take(message);
    const double done = (order.first - view.getBeginTime()).toSec();
    bar.show(length > 0.0 ? done / length : 1.0, speedNote(done, watch.seconds()));
  }
}

void checkScans(const std::string& file, const DriveSummary& drive, const Pipeline& pipeline) {
  if (drive.scans() > 0) {
    return;
  }
  std::string message = file + ": no scan could be used";
  for (const StageMonitor* monitor : pipeline.monitors()) {
    if (!monitor->lastError().empty()) {
      message += "; " + monitor->stage() + " says: " + monitor->lastError();
    }
  }
  throw std::runtime_error(message);
}

}  // namespace

void runBag(const Arguments& arguments, std::ostream& out, std::ostream* progress) {
  const PipelineOptions options = readPipelineOptions(arguments.config);
  rosbag::Bag bag;
  openInput(arguments.input, bag);
  const InputTopics topics = findTopics(bag, arguments, options.grid_slam.odometry);
  OutputBag output(arguments.output);
  Pipeline pipeline(options, arguments.last_stage);
  DriveSummary drive;
  BagRun run(topics, pipeline, drive, output);

  run.takeStaticTransforms(bag);
  rosbag::View view(bag, rosbag::TopicQuery(topics.all()));
  const Stopwatch watch;
  try {
    carry(view, topics, run, arguments.quiet ? nullptr : progress);
  } catch (const std::exception& error) {
    throw std::runtime_error(arguments.input + " to " + arguments.output + ": " + error.what());
  }
  const double took = watch.seconds();
  checkScans(arguments.input, drive, pipeline);
  if (!arguments.times.empty()) {
    writeWholeFile(arguments.times, toJson(pipeline.times()));
  }
  output.finish();
  if (!arguments.quiet) {
    printTable(out, drive, pipeline, lengthOf(view), took);
  }
}

}  // namespace datmo
