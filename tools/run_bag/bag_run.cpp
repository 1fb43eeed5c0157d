#include "bag_run.h"

#include <functional>
#include <map>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "drive_summary.h"
#include "input_bag.h"
#include "input_refusals.h"
#include "input_topics.h"
#include "interruption.h"
#include "output_bag.h"
#include "pipeline.h"
#include "progress_bar.h"
#include "text_outputs.h"
#include "whole_file.h"

#include <rosbag/view.h>

#include "datmo_fusion/ros/frame_ids.h"
#include "datmo_fusion/ros/stamp_check.h"

namespace datmo {

namespace {

/// Carries the messages of a bag to the pipeline, and what comes of them to another bag.
class BagRun {
 public:
  BagRun(const InputTopics& topics, Pipeline& pipeline, DriveSummary& drive, OutputBag& output,
         const Arguments& arguments)
      : pipeline_(pipeline),
        drive_(drive),
        output_(output),
        write_grids_(arguments.write_grids),
        refusals_(pipeline.doors()),
        text_(arguments.text) {
    readMotion(topics);
    readScans(topics);
    readStereo(topics.stereo);
    for (const auto& [topic, source] : topics.grids) {
      on<nav_msgs::OccupancyGrid>(topic, [this, name = source](const auto& message, Stamp now) {
        return pipeline_.takeGrid(name, *message, now);
      });
    }
    for (const auto& [topic, source] : topics.objects) {
      on<ObjectArray>(topic, [this, name = source](const auto& message, Stamp now) {
        return pipeline_.takeObjects(name, message, now);
      });
    }
    for (const auto& [topic, source] : topics.tracks) {
      on<TrackArray>(topic, [this, name = source](const auto& message, Stamp now) {
        return pipeline_.takeTracks(name, *message, now);
      });
    }
  }

