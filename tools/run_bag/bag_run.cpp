#include "bag_run.h"

#include <algorithm>
#include <functional>
#include <map>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "command_line.h"
#include "drive_summary.h"
#include "graph_runner.h"
#include "input_bag.h"
#include "input_refusals.h"
#include "input_topics.h"
#include "interruption.h"
#include "output_bag.h"
#include "progress_bar.h"
#include "text_outputs.h"
#include "whole_file.h"

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <geometry_msgs/TwistWithCovarianceStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/MultiEchoLaserScan.h>
#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/ros/frame_ids.h"
#include "datmo_fusion/ros/object_fusion_stage.h"
#include "datmo_fusion/ros/stamp_check.h"
#include "datmo_fusion/ros/track_fusion_stage.h"

namespace datmo {

namespace {

/// Carries the messages of a bag to the graph of stages, and what comes of them to another bag.
class BagRun {
 public:
  BagRun(const InputTopics& topics, GraphRunner& graph, DriveSummary& drive, OutputBag& output,
         const Arguments& arguments)
      : graph_(graph),
        drive_(drive),
        output_(output),
        write_grids_(arguments.write_grids),
        refusals_(graph.doors()),
        text_(arguments.text) {
    readMotion(topics);
    readScans(topics);
    readStereo(topics.stereo);
    for (const auto& [topic, source] : topics.grids) {
      on<nav_msgs::OccupancyGrid>(topic, "grids/" + source);
    }
    for (const auto& [topic, source] : topics.objects) {
      on<ObjectArray>(topic, "objects/" + source);
    }
    for (const auto& [topic, source] : topics.tracks) {
      on<TrackArray>(topic, "tracks/" + source);
    }
  }

  /// They hold for the whole bag, wherever in it they stand.
  void takeStaticTransforms(const rosbag::Bag& bag) {
    rosbag::View view(bag, rosbag::TopicQuery("/tf_static"));
    for (const rosbag::MessageInstance& message : view) {
      graph_.takeStaticTransforms(*plain<tf2_msgs::TFMessage>(message));
    }
  }

  void take(const rosbag::MessageInstance& message) {
    const auto reader = readers_.find(message.getTopic());
    if (reader == readers_.end()) {
      output_.copy(message);
      return;
    }
    write(message.getTime(), reader->second(message, toStamp(message.getTime())));
    refusals_.book(message.getTopic());
  }

  /// `end`: of the bag.
  void finish(const ros::Time& end) { write(end, graph_.finish(toStamp(end))); }

  const InputRefusals& refusals() const { return refusals_; }
  const TextOutputs& text() const { return text_; }

 private:
  using Reader = std::function<Publications(const rosbag::MessageInstance&, Stamp now)>;

  /// A topic of the bag is one of the graph's; one without name is not read.
  template <typename Message>
  void on(const std::string& topic, const std::string& graph_topic) {
    if (!topic.empty()) {
      readers_[topic] = [this, graph_topic](const rosbag::MessageInstance& message, Stamp now) {
        return graph_.take(graph_topic, plain<Message>(message), now);
      };
    }
  }

  /// A message with its frames as the stages take them.
  template <typename Message>
  boost::shared_ptr<const Message> plain(const rosbag::MessageInstance& message) {
    return withPlainFrames<Message>(message.getTopic(), read<Message>(message), graph_.inputs());
  }

  void readMotion(const InputTopics& topics) {
    readers_["/tf"] = [this](const rosbag::MessageInstance& message, Stamp now) {
      return graph_.takeTransforms(*plain<tf2_msgs::TFMessage>(message), now);
    };
    const MotionTopics& motion = topics.motion;
    on<nav_msgs::Odometry>(motion.odometry, "odometry");
    on<sensor_msgs::Imu>(motion.imu, "imu");
    on<geometry_msgs::TwistStamped>(motion.twist, "twist");
    on<geometry_msgs::TwistWithCovarianceStamped>(motion.twist_with_covariance,
                                                  "twist_with_covariance");
    on<sensor_msgs::JointState>(motion.joint_states, "joint_states");
  }

  void readScans(const InputTopics& topics) {
    on<sensor_msgs::LaserScan>(topics.scan, "scan");
    on<sensor_msgs::MultiEchoLaserScan>(topics.echoes, "echoes");
    on<sensor_msgs::PointCloud2>(topics.cloud, "cloud");
    on<sensor_msgs::PointCloud2>(topics.object_cloud, "cloud");
  }

  void readStereo(const StereoTopics& topics) {
    on<sensor_msgs::PointCloud2>(topics.points, "stereo/points2");
    on<sensor_msgs::Image>(topics.left_image, "stereo/left/image_rect");
    on<sensor_msgs::CameraInfo>(topics.left_info, "stereo/left/camera_info");
    on<sensor_msgs::Image>(topics.right_image, "stereo/right/image_rect");
    on<sensor_msgs::CameraInfo>(topics.right_info, "stereo/right/camera_info");
  }

