// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/loop_closing_stage.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include <boost/make_shared.hpp>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/map_files.h"
#include "datmo_fusion/ros/stage/map_saving.h"
#include "datmo_fusion/ros/transform_topics.h"

namespace datmo {

namespace {

/// Maximum number of scans that wait for the thread: a minute.
constexpr std::size_t kMaxQueuedScans = 1000;

/// Maximum number of scans per batch: after each batch results are used, and the thread can stop.
constexpr std::size_t kMaxScansAtATime = 100;

constexpr double kBytesPerMegabyte = 1e6;

}  // namespace

void LoopClosingStageOptions::visit(OptionVisitor& visitor) {
  visitor.text({"global_frame", "",
                "frame of the optimized map and trajectory; the stage publishes frames/map -> "
                "global_frame: no other node may publish it"},
               global_frame, {});
  visitor.number(
      {"publish_period", "s", "minimum time between two optimized maps; more after a long drive"},
      publish_period, {0.0, 3600.0});
  visitor.group("keyframe", [&] { keyframes.visit(visitor); });
  visitor.group("correction", [&] { correction.visit(visitor); });
  visitor.group("input", [&] { input.visit(visitor); });
  loops.visit(visitor);
}

SharedKeys LoopClosingStageOptions::sharedKeys() {
  return SharedKeys()
      .group<BeamEndOptions>("map/", "scanner/")
      .key("matcher/point_sigma", "scanner/range_sigma");
}

LoopClosingStage::LoopClosingStage(const Checked<LoopClosingStageOptions>& options,
                                   StageMonitor& monitor, const StepClock& clock)
    : options_(*options),
      monitor_(monitor),
      runner_(monitor, options->input, "begins a new trajectory", [this] { selector_.reset(); }),
      selector_(options->keyframes),
      correction_(options->correction),
      closer_(std::make_unique<LoopCloser>(options->loops)),
      worker_([this](const LoopJob& job) { return closeLoops(*closer_, job); }, clock != nullptr) {
  if (options->global_frame.empty() || options->global_frame == options->frames.map) {
    throw OptionError("global_frame = '" + options->global_frame +
                      "': expected a name other than that of the live map's frame, '" +
                      options->frames.map + "'");
  }
  options_.global_frame = options->frames.prefix + options->global_frame;
}

void LoopClosingStage::beginDrive(Stamp stamp) {
  if (drive_ > 0) {
    monitor_.condition(HealthLevel::kOk, "begins a new trajectory: SLAM has started a new map");
  }
  ++drive_;
  begun_ = stamp;
  waiting_.clear();
  changed_.reset();
  map_in_global_ = {};
  correction_.reset();
  due_.reset();
}

void LoopClosingStage::queue(LoopJob::Step step) {
  if (waiting_.size() < kMaxQueuedScans) {
    waiting_.push_back(std::move(step));
  } else {
    monitor_.dropped(InputError("superseded_scan",
                                "a scan arrived while 1000 wait for the loop search: expected a "
                                "faster machine, or a longer search_distance"));
  }
}

tf2_msgs::TFMessageConstPtr LoopClosingStage::handleLabeledScan(const LabeledScanMessage& message,
                                                                Stamp now) {
  return runner_.serve([&]() -> tf2_msgs::TFMessageConstPtr {
    if (message.map_frame != options_.frames.map) {
      throw InputError("wrong_frame", "labeled scan with its pose in '" + message.map_frame +
                                          "': expected '" + options_.frames.map + "'");
    }
    const LabeledScan scan = fromMessage(message);
    runner_.check("labeled_scan", message.header.stamp);
    const KeyframeSelector::Use use = selector_.select(scan.stamp, scan.base_in_map);
    const bool is_first = use == KeyframeSelector::Use::kFirst;
    if (is_first) {
      beginDrive(scan.stamp);
    }
    last_ = scan.stamp;
    if (use != KeyframeSelector::Use::kNothing) {
      const bool is_keyframe = is_first || use == KeyframeSelector::Use::kKeyframe;
      queue({use, {scan.stamp, scan.base_in_map, is_keyframe ? KeptScan(scan) : KeptScan()}});
      changed_ = changed_.value_or(now);
    }
    startIfIdle(now);
    takeResults();
    runner_.processed(scan.stamp);
    return transformAt(scan.stamp, scan.base_in_map.pose);
  });
}

void LoopClosingStage::startIfIdle(Stamp now) {
  const bool is_due = changed_ && secondsBetween(*changed_, now) >= maxWait();
  if (is_busy_ || (waiting_.empty() && !is_due)) {
    return;
  }
  is_busy_ = true;
  std::vector<LoopJob::Step> steps = takeWaiting();
  if (is_due) {
    changed_ = waiting_.empty() ? std::nullopt : std::make_optional(now);
  }
  worker_.start({std::move(steps), is_due, drive_});
}

std::vector<LoopJob::Step> LoopClosingStage::takeWaiting() {
  const auto count = static_cast<std::ptrdiff_t>(std::min(waiting_.size(), kMaxScansAtATime));
  std::vector<LoopJob::Step> first(std::make_move_iterator(waiting_.begin()),
                                   std::make_move_iterator(waiting_.begin() + count));
  waiting_.erase(waiting_.begin(), waiting_.begin() + count);
  return first;
}

void LoopClosingStage::takeResults() {
  for (const LoopResult& result : worker_.take()) {
    is_busy_ = false;
    if (!result.error.empty()) {
      monitor_.warned(InputError("loops_failed", "loops could not be closed: " + result.error));
    }
    if (result.drive == drive_) {
      map_in_global_ = result.map_in_global;
      show(result);
      if (!result.trajectory.empty()) {
        counts_ = result.counts;
        loops_ = result.loops;
        map_ = result.map;
        due_ = driveOf(result);
      }
    }
  }
}

void LoopClosingStage::show(const LoopResult& result) {
  monitor_.figure("trajectories started", static_cast<double>(drive_));
  monitor_.figure("keyframes", static_cast<double>(result.keyframes));
  monitor_.figure("scans kept for submaps", static_cast<double>(result.scans));
  monitor_.figure("memory of the trajectory [MB]", result.memory / kBytesPerMegabyte);
  monitor_.figure("loops closed", static_cast<double>(result.counts.closed));
  monitor_.figure("loops rejected: not confirmed", static_cast<double>(result.counts.unconfirmed));
  monitor_.figure("loops rejected: ambiguous", static_cast<double>(result.counts.ambiguous));
  monitor_.figure("loops rejected: no match", static_cast<double>(result.counts.unlike));
  monitor_.figure("loops removed: contradicted by others",
                  static_cast<double>(result.counts.refuted));
  monitor_.figure("residual of the loops, in standard deviations", result.residual);
  monitor_.figure("search and optimization [s]", result.seconds);
}

tf2_msgs::TFMessageConstPtr LoopClosingStage::transformAt(Stamp stamp, const Pose2& base_in_map) {
  const Pose2 map_in_global = correction_.advance(stamp, base_in_map, map_in_global_);
  auto message = boost::make_shared<tf2_msgs::TFMessage>();
  message->transforms = {
      toTransform(map_in_global.inverse(), stamp, options_.frames.map, options_.global_frame)};
  return message;
}

OptimizedDrive LoopClosingStage::driveOf(const LoopResult& result) const {
  const Stamp stamp = result.trajectory.empty() ? last_ : result.trajectory.back().stamp;
  auto path = boost::make_shared<nav_msgs::Path>();
  path->header.stamp = toTime(stamp);
  path->header.frame_id = options_.global_frame;
  for (const StampedPose& each : result.trajectory) {
    geometry_msgs::PoseStamped pose;
    pose.header.stamp = toTime(each.stamp);
    pose.header.frame_id = options_.global_frame;
    pose.pose = toMessage(each.pose);
    path->poses.push_back(pose);
  }
  nav_msgs::OccupancyGridConstPtr map;
  if (result.map) {
    map = boost::make_shared<nav_msgs::OccupancyGrid>(
        toMessage(*result.map, stamp, options_.global_frame));
  }
  return {path, map};
}

std::optional<OptimizedDrive> LoopClosingStage::next(Stamp now) {
  return runner_.serve([&] {
    takeResults();
    startIfIdle(now);
    takeResults();
    return std::exchange(due_, std::nullopt);
  });
}

double LoopClosingStage::maxWait() const {
  return std::max(options_.publish_period, options_.publish_share * secondsBetween(begun_, last_));
}

std::string LoopClosingStage::saveMap(const std::string& file) const {
  if (!map_) {
    throw MapFileError(file +
                       ": no optimized map, expected one within publish_period, of a drive whose "
                       "area is not too large for one");
  }
  return savedMapText(file, *map_);
}

void LoopClosingStage::connect(StagePorts& ports) {
  const auto transforms = ports.out<tf2_msgs::TFMessage>(kTransformTopic);
  trajectories_ = ports.out<nav_msgs::Path>("trajectory/optimized", true);
  maps_ = ports.out<nav_msgs::OccupancyGrid>("map/optimized", true);
  ports.service<datmo_fusion::SaveMap>("save_map", [this](const auto& request) {
    return answerSaveMap(request, monitor_,
                         [this](const std::string& file) { return saveMap(file); });
  });
  ports.in<LabeledScanMessage>("labeled_scan", [this, transforms](const auto& scan, Stamp now) {
    transforms.publish(handleLabeledScan(*scan, now));
  });
}

bool LoopClosingStage::publishNext(Stamp now) {
  const std::optional<OptimizedDrive> drive = next(now);
  if (!drive) {
    return false;
  }
  trajectories_.publish(drive->trajectory);
  maps_.publish(drive->map);
  return true;
}

}  // namespace datmo