  /// They hold for the whole bag, wherever in it they stand.
  void takeStaticTransforms(const rosbag::Bag& bag) {
    rosbag::View view(bag, rosbag::TopicQuery("/tf_static"));
    for (const rosbag::MessageInstance& message : view) {
      pipeline_.takeStaticTransforms(*plain<tf2_msgs::TFMessage>(message));
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
  void finish(const ros::Time& end) { write(end, pipeline_.finish(toStamp(end))); }

  const InputRefusals& refusals() const { return refusals_; }
  const TextOutputs& text() const { return text_; }

 private:
  using Reader = std::function<Pipeline::Output(const rosbag::MessageInstance&, Stamp now)>;

  /// `take(message, now)` takes the messages of a topic; one without name is not read.
  template <typename Message, typename Take>
  void on(const std::string& topic, const Take& take) {
    if (!topic.empty()) {
      readers_[topic] = [this, take](const rosbag::MessageInstance& message, Stamp now) {
        return take(plain<Message>(message), now);
      };
    }
  }

  /// A message with its frames as the stages take them.
  template <typename Message>
  boost::shared_ptr<const Message> plain(const rosbag::MessageInstance& message) {
    return withPlainFrames<Message>(message.getTopic(), read<Message>(message), pipeline_.inputs());
  }

  void readMotion(const InputTopics& topics) {
    on<tf2_msgs::TFMessage>("/tf", [this](const auto& message, Stamp now) {
      return pipeline_.takeTransforms(*message, now);
    });
    const MotionTopics& motion = topics.motion;
    on<nav_msgs::Odometry>(motion.odometry, [this](const auto& message, Stamp now) {
      return pipeline_.takeOdometry(*message, now);
    });
    on<sensor_msgs::Imu>(motion.imu, [this](const auto& message, Stamp now) {
      return pipeline_.takeImu(*message, now);
    });
    const auto take_twist = [this](const auto& message, Stamp now) {
      return pipeline_.takeTwist(*message, now);
    };
    on<geometry_msgs::TwistStamped>(motion.twist, take_twist);
    on<geometry_msgs::TwistWithCovarianceStamped>(motion.twist_with_covariance, take_twist);
    on<sensor_msgs::JointState>(motion.joint_states, [this](const auto& message, Stamp now) {
      return pipeline_.takeWheels(*message, now);
    });
  }

  void readScans(const InputTopics& topics) {
    const auto take = [this](const auto& message, Stamp now) {
      return pipeline_.takeScan(*message, now);
    };
    on<sensor_msgs::LaserScan>(topics.scan, take);
    on<sensor_msgs::MultiEchoLaserScan>(topics.echoes, take);
    on<sensor_msgs::PointCloud2>(topics.cloud, [this](const auto& message, Stamp now) {
      return pipeline_.takeLidarCloud(*message, now);
    });
  }

  void readStereo(const StereoTopics& topics) {
    on<sensor_msgs::PointCloud2>(topics.points, [this](const auto& message, Stamp now) {
      return pipeline_.takeCloud(*message, now);
    });
    readCamera(StereoSide::kLeft, topics.left_image, topics.left_info);
    readCamera(StereoSide::kRight, topics.right_image, topics.right_info);
  }

  void readCamera(StereoSide side, const std::string& image, const std::string& info) {
    on<sensor_msgs::Image>(image, [this, side](const auto& message, Stamp now) {
      return pipeline_.takeImage(side, message, now);
    });
    on<sensor_msgs::CameraInfo>(info, [this, side](const auto& message, Stamp now) {
      return pipeline_.takeCameraInfo(side, message, now);
    });
  }

  void write(const ros::Time& time, const Pipeline::Output& results) {
    drive_.add(results);
    text_.add(results);
    for (const auto& [name, grid] : results.grids) {
      if (write_grids_) {
        output_.write("/grids/" + name, time, *grid);
      }
    }
    for (const CloudToScanOutput& scan : results.cloud_scans) {
      writeCloudScan(time, scan);
    }
    for (const GridSlamOutput& slam : results.slam) {
      writeSlam(time, slam);
    }
    for (const RoadBordersPtr& borders : results.borders) {
      output_.write("/road_borders", time, *borders);
    }
    for (const DroppedObjectsPtr& dropped : results.dropped) {
      output_.write("/objects/dropped", time, *dropped);
    }
    for (const auto& [name, objects] : results.objects) {
      output_.write(name == "lidar" ? "/objects" : "/objects/" + name, time, *objects);
    }
    for (const auto& [name, tracks] : results.source_tracks) {
      output_.write("/tracks/" + name, time, *tracks);
    }
    for (const TrackArrayPtr& tracks : results.tracks) {
      output_.write("/tracks", time, *tracks);
    }
    for (const nav_msgs::OccupancyGridPtr& map : results.maps) {
      output_.write("/map", time, *map);
    }
  }

  void writeCloudScan(const ros::Time& time, const CloudToScanOutput& output) {
    if (output.mount) {
      tf2_msgs::TFMessage mount;
      mount.transforms = {*output.mount};
      output_.write("/tf_static", time, mount);
    }
    output_.write("/cloud_scan", time, *output.scan);
  }

  void writeSlam(const ros::Time& time, const GridSlamOutput& slam) {
    tf2_msgs::TFMessage transforms;
    transforms.transforms = slam.transforms;
    output_.write("/tf", time, transforms);
    output_.write("/pose", time, *slam.pose);
    output_.write("/split_scan", time, *slam.split_scan);
  }

  Pipeline& pipeline_;
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
                          topic == topics.stereo.points;
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

void checkResults(const Arguments& arguments, const DriveSummary& drive, const Pipeline& pipeline) {
  const bool until_fusion = arguments.last_stage == LastStage::kGridFusion;
  const bool scans_used = (until_fusion ? drive.fusedGrids() : drive.scans()) > 0;
  const bool until_tracks = arguments.last_stage >= LastStage::kTracker;
  if (scans_used && (!until_tracks || drive.trackLists() > 0)) {
    return;
  }
  std::string message =
      arguments.input + (scans_used ? ": no list of tracks came out" : ": no scan could be used");
  for (const StageMonitor* monitor : pipeline.monitors()) {
    if (!monitor->lastError().empty()) {
      message += "; " + monitor->stage() + " says: " + monitor->lastError();
    }
  }
  throw NoUsableInput(message);
}

PipelineOptions readOptionsFor(const Arguments& arguments) {
  PipelineOptions options = readPipelineOptions(arguments.config);
  if (!arguments.grid_rule.empty()) {
    options.low_level.grid_fusion.fuser.rule = arguments.grid_rule;
  }
  return options;
}

}  // namespace

void runBag(const Arguments& arguments, std::ostream& out, std::ostream* progress) {
  const PipelineOptions options = readOptionsFor(arguments);
  if (!arguments.times.empty()) {
    checkWritable(arguments.times);
  }
  rosbag::Bag bag;
  openInput(arguments.input, bag);
  const InputTopics topics = findTopics(bag, arguments, options);
  OutputBag output(arguments.output);
  Pipeline pipeline(options,
                    {arguments.last_stage, !topics.cloud.empty(), arguments.low_level_fusion,
                     arguments.road_border, arguments.object_fusion, arguments.track_fusion,
                     topics.stereo.input()});
  DriveSummary drive;
  BagRun run(topics, pipeline, drive, output, arguments);

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
  checkResults(arguments, drive, pipeline);
  if (!arguments.times.empty()) {
    writeWholeFile(arguments.times, toJson(pipeline.times()));
  }
  run.text().write();
  output.finish();
  if (!arguments.quiet) {
    printTable(out, drive, pipeline, run.refusals(), {lengthOf(view), took});
  }
}

}  // namespace datmo