  void write(const ros::Time& time, const Publications& published) {
    for (const Publication& publication : published) {
      drive_.add(publication);
      text_.add(publication);
      if (isResult(publication)) {
        writeAsOneOf<geometry_msgs::PoseWithCovarianceStamped, nav_msgs::OccupancyGrid,
                     sensor_msgs::LaserScan, sensor_msgs::PointCloud2, tf2_msgs::TFMessage,
                     LabeledScanMessage, RoadBorders, ObjectArray, DroppedObjects, TrackArray>(
            time, publication);
      }
    }
  }

  /// What lies between the stages alone is not written: grids on demand, odometry and clouds never.
  bool isResult(const Publication& publication) const {
    const bool is_grid = publication.topic.rfind("grids/", 0) == 0;
    const bool is_stereo = publication.topic.rfind("stereo/", 0) == 0;
    return is_grid ? write_grids_ : !is_stereo;
  }

  template <typename... Messages>
  void writeAsOneOf(const ros::Time& time, const Publication& publication) {
    (writeIf(time, publication.topic, publication.as<Messages>()), ...);
  }

  template <typename Message>
  void writeIf(const ros::Time& time, const std::string& topic,
               const boost::shared_ptr<const Message>& message) {
    if (message) {
      output_.write(topic.front() == '/' ? topic : "/" + topic, time, *message);
    }
  }

  GraphRunner& graph_;
  DriveSummary& drive_;
  OutputBag& output_;
  bool write_grids_;
  InputRefusals refusals_;
  TextOutputs text_;
  std::map<std::string, Reader> readers_;  ///< by topic
};

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
                          topic == topics.object_cloud || topic == topics.stereo.points;
    messages.emplace(std::make_pair(message.getTime(), measured), message);
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
  run.finish(view.getEndTime());
}

void checkResults(const Arguments& arguments, const DriveSummary& drive, const GraphRunner& graph) {
  const bool scans_used = (graph.has("grid_slam") ? drive.scans() : drive.fusedGrids()) > 0;
  if (scans_used && (!graph.has("tracker") || drive.trackLists() > 0)) {
    return;
  }
  std::string message =
      arguments.input + (scans_used ? ": no list of tracks came out" : ": no scan could be used");
  for (const StageMonitor* monitor : graph.monitors()) {
    if (!monitor->lastError().empty()) {
      message += "; " + monitor->stage() + " says: " + monitor->lastError();
    }
  }
  throw NoUsableInput(message);
}

SensorSet readSensorsFor(const Arguments& arguments) {
  SensorSet sensors(arguments.config);
  if (!arguments.grid_rule.empty()) {
    sensors.set("grid_fusion", "rule", arguments.grid_rule);
  }
  return sensors;
}

bool usesStereo(const std::vector<std::string>& sources) {
  return std::find(sources.begin(), sources.end(), "stereo") != sources.end();
}

GraphSwitches switchesOf(const Arguments& arguments, const SensorSet& sensors,
                         const InputTopics& topics) {
  GraphSwitches switches;
  switches.scan_from_cloud = !topics.cloud.empty();
  switches.stereo = topics.stereo.input();
  switches.low_level_fusion = arguments.low_level_fusion;
  switches.road_border = arguments.road_border;
  switches.static_points = arguments.static_points;
  switches.cloud_objects = arguments.cloud_objects;
  switches.object_fusion = arguments.object_fusion;
  switches.track_fusion = arguments.track_fusion;
  switches.stereo_tracker =
      arguments.track_fusion &&
      usesStereo(sensors.options<TrackFusionStageOptions>("track_fusion").fuser.sourcesInUse());
  switches.stereo_objects =
      switches.stereo_tracker ||
      (arguments.object_fusion &&
       usesStereo(sensors.options<ObjectFusionStageOptions>("object_fusion").fuser.sourcesInUse()));
  return switches;
}

}  // namespace

void runBag(const Arguments& arguments, std::ostream& out, std::ostream* progress) {
  const SensorSet sensors = readSensorsFor(arguments);
  if (!arguments.times.empty()) {
    checkWritable(arguments.times);
  }
  rosbag::Bag bag;
  openInput(arguments.input, bag);
  const InputTopics topics = findTopics(bag, arguments, sensors);
  OutputBag output(arguments.output);
  GraphRunner graph(sensors, switchesOf(arguments, sensors, topics),
                    stageType(arguments.last_stage));
  DriveSummary drive;
  BagRun run(topics, graph, drive, output, arguments);

  run.takeStaticTransforms(bag);
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
  if (!arguments.times.empty()) {
    writeWholeFile(arguments.times, toJson(graph.times()));
  }
  run.text().write();
  output.finish();
  if (!arguments.quiet) {
    printTable(out, drive, graph, run.refusals(), {lengthOf(view), took});
  }
}

}  // namespace datmo
